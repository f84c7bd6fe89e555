#include "analysis/rules/redundant.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "analysis/property_text.h"
#include "analysis/rules/jumped_over.h"
#include "analysis/rules/support.h"

namespace rung {
namespace {

using Report = std::function<void(RuleRun&, const Redundant&)>;

constexpr std::uint32_t kMostNodes = 192;  // of a rung

bool is_logic(NodeOp op) {
  return is_and_or(op) || op == NodeOp::Not || op == NodeOp::Xor;
}

/// The value that `node` is part of, as it would be without `node`, and as it
/// is; no value when they have no such term.
struct Without {
  ExprId changed;
  ExprId original;
};

Without leave_out(RuleRun& run, std::uint32_t node) {
  const std::vector<Node>& nodes = run.program.nodes;
  ExprArena& exprs = run.ts.exprs;
  std::uint32_t at = run.index.parent[node];
  const auto sibling = [&](std::uint32_t parent, std::uint32_t child) {
    const Node& it = nodes[parent];
    return run.ts.node_value[it.a == child ? it.b : it.a];
  };
  ExprId value = sibling(at, node);  // `true &&` and `false ||` are neutral
  for (std::uint32_t up = run.index.parent[at];
       up != ProgramIndex::kNone && is_logic(nodes[up].op);
       at = up, up = run.index.parent[at]) {
    switch (nodes[up].op) {
      case NodeOp::And:
        value = exprs.conjunction(value, sibling(up, at));
        break;
      case NodeOp::Or:
        value = exprs.disjunction(value, sibling(up, at));
        break;
      case NodeOp::Xor:
        value = exprs.exclusive_or(value, sibling(up, at));
        break;
      default:
        value = exprs.negation(value);
        break;
    }
  }
  return {value, run.ts.node_value[at]};
}

bool has_effect(const RuleRun& run, std::uint32_t first, std::uint32_t last) {
  for (std::uint32_t i = first; i <= last; ++i) {
    const NodeOp op = run.program.nodes[i].op;
    if (op == NodeOp::Call) return true;
  }
  return false;
}

bool is_looked_at(const RuleRun& run, const Rung& rung) {
  if (rung.end - rung.begin > kMostNodes) return false;
  for (std::uint32_t i = rung.begin; i < rung.end; ++i) {
    // Without its left operand an element would run in other scans.
    if (run.program.nodes[i].op == NodeOp::Branch) return false;
  }
  return true;
}

/// Three claims a candidate: the rung does without it; it is always true; it
/// is never true.
constexpr std::size_t kClaims = 3;

bool is_told_elsewhere(const RuleRun& run, std::uint32_t node,
                       std::span<const RuleRun::Evidence> claims) {
  // A constant operand is a contact of a constant cell, a comparison that is
  // always the same, or contacts that exclude each other: rules of their own.
  const bool constant = claims[1].answer == RuleRun::Answer::Yes ||
                        claims[2].answer == RuleRun::Answer::Yes;
  return constant && run.program.nodes[node].op != NodeOp::Or;
}

/// Has the operand a text that one could take out? A drawn branch may be
/// nothing but its comma.
bool is_written(const RuleRun& run, std::uint32_t node) {
  const std::string_view text = text_of(run, run.program.nodes[node].where);
  return text.empty() || std::any_of(text.begin(), text.end(), is_word_part);
}

void judge(RuleRun& run, const std::vector<std::uint32_t>& candidates,
           std::span<const RuleRun::Evidence> answers, const Report& report) {
  if (answers[0].answer == RuleRun::Answer::Yes ||
      answers[1].answer == RuleRun::Answer::Yes ||
      run.explained(RungId(run.index.rung_of[candidates[0]]))) {
    return;  // a constant does without every operand
  }
  Redundant best;
  std::uint32_t size = 0;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    const std::uint32_t node = candidates[i];
    const std::uint32_t nodes = node - run.index.first[node] + 1;
    const auto claims = answers.subspan(2 + i * kClaims, kClaims);
    if (claims[0].answer != RuleRun::Answer::Yes || nodes < size ||
        !is_written(run, node) || is_told_elsewhere(run, node, claims)) {
      continue;
    }
    size = nodes;
    best = {node, run.program.nodes[run.index.parent[node]].op,
            proof_text(claims[0])};
  }
  if (size != 0) report(run, best);
}

void ask_rung(RuleRun& run, const Rung& rung, const Report& report) {
  if (run.program.cells[rung.target].type != Type::Bit) return;
  ExprArena& exprs = run.ts.exprs;
  const ExprId value = run.ts.node_value[rung.root()];
  std::vector<ExprId> claims = {value, exprs.negation(value)};
  std::vector<std::uint32_t> candidates;
  for (std::uint32_t i = rung.begin; i < rung.end; ++i) {
    const std::uint32_t parent = run.index.parent[i];
    if (parent == ProgramIndex::kNone ||
        !is_and_or(run.program.nodes[parent].op) ||
        run.program.nodes[i].op == NodeOp::Constant ||
        has_effect(run, run.index.first[i], i)) {
      continue;
    }
    const Without without = leave_out(run, i);
    const ExprId operand = run.ts.node_value[i];
    candidates.push_back(i);
    claims.push_back(exprs.equal(without.changed, without.original));
    claims.push_back(operand);
    claims.push_back(exprs.negation(operand));
  }
  if (candidates.empty()) return;
  run.ask(RuleRun::Want::Proof, std::move(claims),
          [candidates = std::move(candidates), report](
              RuleRun& now, std::span<const RuleRun::Evidence> answers) {
            judge(now, candidates, answers, report);
          });
}

}  // namespace

void ask_redundant(RuleRun& run, const Report& report) {
  if (!run.has_oracle) return;
  for (const Rung& rung : run.program.rungs) {
    if (is_jumped_over(run.program, rung)) continue;
    if (run.program.cells[rung.target].type == Type::Bit &&
        is_looked_at(run, rung)) {
      ask_rung(run, rung, report);
    }
  }
}

}  // namespace rung
