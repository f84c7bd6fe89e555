#include <cstddef>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "mutant.h"

namespace rung {
namespace {

/// Changes one state; false: the mistake is not about it.
using StateChange = std::function<bool(TransitionSystem&, State&)>;

Mutant state_mutant(std::string name, StateChange change) {
  return {std::move(name),
          [change = std::move(change)](
              const Program& program) -> std::optional<Encoding> {
            Encoding result{program, build_transition_system(program)};
            bool changed = false;
            for (State& state : result.ts.states) {
              changed = change(result.ts, state) || changed;
            }
            if (!changed) return std::nullopt;
            return result;
          }};
}

void add_states(std::vector<Mutant>& result) {
  struct Group {
    std::string name;
    std::function<bool(const TransitionSystem&, const State&)> has;
  };
  const auto is_cell = [](const TransitionSystem& ts, const State& state) {
    return ts.vars[state.var].cell.has_value();
  };
  const auto is_bit = [](const TransitionSystem& ts, const State& state) {
    return ts.vars[state.var].type == Type::Bit;
  };
  const std::vector<Group> groups = {
      {"bit cells",
       [=](const auto& ts, const State& state) {
         return is_cell(ts, state) && is_bit(ts, state);
       }},
      {"word cells",
       [=](const auto& ts, const State& state) {
         return is_cell(ts, state) && !is_bit(ts, state);
       }},
      {"bits of elements",
       [=](const auto& ts, const State& state) {
         return !is_cell(ts, state) && is_bit(ts, state);
       }},
      {"clocks", [](const auto&, const State& state) { return state.clock; }},
      {"counts",
       [=](const auto& ts, const State& state) {
         return !is_cell(ts, state) && !is_bit(ts, state) && !state.clock;
       }},
  };
  for (const Group& group : groups) {
    result.push_back(
        state_mutant(group.name + " keep their old value",
                     [has = group.has](TransitionSystem& ts, State& state) {
                       if (!has(ts, state)) return false;
                       state.next = ts.of(state.var);
                       return true;
                     }));
    result.push_back(
        state_mutant(group.name + " start as 1",
                     [has = group.has](TransitionSystem& ts, State& state) {
                       if (!has(ts, state) || state.init != 0) return false;
                       state.init = 1;
                       return true;
                     }));
  }
}

void add_bounds(std::vector<Mutant>& result) {
  for (const int by : {-1, 1}) {
    const std::string off =
        by < 0 ? " is one smaller than it was" : " is one larger than it was";
    const auto count = [](const TransitionSystem& ts, const State& state) {
      const Variable& var = ts.vars[state.var];
      return var.type == Type::Word && !var.cell.has_value() && !state.clock;
    };
    result.push_back(state_mutant("the lowest value of counts" + off,
                                  [=](TransitionSystem& ts, State& state) {
                                    if (count(ts, state))
                                      ts.vars[state.var].low += by;
                                    return count(ts, state);
                                  }));
    result.push_back(state_mutant("the highest value of counts" + off,
                                  [=](TransitionSystem& ts, State& state) {
                                    if (count(ts, state))
                                      ts.vars[state.var].high += by;
                                    return count(ts, state);
                                  }));
  }
}

/// The new term for an old one whose operands are already new.
using TermChange = std::function<ExprId(ExprArena&, const Expr&)>;

ExprId rebuilt(ExprArena& exprs, const Expr& e) {
  switch (e.op) {
    case ExprOp::Constant:
      return e.type == Type::Bit ? exprs.bit(e.value != 0)
                                 : exprs.word(e.value);
    case ExprOp::Variable:
      return exprs.variable(e.var, e.type, e.low, e.high);
    case ExprOp::Not:
      return exprs.negation(e.a);
    case ExprOp::And:
      return exprs.conjunction(e.a, e.b);
    case ExprOp::Xor:
      return exprs.exclusive_or(e.a, e.b);
    case ExprOp::Equal:
      return exprs.equal(e.a, e.b);
    case ExprOp::Less:
      return exprs.less(e.a, e.b);
    case ExprOp::Add:
      return exprs.add(e.a, e.b);
    case ExprOp::Multiply:
      return exprs.multiply(e.a, e.b);
    case ExprOp::Divide:
      return exprs.divide(e.a, exprs[e.b].value);
    case ExprOp::Wrap16:
      return exprs.wrap16(e.a);
    case ExprOp::Ite:
      return exprs.ite(e.a, e.b, e.c);
  }
  return e.a;
}

/// All terms once more, the one at `position` changed.
class Rewriter {
 public:
  explicit Rewriter(TransitionSystem ts) : ts_(std::move(ts)) {}

  TransitionSystem run(std::size_t position, const TermChange& change) {
    const ExprArena old = std::exchange(ts_.exprs, ExprArena());
    for (std::size_t i = 0; i < old.size(); ++i) {
      Expr expr = old[ExprId(static_cast<std::uint32_t>(i))];
      for (ExprId* const operand : {&expr.a, &expr.b, &expr.c}) map(*operand);
      map_.push_back(i == position ? change(ts_.exprs, expr)
                                   : rebuilt(ts_.exprs, expr));
    }
    replace_roots();
    return std::move(ts_);
  }

 private:
  void map(ExprId& id) const {
    if (id.has_value()) id = map_[id.index()];
  }
  void replace_roots() {
    for (const VarId id : ids_of(ts_.vars)) map(ts_.vars[id].expr);
    for (State& state : ts_.states) {
      map(state.next);
      map(state.running);
    }
    for (std::vector<ExprId>* const roots :
         {&ts_.cell_end, &ts_.cell_begin, &ts_.rung_value, &ts_.node_value,
          &ts_.call_value, &ts_.call_executed, &ts_.constraints}) {
      for (ExprId& root : *roots) map(root);
    }
    for (Fault& fault : ts_.faults) map(fault.condition);
  }

  TransitionSystem ts_;
  std::vector<ExprId> map_;  // by old ExprId
};

struct TermMutant {
  const char* name;
  ExprOp op;
  Type type;  // of the term
  TermChange change;
};

const std::vector<TermMutant>& bit_terms() {
  static const std::vector<TermMutant> kMutants = {
      {"not is left out", ExprOp::Not, Type::Bit,
       [](ExprArena&, const Expr& e) { return e.a; }},
      {"and becomes or", ExprOp::And, Type::Bit,
       [](ExprArena& x, const Expr& e) { return x.disjunction(e.a, e.b); }},
      {"and becomes its first operand", ExprOp::And, Type::Bit,
       [](ExprArena&, const Expr& e) { return e.a; }},
      {"and becomes its second operand", ExprOp::And, Type::Bit,
       [](ExprArena&, const Expr& e) { return e.b; }},
      {"exclusive or becomes or", ExprOp::Xor, Type::Bit,
       [](ExprArena& x, const Expr& e) { return x.disjunction(e.a, e.b); }},
      {"exclusive or becomes equivalence", ExprOp::Xor, Type::Bit,
       [](ExprArena& x, const Expr& e) { return x.equivalence(e.a, e.b); }},
      {"= becomes <=", ExprOp::Equal, Type::Bit,
       [](ExprArena& x, const Expr& e) { return x.less_equal(e.a, e.b); }},
      {"= becomes >=", ExprOp::Equal, Type::Bit,
       [](ExprArena& x, const Expr& e) { return x.less_equal(e.b, e.a); }},
      {"< becomes <=", ExprOp::Less, Type::Bit,
       [](ExprArena& x, const Expr& e) { return x.less_equal(e.a, e.b); }},
      {"< has its operands exchanged", ExprOp::Less, Type::Bit,
       [](ExprArena& x, const Expr& e) { return x.less(e.b, e.a); }},
  };
  return kMutants;
}

// Truncation is towards zero; this is towards minus infinity.
ExprId divide_down(ExprArena& x, const Expr& e) {
  const std::int64_t divisor = x[e.b].value;
  const ExprId lower = x.add(e.a, x.word(divisor > 0 ? 1 - divisor : 0));
  return x.ite(x.less(e.a, x.word(0)), x.divide(lower, divisor),
               x.divide(e.a, divisor));
}

const std::vector<TermMutant>& word_terms() {
  static const std::vector<TermMutant> kMutants = {
      {"a constant is one larger", ExprOp::Constant, Type::Word,
       [](ExprArena& x, const Expr& e) { return x.word(e.value + 1); }},
      {"a constant is one smaller", ExprOp::Constant, Type::Word,
       [](ExprArena& x, const Expr& e) { return x.word(e.value - 1); }},
      {"+ becomes -", ExprOp::Add, Type::Word,
       [](ExprArena& x, const Expr& e) { return x.subtract(e.a, e.b); }},
      {"+ becomes its first operand", ExprOp::Add, Type::Word,
       [](ExprArena&, const Expr& e) { return e.a; }},
      {"+ becomes its second operand", ExprOp::Add, Type::Word,
       [](ExprArena&, const Expr& e) { return e.b; }},
      {"* becomes +", ExprOp::Multiply, Type::Word,
       [](ExprArena& x, const Expr& e) { return x.add(e.a, e.b); }},
      {"/ rounds down", ExprOp::Divide, Type::Word, divide_down},
      {"the 16-bit wrap is left out", ExprOp::Wrap16, Type::Word,
       [](ExprArena&, const Expr& e) { return e.a; }},
      {"a choice has its branches exchanged", ExprOp::Ite, Type::Word,
       [](ExprArena& x, const Expr& e) { return x.ite(e.a, e.c, e.b); }},
      {"a choice becomes its first branch", ExprOp::Ite, Type::Word,
       [](ExprArena&, const Expr& e) { return e.b; }},
      {"a choice becomes its second branch", ExprOp::Ite, Type::Word,
       [](ExprArena&, const Expr& e) { return e.c; }},
  };
  return kMutants;
}

std::optional<Encoding> encode(const TermMutant& mutant, bool last,
                               const Program& program) {
  TransitionSystem ts = build_transition_system(program);
  std::vector<std::size_t> places;
  for (std::size_t i = 0; i < ts.exprs.size(); ++i) {
    const Expr& expr = ts.exprs[ExprId(static_cast<std::uint32_t>(i))];
    if (expr.op == mutant.op && expr.type == mutant.type) places.push_back(i);
  }
  if (places.empty()) return std::nullopt;
  const std::size_t place = last ? places.back() : places.front();
  return Encoding{program, Rewriter(std::move(ts)).run(place, mutant.change)};
}

/// dt is a variable; here the clocks do not see its value.
Mutant time_mutant(std::string name,
                   std::function<ExprId(ExprArena&, ExprId)> change) {
  return {std::move(name),
          [change = std::move(change)](
              const Program& program) -> std::optional<Encoding> {
            TransitionSystem ts = build_transition_system(program);
            if (program.instances.empty()) return std::nullopt;
            const std::size_t place = ts.of(ts.dt).index();
            const auto term = [&change](ExprArena& exprs, const Expr& expr) {
              return change(exprs, rebuilt(exprs, expr));
            };
            return Encoding{program, Rewriter(std::move(ts)).run(place, term)};
          }};
}

}  // namespace

std::vector<Mutant> system_mutants() {
  std::vector<Mutant> result;
  add_states(result);
  add_bounds(result);
  result.push_back(time_mutant("time stands still",
                               [](ExprArena& x, ExprId) { return x.word(0); }));
  result.push_back(time_mutant(
      "a scan takes 1 ms more",
      [](ExprArena& x, ExprId dt) { return x.add(dt, x.word(1)); }));
  for (const auto* const terms : {&bit_terms(), &word_terms()}) {
    for (const TermMutant& mutant : *terms) {
      for (const bool last : {false, true}) {
        result.push_back(
            {std::string(last ? "the last term: " : "the first term: ") +
                 mutant.name,
             [&mutant, last](const Program& program) {
               return encode(mutant, last, program);
             }});
      }
    }
  }
  return result;
}

}  // namespace rung
