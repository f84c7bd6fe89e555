#include <algorithm>
#include <string>
#include <utility>

#include "analysis/property.h"
#include "analysis/property_line.h"
#include "analysis/property_terms.h"

namespace rung {
namespace {

/// Lowers properties to conditions at scan ends, with monitors in the
/// transition system for what a condition has to remember.
class ObligationMaker {
 public:
  ObligationMaker(const Program& program, const PropertySet& properties,
                  TransitionSystem& ts)
      : program_(program),
        properties_(properties),
        ts_(ts),
        terms_(program, ts) {}

  std::vector<Obligation> make() {
    for (const std::string& assumption : properties_.assumptions) {
      ts_.constraints.push_back(terms_.term(assumption));
    }
    const bool freezes = ts_.frozen.has_value();
    for (; at_ < properties_.properties.size(); ++at_) {
      const bool settles = property().form == Property::Form::Settles;
      if (settles == freezes) lower();
    }
    return std::move(obligations_);
  }

 private:
  const Property& property() const { return properties_.properties[at_]; }
  ExprArena& exprs() { return ts_.exprs; }

  /// One more, up to `most`. In steps: the order in which arguments are made is
  /// the compiler's, and numbers of terms follow it.
  ExprId counted(ExprId count, std::int64_t most) {
    const ExprId next = exprs().add(count, exprs().word(1));
    return exprs().minimum(next, exprs().word(most));
  }
  ExprId formula(std::size_t number) {
    return terms_.term(property().formulas[number]);
  }
  std::string monitor(std::string_view what) const {
    return property().name + "." + std::string(what);
  }

  Obligation& add(Goal goal, ExprId condition, ExprId trigger = {}) {
    Obligation obligation;
    obligation.name = property().name;
    obligation.kind =
        property().built_in ? "built-in" : to_string(property().form);
    obligation.text = property().text;
    obligation.where = property().where;
    obligation.goal = goal;
    obligation.condition = condition;
    obligation.trigger = trigger;
    obligation.property = static_cast<std::uint32_t>(at_);
    obligation.built_in = property().built_in;
    obligations_.push_back(std::move(obligation));
    return obligations_.back();
  }

  void lower() {
    switch (property().form) {
      case Property::Form::Always:
        add(Goal::Invariant, formula(0),
            terms_.left_side(property().formulas[0]));
        return;
      case Property::Form::Never:
        add(Goal::Invariant, exprs().negation(formula(0)));
        return;
      case Property::Form::Reach:
        add(Goal::Reach, formula(0));
        return;
      case Property::Form::Recoverable:
        add(Goal::Recover, formula(0));
        return;
      case Property::Form::Interlock:
        return interlock();
      case Property::Form::Latch:
        return latch();
      case Property::Form::After:
        if (property().absent) {
          return property().scans >= 0 ? none_for_scans() : none_for_time();
        }
        return property().scans >= 0 ? within_scans() : within_time();
      case Property::Form::For:
        return held();
      case Property::Form::OnlyAfter:
        return only_after();
      case Property::Form::Settles:
        return settles();
      case Property::Form::Eventually:
        return eventually();
    }
  }

  /// Each pair, in linear size: with every signal, none of those before it.
  void interlock() {
    std::vector<ExprId> signals;
    for (std::size_t i = 0; i < property().formulas.size(); ++i) {
      signals.push_back(formula(i));
    }
    ExprId condition = exprs().bit(true);
    ExprId any = exprs().bit(false);
    for (const ExprId signal : signals) {
      const ExprId both = exprs().conjunction(any, signal);
      condition = exprs().conjunction(condition, exprs().negation(both));
      any = exprs().disjunction(any, signal);
    }
    if (property().milliseconds > 0) {
      condition = exprs().conjunction(condition, off_time(signals));
    }
    add(Goal::Invariant, condition);
  }

  /// Where a signal is true, every other one has been false for the gap.
  ExprId off_time(const std::vector<ExprId>& signals) {
    const std::int64_t gap = property().milliseconds;
    std::vector<ExprId> long_off;
    for (std::size_t i = 0; i < signals.size(); ++i) {
      const std::uint32_t clock = ts_.add_clock(
          monitor("off" + std::to_string(i + 1)), signals[i], gap);
      ts_.states[clock].init = gap;  // never true yet
      long_off.push_back(
          exprs().less_equal(exprs().word(gap), ts_.states[clock].next));
    }
    // rest[i]: all after signal i.
    std::vector<ExprId> rest(signals.size(), exprs().bit(true));
    for (std::size_t i = signals.size() - 1; i-- > 0;) {
      rest[i] = exprs().conjunction(rest[i + 1], long_off[i + 1]);
    }
    ExprId condition = exprs().bit(true);
    ExprId first = exprs().bit(true);  // all before signal i
    for (std::size_t i = 0; i < signals.size(); ++i) {
      const ExprId others = exprs().conjunction(first, rest[i]);
      condition = exprs().conjunction(condition,
                                      exprs().implication(signals[i], others));
      first = exprs().conjunction(first, long_off[i]);
    }
    return condition;
  }

  void latch() {
    const ExprId q = formula(0);
    const ExprId set = formula(1);
    const ExprId reset = formula(2);
    const ExprId before = terms_.before(property().formulas[0]);
    const ExprId no_set = exprs().negation(set);
    const ExprId no_reset = exprs().negation(reset);
    const ExprId rises = exprs().conjunction(q, exprs().negation(before));
    const bool dominant_set = property().dominant_set;
    latch_part(0, Goal::Reach, rises, {});
    latch_implication(
        1, dominant_set ? set : exprs().conjunction(set, no_reset), q);
    latch_implication(2, exprs().conjunction(before, no_reset), q);
    // Where it is off, it is released.
    latch_part(3, Goal::Recover, exprs().negation(q), q);
    latch_implication(4,
                      dominant_set ? exprs().conjunction(reset, no_set) : reset,
                      exprs().negation(q));
    latch_implication(5, rises, set);
  }

  Obligation& latch_part(std::uint32_t part, Goal goal, ExprId condition,
                         ExprId trigger) {
    Obligation& obligation = add(goal, condition, trigger);
    obligation.name += "." + std::string(kLatchParts[part]);
    obligation.part = part;
    return obligation;
  }
  void latch_implication(std::uint32_t part, ExprId left, ExprId right) {
    latch_part(part, Goal::Invariant, exprs().implication(left, right), left);
  }

  /// after P, Q within N scans: `age` counts from the oldest P without answer,
  /// 1 at its own scan end; 0 is none.
  void within_scans() {
    const std::int64_t limit = property().scans + 1;
    const ExprId cause = formula(0);
    const ExprId answer = formula(1);
    const std::uint32_t state =
        ts_.add_state(monitor("age"), Type::Word, 0, limit, 0);
    const ExprId age = ts_.state_expr(state);
    const ExprId older = counted(age, limit);
    const ExprId idle = exprs().equal(age, exprs().word(0));
    const ExprId waiting = exprs().ite(idle, exprs().to_word(cause), older);
    ts_.states[state].next = exprs().ite(answer, exprs().word(0), waiting);
    add(Goal::Invariant,
        exprs().less(ts_.states[state].next, exprs().word(limit)), cause);
  }

  /// after P, Q within N ms: false at the first scan end past the deadline of
  /// an unanswered P, even if Q is true there.
  void within_time() {
    const std::int64_t limit = property().milliseconds;
    const ExprId cause = formula(0);
    const ExprId answer = formula(1);
    const std::uint32_t state =
        ts_.add_state(monitor("pending"), Type::Bit, 0, 1, 0);
    const ExprId pending = ts_.state_expr(state);
    ts_.states[state].next = exprs().conjunction(
        exprs().disjunction(pending, cause), exprs().negation(answer));
    const std::uint32_t clock =
        ts_.add_clock(monitor("waited"), exprs().negation(pending), limit + 1);
    const ExprId late =
        exprs().less(exprs().word(limit), ts_.states[clock].next);
    add(Goal::Invariant, exprs().negation(exprs().conjunction(pending, late)),
        cause);
  }

  /// after P, no Q for N ms: a clock since the last P.
  void none_for_time() {
    const std::int64_t time = property().milliseconds;
    const ExprId cause = formula(0);
    const ExprId answer = formula(1);
    const std::uint32_t clock = ts_.add_clock(monitor("since"), cause, time);
    ts_.states[clock].init = time;  // never true yet
    const ExprId long_ago =
        exprs().less_equal(exprs().word(time), ts_.states[clock].next);
    add(Goal::Invariant, exprs().implication(answer, long_ago), cause);
  }

  /// after P, no Q for N scans: the scan ends since the last P.
  void none_for_scans() {
    const std::int64_t scans = property().scans;
    const ExprId cause = formula(0);
    const ExprId answer = formula(1);
    const std::uint32_t state =
        ts_.add_state(monitor("since"), Type::Word, 0, scans, scans);
    const ExprId older = counted(ts_.state_expr(state), scans);
    ts_.states[state].next = exprs().ite(cause, exprs().word(0), older);
    const ExprId long_ago =
        exprs().less_equal(exprs().word(scans), ts_.states[state].next);
    add(Goal::Invariant, exprs().implication(answer, long_ago), cause);
  }

  /// P for N ms implies Q: a clock since the first of the last scan ends with
  /// P.
  void held() {
    const std::int64_t time = property().milliseconds;
    const ExprId cause = formula(0);
    const ExprId answer = formula(1);
    ExprId long_enough = cause;
    if (time > 0) {
      // Not prev(P): before the first scan there is no scan end.
      const ExprId was = terms_.remembered(cause, 0, monitor("was"));
      const std::uint32_t clock = ts_.add_clock(
          monitor("held"), exprs().negation(exprs().conjunction(cause, was)),
          time);
      long_enough = exprs().conjunction(
          cause,
          exprs().less_equal(exprs().word(time), ts_.states[clock].next));
    }
    add(Goal::Invariant, exprs().implication(long_enough, answer), long_enough);
  }

  void only_after() {
    const ExprId q = formula(0);
    const ExprId p = formula(1);
    const std::uint32_t state =
        ts_.add_state(monitor("seen"), Type::Bit, 0, 1, 0);
    const ExprId seen = exprs().disjunction(ts_.state_expr(state), p);
    ts_.states[state].next = seen;
    add(Goal::Invariant, exprs().implication(q, seen), q);
  }

  /// settles within N scans: `rested` counts scans since time stopped. From
  /// the N-th on none leaves an output that is not as the one before left it.
  void settles() {
    const std::int64_t limit = property().scans + 1;
    const std::uint32_t state =
        ts_.add_state(monitor("rested"), Type::Word, 0, limit, 0);
    const ExprId older = counted(ts_.state_expr(state), limit);
    ts_.states[state].next = exprs().ite(ts_.frozen, older, exprs().word(0));
    ExprId same = exprs().bit(true);
    for (const CellId id : ids_of(program_.cells)) {
      if (program_.cells[id].role != CellRole::Output) continue;
      same = exprs().conjunction(same, exprs().equal(ts_.cell_begin[id.index()],
                                                     ts_.cell_end[id.index()]));
    }
    const ExprId rested =
        exprs().equal(ts_.states[state].next, exprs().word(limit));
    add(Goal::Invariant, exprs().implication(rested, same), rested);
  }

  /// eventually P given fair F, G: again and again is what each of them is when
  /// again and again all were true since all were. One needs no memory.
  void eventually() {
    const std::size_t count = property().formulas.size();
    if (count == 1) {
      add(Goal::Respond, formula(0));
      return;
    }
    ExprId all = formula(1);
    std::vector<std::pair<std::uint32_t, ExprId>> met;  // state, met by now
    for (std::size_t i = 1; count > 2 && i < count; ++i) {
      const std::uint32_t state =
          ts_.add_state(monitor("met" + std::to_string(i)), Type::Bit, 0, 1, 0);
      met.emplace_back(state,
                       exprs().disjunction(ts_.state_expr(state), formula(i)));
      all =
          i == 1 ? met[0].second : exprs().conjunction(all, met.back().second);
    }
    for (const auto& [state, by_now] : met) {
      ts_.states[state].next =
          exprs().conjunction(by_now, exprs().negation(all));
    }
    add(Goal::Respond, formula(0), all);
  }

  const Program& program_;
  const PropertySet& properties_;
  TransitionSystem& ts_;
  PropertyTerms terms_;
  std::size_t at_ = 0;  // the property at hand
  std::vector<Obligation> obligations_;
};

}  // namespace

std::vector<Obligation> make_obligations(const Program& program,
                                         const PropertySet& properties,
                                         TransitionSystem& ts) {
  return ObligationMaker(program, properties, ts).make();
}

}  // namespace rung
