#include "smt/blame.h"

#include <algorithm>
#include <cstdint>
#include <set>
#include <utility>
#include <vector>

#include "analysis/simulator.h"
#include "smt/edits.h"
#include "smt/sat.h"
#include "smt/signals.h"

namespace rung {
namespace {

/// A change of one place.
struct Mutation {
  enum class Kind : std::uint8_t { Negate, Replace, Constant, Preset, Swap };
  Kind kind = Kind::Negate;
  std::uint32_t at = 0;     // a node; of Preset a call, of Swap the upper rung
  NodeOp op = NodeOp::Not;  // of Replace: the other operator
  std::int64_t value = 0;   // of Constant and Preset
};

Program changed(const Program& program, const Mutation& mutation) {
  Program result = program;
  switch (mutation.kind) {
    case Mutation::Kind::Negate:
      negate_node(result, mutation.at);
      break;
    case Mutation::Kind::Replace:
      replace_operator(result, mutation.at, mutation.op);
      break;
    case Mutation::Kind::Constant:
      result.nodes[mutation.at].value = mutation.value;
      break;
    case Mutation::Kind::Preset: {
      ElementCall& call = result.calls[CallId(mutation.at)];
      call.parameter = mutation.value;
      Instance& instance = result.instances[call.instance];
      instance.largest_parameter =
          std::max(instance.largest_parameter, mutation.value);
      instance.clock_cap = std::max(instance.clock_cap, mutation.value + 1);
      break;
    }
    case Mutation::Kind::Swap:
      std::swap(result.rungs[RungId(mutation.at)],
                result.rungs[RungId(mutation.at + 1)]);
      break;
  }
  return result;
}

std::string_view sign(NodeOp op) {
  switch (op) {
    case NodeOp::And:
      return "&&";
    case NodeOp::Or:
      return "||";
    case NodeOp::Less:
      return "<";
    case NodeOp::LessEqual:
      return "<=";
    case NodeOp::Greater:
      return ">";
    case NodeOp::GreaterEqual:
      return ">=";
    default:
      return "";
  }
}

NodeOp counterpart(NodeOp op) {
  switch (op) {
    case NodeOp::And:
      return NodeOp::Or;
    case NodeOp::Or:
      return NodeOp::And;
    case NodeOp::Less:
      return NodeOp::LessEqual;
    case NodeOp::LessEqual:
      return NodeOp::Less;
    case NodeOp::Greater:
      return NodeOp::GreaterEqual;
    case NodeOp::GreaterEqual:
      return NodeOp::Greater;
    default:
      return NodeOp::Not;
  }
}

Blame describe(const Program& b, const Mutation& mutation) {
  constexpr std::string_view kSame = " the programs are the same";
  std::string what;
  SourceRange where;
  switch (mutation.kind) {
    case Mutation::Kind::Negate:
      where = b.nodes[mutation.at].where;
      what = "with this contact negated";
      break;
    case Mutation::Kind::Replace: {
      where = b.nodes[mutation.at].where;
      const std::string_view old = sign(b.nodes[mutation.at].op);
      what = old.empty() ? std::string("without this negation")
                         : "with `" + std::string(sign(mutation.op)) +
                               "` instead of `" + std::string(old) + "`";
      break;
    }
    case Mutation::Kind::Constant:
      where = b.nodes[mutation.at].where;
      what = "with " + std::to_string(mutation.value) + " here";
      break;
    case Mutation::Kind::Preset:
      where = b.calls[CallId(mutation.at)].where;
      what = "with the preset " + std::to_string(mutation.value) +
             " instead of " +
             std::to_string(b.calls[CallId(mutation.at)].parameter);
      break;
    case Mutation::Kind::Swap:
      where = b.rungs[RungId(mutation.at)].where;
      what = "with this rung below the next one";
      break;
  }
  return {where, what + std::string(kSame)};
}

/// All changes, in the order of the rungs.
class Mutations {
 public:
  Mutations(const Program& a, const Program& b) : b_(b) {
    for (const Node& node : a.nodes) {
      const bool number =
          node.op == NodeOp::Constant && node.type == Type::Word;
      if (number && numbers_.size() < kMostNumbers) numbers_.insert(node.value);
    }
    for (const ElementCall& call : a.calls) {
      if (presets_.size() < kMostNumbers) presets_.insert(call.parameter);
    }
  }

  std::vector<Mutation> list() {
    for (const RungId id : ids_of(b_.rungs)) {
      const Rung& rung = b_.rungs[id];
      for (std::uint32_t i = rung.begin; i < rung.end; ++i) add_node(i);
      if (id.index() + 1 < b_.rungs.size()) {
        mutations_.push_back({.kind = Mutation::Kind::Swap, .at = id.index()});
      }
    }
    return std::move(mutations_);
  }

 private:
  static constexpr std::size_t kMostNumbers = 16;

  void add_node(std::uint32_t i) {
    const Node& node = b_.nodes[i];
    if (node.op == NodeOp::Read && node.type == Type::Bit) {
      mutations_.push_back({.kind = Mutation::Kind::Negate, .at = i});
    } else if (node.op == NodeOp::Not || counterpart(node.op) != NodeOp::Not) {
      mutations_.push_back({.kind = Mutation::Kind::Replace,
                            .at = i,
                            .op = counterpart(node.op)});
    } else if (node.op == NodeOp::Constant && node.type == Type::Word) {
      add_numbers(Mutation::Kind::Constant, i, numbers_, node.value);
    } else if (node.op == NodeOp::Call) {
      add_numbers(Mutation::Kind::Preset, node.call.index(), presets_,
                  b_.calls[node.call].parameter);
    }
  }

  void add_numbers(Mutation::Kind kind, std::uint32_t at,
                   const std::set<std::int64_t>& numbers, std::int64_t old) {
    for (const std::int64_t number : numbers) {
      if (number == old) continue;
      mutations_.push_back({.kind = kind, .at = at, .value = number});
    }
  }

  const Program& b_;
  std::set<std::int64_t> numbers_;
  std::set<std::int64_t> presets_;
  std::vector<Mutation> mutations_;
};

/// The shared outputs of the first program at the end of each step of the run.
using Values = std::vector<std::vector<std::int64_t>>;

Values run_of(const Program& program, const std::vector<CellId>& outputs,
              const Stimulus& stimulus) {
  Values values;
  Simulator simulator(program);
  for (const StimulusStep& step : stimulus.steps) {
    for (std::size_t i = 0; i < stimulus.inputs.size(); ++i) {
      simulator.set_input(stimulus.inputs[i], step.inputs[i]);
    }
    for (std::uint64_t scan = 0; scan < step.repeat; ++scan) {
      simulator.scan(step.dt_ms);
    }
    std::vector<std::int64_t>& now = values.emplace_back();
    for (const CellId cell : outputs) now.push_back(simulator.value(cell));
  }
  return values;
}

}  // namespace

std::optional<Blame> find_blame(const Program& a, const Program& b,
                                const EquivalenceOptions& options,
                                const EquivalenceResult& different,
                                double seconds) {
  if (!different.stimulus_a || !different.stimulus_b) return std::nullopt;
  const SharedSignals shared = share_signals(a, b, options.map);
  std::vector<CellId> outputs_a;
  std::vector<CellId> outputs_b;
  for (const SignalPair& pair : shared.outputs) {
    outputs_a.push_back(pair.a);
    outputs_b.push_back(pair.b);
  }
  const Values expected = run_of(a, outputs_a, *different.stimulus_a);
  const Deadline deadline(seconds);
  EquivalenceOptions quick = options;
  quick.delay = 0;
  quick.smtlib_directory.clear();
  for (const Mutation& mutation : Mutations(a, b).list()) {
    if (deadline.passed()) break;
    const Program candidate = changed(b, mutation);
    if (run_of(candidate, outputs_b, *different.stimulus_b) != expected) {
      continue;
    }
    quick.budget.seconds = std::min(2.0, options.budget.seconds);
    const EquivalenceResult answer = check_equivalence(a, candidate, quick);
    if (answer.verdict == EquivalenceVerdict::Equivalent) {
      return describe(b, mutation);
    }
  }
  return std::nullopt;
}

}  // namespace rung
