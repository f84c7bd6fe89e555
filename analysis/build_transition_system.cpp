#include <algorithm>
#include <cassert>
#include <span>
#include <unordered_map>
#include <utility>

#include "analysis/transition_system.h"

namespace rung {
namespace {

/// The texts of an element operation, parsed once a program.
struct ParsedOperation {
  std::vector<Formula> updates;
  Formula result;
};

Formula parsed(std::string_view text) {
  Formula formula = parse_formula(text);
  assert(formula.has_value() && "element tables hold formulas");
  return formula;
}

/// Names that an element's step text may use, with their terms. A dozen at the
/// most, so a list is faster than a map.
class StepNames : public NameResolver {
 public:
  StepNames(TransitionSystem& ts, const std::string& instance)
      : ts_(ts), instance_(instance) {}

  void set(std::string name, ExprId value) {
    for (auto& [known, term] : names_) {
      if (known == name) {
        term = value;
        return;
      }
    }
    names_.emplace_back(std::move(name), value);
  }

  ExprId resolve(std::string_view name) override {
    for (const auto& [known, term] : names_) {
      if (known == name) return term;
    }
    if (name != "any") return {};
    const VarId any =
        ts_.add_input(instance_ + ".any" + std::to_string(ts_.vars.size()),
                      VarRole::Choice, Type::Bit, 0, 1);
    return ts_.of(any);
  }

 private:
  TransitionSystem& ts_;
  const std::string& instance_;
  std::vector<std::pair<std::string, ExprId>> names_;
};

class Builder {
 public:
  enum class Time : std::uint8_t { Passes, MayStop };

  Builder(const Program& program, Time time)
      : program_(program), may_stop_(time == Time::MayStop) {}

  TransitionSystem build() {
    ts_.scan = program_.scan;
    ts_.dt = ts_.add_input("dt", VarRole::Dt, Type::Word, ts_.scan.min_ms,
                           ts_.scan.max_ms);
    if (may_stop_) declare_stop();
    declare_cells();
    declare_instances();
    tick_clocks();
    ts_.call_value.assign(program_.calls.size(), exprs().bit(false));
    ts_.call_executed.assign(program_.calls.size(), exprs().bit(false));
    value_.resize(program_.nodes.size());
    for (const Rung& rung : program_.rungs) run(rung);
    finish();
    return std::move(ts_);
  }

 private:
  ExprArena& exprs() { return ts_.exprs; }

  void declare_stop() {
    const VarId stop =
        ts_.add_input(".freeze", VarRole::Freeze, Type::Bit, 0, 1);
    const std::uint32_t frozen = ts_.add_state(".frozen", Type::Bit, 0, 1, 0);
    ts_.frozen = ts_.state_expr(frozen);
    ts_.states[frozen].next = exprs().disjunction(ts_.frozen, ts_.of(stop));
    const std::uint32_t held = ts_.add_state(".held", Type::Bit, 0, 1, 0);
    ts_.states[held].next = ts_.frozen;
    held_ = ts_.state_expr(held);
  }

  /// What an input is in a scan, given its sample of that scan.
  ExprId sampled(const Cell& cell, ExprId sample) {
    if (!may_stop_) return sample;
    const std::size_t dot = cell.made ? cell.name.rfind('.') : 0;
    const auto pin = first_sample_.find(cell.name.substr(0, dot));
    if (pin != first_sample_.end()) {
      return exprs().ite(ts_.frozen, pin->second, sample);
    }
    const std::uint32_t kept = ts_.add_state(".held." + cell.name, cell.type,
                                             cell.low, cell.high, cell.initial);
    const ExprId value = exprs().ite(held_, ts_.state_expr(kept), sample);
    ts_.states[kept].next = value;
    first_sample_.emplace(cell.name, value);
    return value;
  }

  void declare_cells() {
    for (const CellId id : ids_of(program_.cells)) {
      const Cell& cell = program_.cells[id];
      if (cell.role == CellRole::Input) {
        const VarId var = ts_.add_input(cell.name, VarRole::Input, cell.type,
                                        cell.low, cell.high, id);
        cells_.push_back(sampled(cell, ts_.of(var)));
        cell_state_.push_back(kNoState);
      } else {
        const std::uint32_t state = ts_.add_state(
            cell.name, cell.type, cell.low, cell.high, cell.initial, id);
        cells_.push_back(ts_.state_expr(state));
        cell_state_.push_back(state);
      }
    }
    ts_.cell_begin = cells_;
  }

  std::int64_t bound(std::string_view text, const Instance& instance) {
    StepNames names(ts_, instance.name);
    names.set("p", exprs().word(instance.largest_parameter));
    const ExprId value = compile_formula(exprs(), parsed(text), names);
    return exprs()[value].value;
  }

  void declare_instances() {
    for (const Instance& instance : program_.instances) {
      std::vector<std::uint32_t> states;
      for (const ElementState& state : instance.kind->states) {
        states.push_back(declare_state(instance, state));
      }
      for (std::size_t i = 0; i < states.size(); ++i) {
        if (instance.kind->states[i].type != StateType::Clock) continue;
        StepNames names(ts_, instance.name);
        name_states(instance, states, names);
        ts_.states[states[i]].running = compile_formula(
            exprs(), parsed(instance.kind->states[i].running), names);
      }
      ts_.instance_states.push_back(std::move(states));
    }
  }

  std::uint32_t declare_state(const Instance& instance,
                              const ElementState& state) {
    const std::string name = instance.name + "." + std::string(state.name);
    switch (state.type) {
      case StateType::Bit:
        return ts_.add_state(name, Type::Bit, 0, 1, 0);
      case StateType::Count:
        return ts_.add_state(name, Type::Word, bound(state.low, instance),
                             bound(state.high, instance), 0);
      case StateType::Clock: {
        const std::uint32_t id =
            ts_.add_state(name, Type::Word, 0, instance.clock_cap, 0);
        ts_.states[id].clock = true;
        ts_.states[id].cap = instance.clock_cap;
        return id;
      }
    }
    return 0;
  }

  void name_states(const Instance& instance,
                   const std::vector<std::uint32_t>& states, StepNames& names) {
    for (std::size_t i = 0; i < states.size(); ++i) {
      names.set(std::string(instance.kind->states[i].name),
                ts_.state_expr(states[i]));
    }
  }

  /// Time passes before the first rung: every running clock grows by dt.
  void tick_clocks() {
    for (State& state : ts_.states) {
      const ExprId now = ts_.of(state.var);
      if (!state.clock) {
        element_.push_back(now);
        continue;
      }
      if (may_stop_) {
        state.running =
            exprs().conjunction(state.running, exprs().negation(ts_.frozen));
      }
      // In steps: the order of arguments is the compiler's.
      const ExprId cap = exprs().word(state.cap);
      const ExprId next = exprs().add(now, ts_.of(ts_.dt));
      const ExprId grown = exprs().minimum(next, cap);
      element_.push_back(exprs().ite(state.running, grown, now));
    }
  }

  void run(const Rung& rung) {
    struct Guard {
      std::uint32_t target;
      ExprId outer;
    };
    std::vector<Guard> guards;
    ExprId executed = exprs().bit(true);
    for (std::uint32_t i = rung.begin; i < rung.end; ++i) {
      while (!guards.empty() && guards.back().target == i) {
        executed = guards.back().outer;
        guards.pop_back();
      }
      const Node& node = program_.nodes[i];
      if (node.op == NodeOp::Branch) {
        const ExprId left = value_[node.a];
        guards.push_back({node.target, executed});
        executed = exprs().conjunction(
            executed, node.skip_when ? exprs().negation(left) : left);
      } else if (node.op == NodeOp::Call) {
        value_[i] = call(node.call, executed);
      } else {
        value_[i] = term(node, executed);
      }
    }
    const ExprId value = value_[rung.root()];
    ts_.rung_value.push_back(value);
    cells_[rung.target.index()] = stored(rung, value);
  }

  /// A word that may leave its cell's range is a fault, and stored clamped.
  ExprId stored(const Rung& rung, ExprId value) {
    const Cell& cell = program_.cells[rung.target];
    if (cell.type == Type::Bit) return value;
    return within(value, cell.low, cell.high, exprs().bit(true), rung.target,
                  rung.where);
  }

  ExprId within(ExprId value, std::int64_t low, std::int64_t high,
                ExprId executed, CellId cell, SourceRange where) {
    const Expr expr = exprs()[value];
    if (expr.low >= low && expr.high <= high) return value;
    const ExprId lowest = exprs().word(low);
    const ExprId highest = exprs().word(high);
    const ExprId below = exprs().less(value, lowest);
    const ExprId above = exprs().less(highest, value);
    ts_.faults.push_back(
        {exprs().conjunction(executed, exprs().disjunction(below, above)), cell,
         where});
    const ExprId from_below = exprs().ite(below, lowest, value);
    const ExprId above_too = exprs().less(highest, from_below);
    return exprs().ite(above_too, highest, from_below);
  }

  /// Keeps arithmetic far from the bound above which terms have no width.
  ExprId small(ExprId value, const Node& node, ExprId executed) {
    constexpr std::int64_t kLimit = std::int64_t{1} << 29;
    return within(value, -kLimit, kLimit, executed, {}, node.where);
  }

  ExprId term(const Node& node, ExprId executed) {
    const ExprId a = value_[node.a];
    const ExprId b = value_[node.b];
    switch (node.op) {
      case NodeOp::Constant:
        return node.type == Type::Bit ? exprs().bit(node.value != 0)
                                      : exprs().word(node.value);
      case NodeOp::Read:
        return cells_[node.cell.index()];
      case NodeOp::Not:
        return exprs().negation(a);
      case NodeOp::And:
        return exprs().conjunction(a, b);
      case NodeOp::Or:
        return exprs().disjunction(a, b);
      case NodeOp::Xor:
        return exprs().exclusive_or(a, b);
      case NodeOp::Equal:
        return exprs().equal(a, b);
      case NodeOp::NotEqual:
        return exprs().negation(exprs().equal(a, b));
      case NodeOp::Less:
        return exprs().less(a, b);
      case NodeOp::LessEqual:
        return exprs().less_equal(a, b);
      case NodeOp::Greater:
        return exprs().less(b, a);
      case NodeOp::GreaterEqual:
        return exprs().less_equal(b, a);
      case NodeOp::Add:
      case NodeOp::Subtract:
      case NodeOp::Multiply:
      case NodeOp::Divide:
      case NodeOp::Negate:
      case NodeOp::Wrap16:
      case NodeOp::Wrap:
      case NodeOp::ToWord:
      case NodeOp::ToBit:
        return word_term(node, executed);
      case NodeOp::Call:
      case NodeOp::Branch:
        break;
    }
    assert(false && "calls and branches are handled by run()");
    return a;
  }

  ExprId word_term(const Node& node, ExprId executed) {
    const ExprId a = value_[node.a];
    const ExprId b = value_[node.b];
    switch (node.op) {
      case NodeOp::Add:
        return exprs().add(bounded(a, node, executed),
                           bounded(b, node, executed));
      case NodeOp::Subtract:
        return exprs().subtract(bounded(a, node, executed),
                                bounded(b, node, executed));
      case NodeOp::Multiply:
        return multiply(a, b, node, executed);
      case NodeOp::Divide:
        return exprs().divide(a, exprs()[b].value);
      case NodeOp::Negate:
        return exprs().negate(a);
      case NodeOp::Wrap16:
        return exprs().wrap16(a);
      case NodeOp::Wrap:
        return exprs().wrap(a, node.value < 0 ? -node.value : node.value,
                            node.value < 0);
      case NodeOp::ToWord:
        return exprs().to_word(a);
      default:
        return exprs().to_bit(a);
    }
  }

  ExprId bounded(ExprId value, const Node& node, ExprId executed) {
    constexpr std::int64_t kLimit = std::int64_t{1} << 59;
    return within(value, -kLimit, kLimit, executed, {}, node.where);
  }

  ExprId multiply(ExprId a, ExprId b, const Node& node, ExprId executed) {
    const __int128 largest_a = largest(a);
    const __int128 largest_b = largest(b);
    constexpr std::int64_t kLimit = std::int64_t{1} << 59;
    if (largest_a * largest_b <= kLimit) return exprs().multiply(a, b);
    return exprs().multiply(small(a, node, executed), small(b, node, executed));
  }

  std::int64_t largest(ExprId id) {
    const Expr& expr = exprs()[id];
    return std::max(-expr.low, expr.high);
  }

  const ParsedOperation& parsed_operation(const ElementOperation& operation) {
    const auto [entry, is_new] = operations_.try_emplace(&operation);
    if (is_new) {
      for (const ElementUpdate& update : operation.updates) {
        entry->second.updates.push_back(parsed(update.value));
      }
      entry->second.result = parsed(operation.result);
    }
    return entry->second;
  }

  static std::uint32_t position_of(const Instance& instance,
                                   std::string_view state) {
    const std::span<const ElementState> states = instance.kind->states;
    for (std::uint32_t i = 0; i < states.size(); ++i) {
      if (states[i].name == state) return i;
    }
    return kNoState;
  }

  void name_operands(const ElementCall& call, StepNames& names) {
    names.set("p", exprs().word(call.parameter));
    names.set("longest", exprs().word(ts_.scan.max_ms));
    std::size_t argument = 0;
    for (const ElementParameter& parameter : call.operation->parameters) {
      if (parameter.kind != ParameterKind::Bit &&
          parameter.kind != ParameterKind::Word) {
        continue;
      }
      names.set(std::string(parameter.name),
                value_[call.arguments[argument++]]);
    }
  }

  ExprId call(CallId id, ExprId executed) {
    const ElementCall& call = program_.calls[id];
    const Instance& instance = program_.instances[call.instance];
    const std::vector<std::uint32_t>& states =
        ts_.instance_states[call.instance.index()];
    StepNames names(ts_, instance.name);
    name_operands(call, names);
    std::vector<ExprId> after;
    for (std::size_t i = 0; i < states.size(); ++i) {
      const std::string name(instance.kind->states[i].name);
      after.push_back(element_[states[i]]);
      names.set(name, after.back());
      names.set(name + "'", after.back());
    }
    const ParsedOperation& operation = parsed_operation(*call.operation);
    for (std::size_t i = 0; i < operation.updates.size(); ++i) {
      const std::string_view state = call.operation->updates[i].state;
      const ExprId value =
          compile_formula(exprs(), operation.updates[i], names);
      const std::uint32_t position = position_of(instance, state);
      const bool is_state = position != kNoState;
      names.set(std::string(state) + (is_state ? "'" : ""), value);
      if (is_state) after[position] = value;
    }
    const ExprId result = compile_formula(exprs(), operation.result, names);
    for (std::size_t i = 0; i < states.size(); ++i) {
      ExprId& now = element_[states[i]];
      now = exprs().ite(executed, after[i], now);
    }
    ts_.call_executed[id.index()] = executed;
    ts_.call_value[id.index()] =
        call.operation->word ? exprs().ite(executed, result, exprs().word(0))
                             : exprs().conjunction(executed, result);
    return result;
  }

  void finish() {
    for (const CellId id : ids_of(program_.cells)) {
      const std::uint32_t state = cell_state_[id.index()];
      if (state != kNoState) ts_.states[state].next = cells_[id.index()];
    }
    for (const std::vector<std::uint32_t>& states : ts_.instance_states) {
      for (const std::uint32_t state : states) {
        ts_.states[state].next = element_[state];
      }
    }
    ts_.cell_end = std::move(cells_);
    ts_.node_value = std::move(value_);
  }

  static constexpr std::uint32_t kNoState = 0xffff'ffff;

  const Program& program_;
  bool may_stop_;
  ExprId held_;  // the inputs are those of the scan before
  std::unordered_map<std::string, ExprId> first_sample_;  // by input
  TransitionSystem ts_;
  std::vector<ExprId> cells_;              // values so far, by CellId
  std::vector<std::uint32_t> cell_state_;  // by CellId
  std::vector<ExprId> element_;            // values so far, by state
  std::vector<ExprId> value_;              // by node
  std::unordered_map<const ElementOperation*, ParsedOperation> operations_;
};

}  // namespace

TransitionSystem build_transition_system(const Program& program) {
  return Builder(program, Builder::Time::Passes).build();
}

TransitionSystem build_freezing_system(const Program& program) {
  return Builder(program, Builder::Time::MayStop).build();
}

}  // namespace rung
