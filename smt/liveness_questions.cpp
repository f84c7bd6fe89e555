#include "smt/liveness_questions.h"

namespace rung {
namespace {

/// Bits that are set while a loop goes round, and what has to hold at its end.
class LoopMaker {
 public:
  LoopMaker(const TransitionSystem& ts, const Recurrence& asked, Loops loops)
      : base_(ts), asked_(asked), loops_(loops) {
    question_.ts = ts;
    question_.engine =
        loops == Loops::Exactly ? "loop search" : "loops of bits";
  }

  LivenessQuestion make() {
    begin();
    // A goal spoils it, and `fair` has to come.
    question_.bad = exprs().conjunction(
        inside_, exprs().negation(met(".goal", asked_.goal)));
    if (asked_.fair.has_value()) require(met(".fair", asked_.fair));
    const std::vector<bool> cone = cone_of(base_, asked_);
    for (const State& state : base_.states) {
      if (cone[state.var.index()]) close(state);
    }
    return std::move(question_);
  }

 private:
  TransitionSystem& ts() { return question_.ts; }
  ExprArena& exprs() { return question_.ts.exprs; }

  void begin() {
    question_.save = ts().add_input(".save", VarRole::Choice, Type::Bit, 0, 1);
    const std::uint32_t state = ts().add_state(".loop", Type::Bit, 0, 1, 0);
    begun_ = ts().state_expr(state);
    inside_ = exprs().disjunction(begun_, ts().of(question_.save));
    ts().states[state].next = inside_;
  }

  void require(ExprId condition) {
    question_.bad = exprs().conjunction(question_.bad, condition);
  }

  /// Was it true at the end of a scan of the loop, by this one's?
  ExprId met(std::string name, ExprId condition) {
    const std::uint32_t state =
        ts().add_state(std::move(name), Type::Bit, 0, 1, 0);
    const ExprId by_now = exprs().conjunction(
        inside_, exprs().disjunction(ts().state_expr(state), condition));
    ts().states[state].next = by_now;
    return by_now;
  }

  /// The state as it was when the loop began is the state as it is.
  void close(const State& state) {
    const Variable var = base_.vars[state.var];
    if (loops_ == Loops::OfBits && state.clock) return close_clock(state);
    if (loops_ == Loops::OfBits && var.type == Type::Word) {
      return close_number(state);
    }
    const std::uint32_t copy = ts().add_state(".saved." + var.name, var.type,
                                              var.low, var.high, state.init);
    const ExprId kept =
        exprs().ite(begun_, ts().state_expr(copy), base_.of(state.var));
    ts().states[copy].next = kept;
    require(exprs().equal(state.next, kept));
  }

  void close_number(const State& state) {
    const std::string& name = base_.vars[state.var].name;
    const ExprId now = base_.of(state.var);
    const ExprId up = met(".up." + name, exprs().less(now, state.next));
    const ExprId down = met(".down." + name, exprs().less(state.next, now));
    require(exprs().negation(exprs().exclusive_or(up, down)));
  }

  void close_clock(const State& state) {
    const std::string& name = base_.vars[state.var].name;
    const ExprId cap = exprs().word(state.cap);
    const ExprId later = exprs().minimum(
        exprs().add(base_.of(state.var), base_.of(base_.dt)), cap);
    const ExprId grows = exprs().equal(state.next, later);
    const ExprId rested = met(".rest." + name, exprs().negation(grows));
    require(exprs().disjunction(rested, exprs().equal(state.next, cap)));
  }

  const TransitionSystem& base_;
  const Recurrence& asked_;
  Loops loops_;
  LivenessQuestion question_;
  ExprId begun_;   // in a scan before
  ExprId inside_;  // in this scan or before
};

}  // namespace

std::vector<bool> cone_of(const TransitionSystem& ts, const Recurrence& asked) {
  std::vector<ExprId> roots = {asked.goal};
  if (asked.fair.has_value()) roots.push_back(asked.fair);
  return cone_of_influence(ts, roots);
}

/// With every `fair` a wait begins, if there is none; a goal ends it.
LivenessQuestion ask_response(const TransitionSystem& ts,
                              const Recurrence& asked, std::int64_t time) {
  LivenessQuestion question;
  question.ts = ts;
  question.engine = "response in " + std::to_string(time) + " ms";
  TransitionSystem& with = question.ts;
  ExprArena& e = with.exprs;
  const ExprId no_goal = e.negation(asked.goal);
  ExprId waiting = e.bit(true);
  if (asked.fair.has_value()) {
    const std::uint32_t state = with.add_state(".waiting", Type::Bit, 0, 1, 0);
    waiting = with.state_expr(state);
    with.states[state].next =
        e.conjunction(e.disjunction(waiting, asked.fair), no_goal);
  }
  const std::uint32_t clock =
      with.add_clock(".waited", e.negation(waiting), time);
  with.states[clock].running = waiting;
  const ExprId waited = with.states[clock].next;
  with.states[clock].next = e.ite(asked.goal, e.word(0), waited);
  question.bad = e.conjunction(no_goal, e.less_equal(e.word(time), waited));
  return question;
}

LivenessQuestion ask_count(const TransitionSystem& ts, const Recurrence& asked,
                           std::int64_t time, std::int64_t most) {
  LivenessQuestion question;
  question.ts = ts;
  question.engine = "k-liveness k=" + std::to_string(most);
  TransitionSystem& with = question.ts;
  ExprArena& e = with.exprs;
  const ExprId no_goal = e.negation(asked.goal);
  ExprId moment = no_goal;
  if (asked.fair.has_value()) moment = e.conjunction(moment, asked.fair);
  if (time > 0) {
    const std::uint32_t clock = with.add_clock(".waited", e.bit(false), time);
    const ExprId waited = with.states[clock].next;
    moment = e.conjunction(moment, e.less_equal(e.word(time), waited));
    with.states[clock].next =
        e.ite(e.disjunction(asked.goal, moment), e.word(0), waited);
    question.engine += " every " + std::to_string(time) + " ms";
  }
  const std::uint32_t count =
      with.add_state(".waits", Type::Word, 0, most + 1, 0);
  const ExprId more = e.minimum(
      e.add(with.state_expr(count), e.to_word(moment)), e.word(most + 1));
  with.states[count].next = e.ite(no_goal, more, e.word(0));
  question.bad = e.equal(with.states[count].next, e.word(most + 1));
  return question;
}

LivenessQuestion ask_loop(const TransitionSystem& ts, const Recurrence& asked,
                          Loops loops) {
  return LoopMaker(ts, asked, loops).make();
}

}  // namespace rung
