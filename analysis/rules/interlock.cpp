#include "analysis/rules/interlock.h"

#include <algorithm>

#include "analysis/node_operands.h"
#include "analysis/rules/support.h"

namespace rung {
namespace {

bool is_output(const RuleRun& run, CellId cell) {
  return run.program.cells[cell].role == CellRole::Output;
}

/// Outputs whose inverted contact breaks the latch.
std::vector<CellId> locked_against(const RuleRun& run, const Latch& latch) {
  std::vector<CellId> cells;
  for (const std::uint32_t node : latch.breaks) {
    for (const std::uint32_t part : operands(run.program, node, NodeOp::And)) {
      const Contact contact = contact_at(run.program, part);
      if (contact.cell.has_value() && contact.inverted &&
          contact.cell != latch.cell && is_output(run, contact.cell)) {
        cells.push_back(contact.cell);
      }
    }
  }
  return cells;
}

/// A bit operator over its operands' terms; no value for other nodes.
ExprId bit_term(ExprArena& exprs, const Node& node, ExprId a, ExprId b) {
  if (node.op == NodeOp::Not) return exprs.negation(a);
  if (node.op == NodeOp::And) return exprs.conjunction(a, b);
  if (node.op == NodeOp::Or) return exprs.disjunction(a, b);
  if (node.op == NodeOp::Xor) return exprs.exclusive_or(a, b);
  return {};
}

}  // namespace

bool reads(const RuleRun& run, RungId rung, CellId cell) {
  const Rung& it = run.program.rungs[rung];
  const std::span<const std::uint32_t> nodes = run.index.reads[cell.index()];
  const auto first = std::lower_bound(nodes.begin(), nodes.end(), it.begin);
  return first != nodes.end() && *first < it.end;
}

std::vector<OneSided> one_sided_pairs(const RuleRun& run) {
  std::vector<const Latch*> latch_of(run.program.cells.size());
  for (const Latch& latch : run.latches) {
    if (!latch.sets.empty() && is_output(run, latch.cell)) {
      latch_of[latch.cell.index()] = &latch;
    }
  }
  std::vector<OneSided> pairs;
  for (const Latch& latch : run.latches) {
    if (latch_of[latch.cell.index()] != &latch) continue;
    for (const CellId other : locked_against(run, latch)) {
      const Latch* const free = latch_of[other.index()];
      if (free == nullptr || reads(run, free->rung, latch.cell)) continue;
      pairs.push_back({&latch, free});
    }
  }
  return pairs;
}

ExprId value_with(RuleRun& run, RungId rung, CellId cell, ExprId term) {
  const Rung& it = run.program.rungs[rung];
  // By node from it.begin: its term, and whether the cell is in it.
  std::vector<ExprId> values(it.end - it.begin);
  std::vector<bool> depends(it.end - it.begin);
  for (std::uint32_t i = it.begin; i < it.end; ++i) {
    const Node& node = run.program.nodes[i];
    const std::uint32_t at = i - it.begin;
    values[at] = run.ts.node_value[i];
    if (node.op == NodeOp::Read) {
      depends[at] = node.cell == cell;
      if (depends[at]) values[at] = term;
    } else if (node.op == NodeOp::Call) {
      const ElementCall& call = run.program.calls[node.call];
      for (const std::uint32_t argument : call.arguments) {
        if (depends[argument - it.begin]) return {};
      }
    } else if (operand_count(node.op) > 0) {
      const std::uint32_t a = node.a - it.begin;
      const std::uint32_t b =
          operand_count(node.op) > 1 ? node.b - it.begin : a;
      depends[at] = depends[a] || depends[b];
      if (!depends[at]) continue;
      values[at] = bit_term(run.ts.exprs, node, values[a], values[b]);
      if (!values[at].has_value()) return {};
    }
  }
  return values.back();
}

}  // namespace rung
