#include "analysis/replay_formula.h"

#include <algorithm>
#include <cassert>

#include "analysis/simulator_word.h"

namespace rung {
namespace {

using Word = std::int64_t;

Word observe(const Observation& observation, const Simulator& simulator) {
  switch (observation.kind) {
    case Observation::Kind::Cell:
      return simulator.value(observation.cell);
    case Observation::Kind::Done:
      return simulator.done(observation.instance) ? 1 : 0;
    case Observation::Kind::Fired:
      return std::any_of(observation.calls.begin(), observation.calls.end(),
                         [&](std::uint32_t call) {
                           return simulator.node_value(call) != 0;
                         })
                 ? 1
                 : 0;
    case Observation::Kind::Elapsed:
      return simulator.elapsed(observation.instance);
    case Observation::Kind::Count:
      return simulator.count(observation.instance);
  }
  return 0;
}

Word compute(FormulaOp op, Word a, Word b, Word c) {
  switch (op) {
    case FormulaOp::Not:
      return a == 0 ? 1 : 0;
    case FormulaOp::Negate:
      return saturating_subtract(0, a);
    case FormulaOp::And:
      return a != 0 && b != 0 ? 1 : 0;
    case FormulaOp::Or:
      return a != 0 || b != 0 ? 1 : 0;
    case FormulaOp::Xor:
      return (a != 0) != (b != 0) ? 1 : 0;
    case FormulaOp::Implies:
      return a == 0 || b != 0 ? 1 : 0;
    case FormulaOp::Equivalent:
      return (a != 0) == (b != 0) ? 1 : 0;
    case FormulaOp::Choose:
      return a != 0 ? b : c;
    case FormulaOp::Equal:
      return a == b ? 1 : 0;
    case FormulaOp::NotEqual:
      return a != b ? 1 : 0;
    case FormulaOp::Less:
      return a < b ? 1 : 0;
    case FormulaOp::LessEqual:
      return a <= b ? 1 : 0;
    case FormulaOp::Greater:
      return a > b ? 1 : 0;
    case FormulaOp::GreaterEqual:
      return a >= b ? 1 : 0;
    case FormulaOp::Add:
      return saturating_add(a, b);
    case FormulaOp::Subtract:
      return saturating_subtract(a, b);
    case FormulaOp::Multiply:
      return saturating_multiply(a, b);
    case FormulaOp::Name:
    case FormulaOp::Number:
    case FormulaOp::Bool:
    case FormulaOp::Call:
      break;  // FormulaWatch has them
  }
  return 0;
}

bool is_comparison(FormulaOp op) {
  return op == FormulaOp::Equal || op == FormulaOp::NotEqual ||
         op == FormulaOp::Less || op == FormulaOp::LessEqual ||
         op == FormulaOp::Greater || op == FormulaOp::GreaterEqual;
}

// Scans until `difference`, which changes by `slope` a scan, may change its
// sign: as long, every comparison of the two sides stays as it is.
std::uint64_t scans_of_same_sign(Word difference, Word slope) {
  if (slope == 0) return kForever;
  if (difference == 0) return 0;
  if ((difference > 0) == (slope > 0)) return kForever;
  const Word distance =
      difference > 0 ? difference : saturating_subtract(0, difference);
  const Word speed = slope > 0 ? slope : saturating_subtract(0, slope);
  return static_cast<std::uint64_t>((distance - 1) / speed);
}

}  // namespace

ObservationNames::ObservationNames(const Program& program) {
  for (const CellId cell : ids_of(program.cells)) {
    cells_.emplace(program.cells[cell].name, cell);
  }
  for (const InstanceId instance : ids_of(program.instances)) {
    instances_.emplace(program.instances[instance].name, instance);
  }
  calls_.resize(program.instances.size());
  for (std::uint32_t i = 0; i < program.nodes.size(); ++i) {
    if (program.nodes[i].op != NodeOp::Call) continue;
    const ElementCall& call = program.calls[program.nodes[i].call];
    if (call.operation->steps()) calls_[call.instance.index()].push_back(i);
  }
}

Observation ObservationNames::find(std::string_view name) const {
  Observation result;
  if (const auto cell = cells_.find(name); cell != cells_.end()) {
    result.cell = cell->second;
    return result;
  }
  const std::size_t dot = name.rfind('.');
  const auto instance = instances_.find(name.substr(0, dot));
  assert(instance != instances_.end() && dot != std::string_view::npos);
  result.instance = instance->second;
  const std::string_view what = name.substr(dot + 1);
  if (what == "fired") result.calls = calls_[result.instance.index()];
  result.kind = what == "q"         ? Observation::Kind::Done
                : what == "fired"   ? Observation::Kind::Fired
                : what == "elapsed" ? Observation::Kind::Elapsed
                                    : Observation::Kind::Count;
  return result;
}

FormulaWatch::FormulaWatch(const Program& program,
                           const ObservationNames& names, std::string_view text)
    : program_(program) {
  const Formula formula = parse_formula(text);
  assert(formula.has_value());
  for (const FormulaNode& node : formula.nodes) {
    Step step;
    step.op = node.op;
    step.number = node.number;
    // Operands stand before the node, the last one right before it.
    auto operand = static_cast<std::uint32_t>(steps_.size());
    assert(node.arguments <= 3);
    for (std::uint32_t i = node.arguments; i-- > 0;) {
      step.operand[i] = operand - 1;
      operand -= formula.nodes[operand - 1].size;
    }
    if (node.op == FormulaOp::Name) step.observation = names.find(node.text);
    if (node.op == FormulaOp::Call) {
      step.memory = node.text == "prev"    ? Memory::Prev
                    : node.text == "begin" ? Memory::Begin
                    : node.text == "rose"  ? Memory::Rose
                    : node.text == "fell"  ? Memory::Fell
                                           : Memory::Once;
      has_begin_ = has_begin_ || step.memory == Memory::Begin;
    }
    steps_.push_back(step);
  }
  end_.resize(steps_.size());
  slope_.resize(steps_.size());
  once_.resize(steps_.size());
}

bool FormulaWatch::left_side_holds() const {
  const Step& root = steps_.back();
  return root.op != FormulaOp::Implies || end_[root.operand[0]] != 0;
}

void FormulaWatch::start(const Simulator& simulator) {
  for (std::size_t i = 0; i < steps_.size(); ++i) {
    const Step& step = steps_[i];
    const Word a = end_[step.operand[0]];
    if (step.op == FormulaOp::Name) {
      end_[i] = observe(step.observation, simulator);
    } else if (step.op == FormulaOp::Call) {
      const bool same =
          step.memory == Memory::Prev || step.memory == Memory::Begin;
      end_[i] = same ? a : 0;
    } else if (step.op == FormulaOp::Number || step.op == FormulaOp::Bool) {
      end_[i] = step.number;
    } else {
      end_[i] =
          compute(step.op, a, end_[step.operand[1]], end_[step.operand[2]]);
    }
  }
  previous_ = end_;
  begin_ = end_;
}

// begin(e) has no call inside.
void FormulaWatch::begin(const Simulator& simulator) {
  if (!has_begin_) return;
  for (std::size_t i = 0; i < steps_.size(); ++i) {
    const Step& step = steps_[i];
    if (step.op == FormulaOp::Name) {
      begin_[i] = observe(step.observation, simulator);
    } else if (step.op != FormulaOp::Number && step.op != FormulaOp::Bool &&
               step.op != FormulaOp::Call) {
      begin_[i] = compute(step.op, begin_[step.operand[0]],
                          begin_[step.operand[1]], begin_[step.operand[2]]);
    }
  }
}

void FormulaWatch::end(const Simulator& simulator) {
  previous_.swap(end_);
  for (std::size_t i = 0; i < steps_.size(); ++i) {
    const Step& step = steps_[i];
    if (step.op == FormulaOp::Name) {
      end_[i] = observe(step.observation, simulator);
    } else if (step.op == FormulaOp::Call) {
      end_[i] = remembered(step, i);
    } else if (step.op == FormulaOp::Number || step.op == FormulaOp::Bool) {
      end_[i] = step.number;
    } else {
      end_[i] = compute(step.op, end_[step.operand[0]], end_[step.operand[1]],
                        end_[step.operand[2]]);
    }
  }
}

Word FormulaWatch::remembered(const Step& step, std::size_t index) {
  const std::uint32_t operand = step.operand[0];
  const bool now = end_[operand] != 0;
  const bool before = previous_[operand] != 0;
  switch (step.memory) {
    case Memory::Prev:
      return previous_[operand];
    case Memory::Begin:
      return begin_[operand];
    case Memory::Rose:
      return now && !before ? 1 : 0;
    case Memory::Fell:
      return !now && before ? 1 : 0;
    case Memory::Once:
      if (now) once_[index] = true;
      return once_[index] ? 1 : 0;
    case Memory::None:
      break;
  }
  return 0;
}

std::uint64_t FormulaWatch::steady_scans(const Simulator& simulator,
                                         std::int64_t dt_ms) {
  std::uint64_t limit = kForever;
  for (std::size_t i = 0; i < steps_.size() && limit > 0; ++i) {
    slope_[i] = slope_of(steps_[i], simulator, dt_ms, limit);
    // What remembers must have seen this very scan before.
    const bool steady =
        previous_[i] == saturating_subtract(end_[i], slope_[i]) &&
        (!has_begin_ || begin_[i] == previous_[i]);
    if (!steady) limit = 0;
  }
  return limit;
}

Word FormulaWatch::slope_of(const Step& step, const Simulator& simulator,
                            std::int64_t dt_ms, std::uint64_t& limit) const {
  if (step.op == FormulaOp::Name) {
    return observed_slope(step.observation, simulator, dt_ms, limit);
  }
  if (step.op == FormulaOp::Number || step.op == FormulaOp::Bool) return 0;
  return operator_slope(step, limit);
}

Word FormulaWatch::observed_slope(const Observation& seen,
                                  const Simulator& simulator,
                                  std::int64_t dt_ms,
                                  std::uint64_t& limit) const {
  if (!seen.instance.has_value() || !simulator.elapsed_grows(seen.instance)) {
    return 0;
  }
  if (seen.kind == Observation::Kind::Elapsed) return dt_ms;
  // A timer that is not executed can be done all the same: watch its preset.
  if (seen.kind == Observation::Kind::Done && !simulator.done(seen.instance)) {
    const Word difference = saturating_subtract(
        simulator.elapsed(seen.instance),
        program_.instances[seen.instance].largest_parameter);
    if (difference >= 0) {
      limit = 0;
    } else {
      limit = std::min(limit, scans_of_same_sign(difference, dt_ms));
    }
  }
  return 0;
}

Word FormulaWatch::operator_slope(const Step& step,
                                  std::uint64_t& limit) const {
  const Word a = slope_[step.operand[0]];
  const Word b = slope_[step.operand[1]];
  const Word left = end_[step.operand[0]];
  const Word right = end_[step.operand[1]];
  if (a == 0 && b == 0 && step.op != FormulaOp::Choose) return 0;
  if (step.op == FormulaOp::Negate) return saturating_subtract(0, a);
  if (step.op == FormulaOp::Add) return saturating_add(a, b);
  if (step.op == FormulaOp::Subtract) return saturating_subtract(a, b);
  if (step.op == FormulaOp::Choose) {
    return left != 0 ? b : slope_[step.operand[2]];
  }
  if (is_comparison(step.op)) {
    limit = std::min(limit, scans_of_same_sign(saturating_subtract(left, right),
                                               saturating_subtract(a, b)));
    return 0;
  }
  limit = 0;  // a product, or a word's memory: step by step
  return 0;
}

void FormulaWatch::skip(std::uint64_t count) {
  if (count == 0) return;
  const auto scans = static_cast<Word>(count);
  for (std::size_t i = 0; i < steps_.size(); ++i) {
    end_[i] = saturating_add(end_[i], saturating_multiply(slope_[i], scans));
    previous_[i] = saturating_subtract(end_[i], slope_[i]);
    begin_[i] = previous_[i];
  }
}

}  // namespace rung
