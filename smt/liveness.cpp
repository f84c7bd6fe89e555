#include "smt/liveness.h"

#include <algorithm>
#include <utility>

#include "smt/faults.h"

namespace rung {
namespace {

using Status = Target::Status;

/// A copy of the system with monitors, and the term that is asked of it.
struct Question {
  TransitionSystem ts;
  ExprId bad;
  VarId save;  // of a loop
  std::string engine;
};

constexpr std::int64_t kPerHandOver = 4;  // scans from timer to timer, guessed

/// As long as all timers below take one after the other, and some scans; 0
/// where there are none. Too short a time is no wrong answer: it proves less.
std::int64_t time_of_timers(const TransitionSystem& ts,
                            const std::vector<bool>& cone) {
  std::int64_t time = 0;
  for (const State& state : ts.states) {
    if (!state.clock || !cone[state.var.index()]) continue;
    time += state.cap + kPerHandOver * ts.scan.max_ms;
  }
  return time == 0 ? 0 : time + 2 * kPerHandOver * ts.scan.max_ms;
}

std::vector<bool> cone_of(const TransitionSystem& ts, const Recurrence& asked) {
  std::vector<ExprId> roots = {asked.goal};
  if (asked.fair.has_value()) roots.push_back(asked.fair);
  return cone_of_influence(ts, roots);
}

/// With every `fair` a wait begins, if there is none; a goal ends it.
Question responding(const TransitionSystem& ts, const Recurrence& asked,
                    std::int64_t time) {
  Question question;
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
  const ExprId waited = with.states[clock].next;
  with.states[clock].next = e.ite(asked.goal, e.word(0), waited);
  question.bad = e.conjunction(no_goal, e.less_equal(e.word(time), waited));
  return question;
}

Question counting(const TransitionSystem& ts, const Recurrence& asked,
                  std::int64_t time, std::int64_t most) {
  Question question;
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

/// The states of `cone` are written down when a scan begins and are the same
/// when one ends.
Question looping(const TransitionSystem& ts, const std::vector<bool>& cone,
                 const Recurrence& asked) {
  Question question;
  question.ts = ts;
  question.engine = "loop search";
  TransitionSystem& with = question.ts;
  ExprArena& e = with.exprs;
  question.save = with.add_input(".save", VarRole::Choice, Type::Bit, 0, 1);
  const std::uint32_t inside = with.add_state(".loop", Type::Bit, 0, 1, 0);
  const ExprId saved = with.state_expr(inside);
  const ExprId save = with.of(question.save);
  const ExprId now = e.disjunction(saved, save);
  with.states[inside].next = now;
  // Once in the loop: a goal spoils it, and `fair` has to come.
  const std::uint32_t spoilt = with.add_state(".goal", Type::Bit, 0, 1, 0);
  const ExprId goal =
      e.conjunction(now, e.disjunction(with.state_expr(spoilt), asked.goal));
  with.states[spoilt].next = goal;
  question.bad = e.conjunction(now, e.negation(goal));
  if (asked.fair.has_value()) {
    const std::uint32_t seen = with.add_state(".fair", Type::Bit, 0, 1, 0);
    const ExprId fair =
        e.conjunction(now, e.disjunction(with.state_expr(seen), asked.fair));
    with.states[seen].next = fair;
    question.bad = e.conjunction(question.bad, fair);
  }
  for (std::size_t i = 0; i < ts.states.size(); ++i) {
    const State& state = ts.states[i];
    if (!cone[state.var.index()]) continue;
    const Variable& var = ts.vars[state.var];
    const std::uint32_t copy = with.add_state(".saved." + var.name, var.type,
                                              var.low, var.high, state.init);
    const ExprId kept = e.ite(saved, with.state_expr(copy), ts.of(state.var));
    with.states[copy].next = kept;
    question.bad = e.conjunction(question.bad, e.equal(state.next, kept));
  }
  return question;
}

enum class Effort : std::uint8_t { Little, Much };

class Liveness {
 public:
  Liveness(const TransitionSystem& ts, const Recurrence& asked,
           const PortfolioOptions& options)
      : ts_(ts), asked_(asked), options_(options), cone_(cone_of(ts, asked)) {
    answer_.reason = "neither a proof nor a loop was found";
  }

  LivenessAnswer decide(Patience patience) {
    const std::int64_t time =
        ts_.scan.min_ms > 0 ? time_of_timers(ts_, cone_) : 0;
    const bool done =
        patience == Patience::Short ? decide_soon(time) : decide_late(time);
    if (!done && options_.deadline->passed()) answer_.reason = "out of time";
    return std::move(answer_);
  }

  LivenessAnswer decide_loop() {
    if (!ask_loop(Effort::Little)) ask_loop(Effort::Much);
    return std::move(answer_);
  }

 private:
  bool decide_soon(std::int64_t time) {
    return ask_loop(Effort::Little) || ask_count(0, 1, Effort::Little) ||
           ask_count(0, 2, Effort::Little) ||
           (time > 0 && ask_response(time, Effort::Little));
  }

  bool decide_late(std::int64_t time) {
    if (time > 0) {
      if (ask_response(time, Effort::Much)) return true;
      if (ask_count(time, 1, Effort::Much)) return true;
    }
    const std::int64_t counts = asked_.counts;
    if (counts > 0 && ask_count(time, counts + 1, Effort::Much)) return true;
    if (ask_loop(Effort::Much)) return true;
    for (std::int64_t k = 2; k <= 16; k *= 2) {
      if (ask_count(time, k, Effort::Much)) return true;
      if (time > 0 && ask_count(0, k, Effort::Much)) return true;
    }
    return false;
  }

  /// A bound that is exceeded says nothing.
  bool ask_response(std::int64_t time, Effort effort) {
    Question question = responding(ts_, asked_, time);
    return ask(question, effort).status == Status::Unreachable;
  }
  bool ask_count(std::int64_t time, std::int64_t most, Effort effort) {
    Question question = counting(ts_, asked_, time, most);
    return ask(question, effort).status == Status::Unreachable;
  }

  bool ask_loop(Effort effort) {
    Question question = looping(ts_, cone_, asked_);
    Target target = ask(question, effort);
    if (target.status == Status::Open) return false;
    if (target.status == Status::Unreachable) return true;
    cut(question, target.run);
    answer_.kind = LivenessAnswer::Kind::Loops;
    answer_.engine = question.engine + ", " + std::string(target.engine);
    return true;
  }

  /// Where the state is written down the loop begins.
  void cut(const Question& question, const FoundRun& run) {
    const auto place =
        std::find(run.inputs.begin(), run.inputs.end(), question.save);
    const auto column = static_cast<std::size_t>(place - run.inputs.begin());
    const auto begin = std::find_if(
        run.steps.begin(), run.steps.end(),
        [&](const RunStep& step) { return step.inputs[column] != 0; });
    answer_.stem = {run.inputs, {run.steps.begin(), begin}};
    answer_.loop = {run.inputs, {begin, run.steps.end()}};
    if (!answer_.loop.steps.empty()) answer_.loop.steps.back().delta = 0;
    for (FoundRun* const part : {&answer_.stem, &answer_.loop}) {
      part->inputs.erase(part->inputs.begin() +
                         static_cast<std::ptrdiff_t>(column));
      for (RunStep& step : part->steps) {
        step.inputs.erase(step.inputs.begin() +
                          static_cast<std::ptrdiff_t>(column));
      }
    }
  }

  static Target target(TransitionSystem& ts, ExprId term,
                       Target::Purpose purpose) {
    Target target;
    target.term = term;
    target.never = ts.exprs.negation(term);
    target.purpose = purpose;
    return target;
  }

  /// Asks the engines; a proof goes into the answer.
  Target ask(Question& question, Effort effort) {
    TransitionSystem& ts = question.ts;
    std::vector<Target> targets;
    targets.push_back(target(ts, question.bad, Target::Purpose::Violation));
    targets.front().hidden = !question.save.has_value();
    for (const std::size_t fault : faults_under(ts, question.bad)) {
      targets.push_back(
          target(ts, ts.faults[fault].condition, Target::Purpose::Fault));
      targets.back().hidden = true;
    }
    std::vector<Target*> pointers;
    pointers.reserve(targets.size());
    for (Target& one : targets) pointers.push_back(&one);
    const std::vector<ExprId> growth = growth_terms(ts);
    // No question takes all the time that others may do without.
    constexpr double kShare = 0.4;
    const Deadline deadline = options_.deadline->part(kShare);
    PortfolioOptions options = options_;
    options.deadline = &deadline;
    constexpr std::uint32_t kShallow = 12;
    if (effort == Effort::Little) {
      options.max_depth = std::min(options.max_depth, kShallow);
    }
    if (options_.deadline->passed()) return std::move(targets.front());
    Portfolio portfolio(ts, growth, std::move(pointers), options);
    if (portfolio.cone().circuit().overflow()) {
      answer_.reason = "a number in it has no bound that fits 62 bits";
      return std::move(targets.front());
    }
    if (effort == Effort::Little) {
      portfolio.sketch();
    } else {
      portfolio.run();
    }
    conclude(question, targets, portfolio.invariant());
    return std::move(targets.front());
  }

  void conclude(Question& question, std::vector<Target>& targets,
                const Invariant& invariant) {
    if (targets.front().status != Status::Unreachable) return;
    LivenessProof proof;
    for (std::size_t i = 1; i < targets.size(); ++i) {
      proof.no_faults.push_back(targets[i].never);
      if (targets[i].status == Status::Unreachable) continue;
      targets.front().status = Status::Open;
      answer_.reason =
          "a number in it may leave the range in which it is exact";
      return;
    }
    answer_.kind = LivenessAnswer::Kind::Always;
    answer_.engine =
        question.engine + ", " + std::string(targets.front().engine);
    proof.never = targets.front().never;
    proof.invariant = invariant;
    proof.ts = std::move(question.ts);
    answer_.proof = std::move(proof);
  }

  const TransitionSystem& ts_;
  const Recurrence& asked_;
  PortfolioOptions options_;
  std::vector<bool> cone_;
  LivenessAnswer answer_;
};

}  // namespace

LivenessAnswer decide_recurrence(const TransitionSystem& ts,
                                 const Recurrence& asked, Patience patience,
                                 const PortfolioOptions& options) {
  return Liveness(ts, asked, options).decide(patience);
}

LivenessAnswer decide_fairness(const TransitionSystem& ts, ExprId fair,
                               const PortfolioOptions& options) {
  TransitionSystem without_goal = ts;
  const Recurrence asked = {without_goal.exprs.bit(false), fair, 0};
  return Liveness(without_goal, asked, options).decide_loop();
}

}  // namespace rung
