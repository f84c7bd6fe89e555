#include "smt/liveness.h"

#include <algorithm>
#include <utility>

#include "smt/faults.h"

namespace rung {
namespace {

using Status = Target::Status;
using Question = LivenessQuestion;

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
    const bool done = find_loop(Effort::Little) ||
                      shown_by_bits(Effort::Little) ||
                      shown_by_bits(Effort::Much) || find_loop(Effort::Much);
    if (!done && options_.deadline->passed()) answer_.reason = "out of time";
    return std::move(answer_);
  }

 private:
  bool decide_soon(std::int64_t time) {
    return find_loop(Effort::Little) || shown_by_count(0, 1, Effort::Little) ||
           shown_by_count(0, 2, Effort::Little) ||
           shown_by_bits(Effort::Little) ||
           (time > 0 && shown_by_response(time, Effort::Little));
  }

  bool decide_late(std::int64_t time) {
    if (shown_by_bits(Effort::Much) || find_loop(Effort::Much)) return true;
    if (time > 0) {
      if (shown_by_response(time, Effort::Much)) return true;
      if (shown_by_count(time, 1, Effort::Much)) return true;
    }
    const std::int64_t counts = asked_.counts;
    if (counts > 0 && shown_by_count(time, counts + 1, Effort::Much)) {
      return true;
    }
    for (std::int64_t k = 2; k <= 16; k *= 2) {
      if (shown_by_count(time, k, Effort::Much)) return true;
      if (time > 0 && shown_by_count(0, k, Effort::Much)) return true;
    }
    return false;
  }

  /// A bound that is exceeded says nothing.
  bool shown_by_response(std::int64_t time, Effort effort) {
    Question question = ask_response(ts_, asked_, time);
    return ask(question, effort).status == Status::Unreachable;
  }
  bool shown_by_count(std::int64_t time, std::int64_t most, Effort effort) {
    Question question = ask_count(ts_, asked_, time, most);
    return ask(question, effort).status == Status::Unreachable;
  }
  bool shown_by_bits(Effort effort) {
    if (ts_.scan.min_ms < 1) return false;
    Question question = ask_loop(ts_, asked_, Loops::OfBits);
    question.save = {};
    return ask(question, effort).status == Status::Unreachable;
  }

  bool find_loop(Effort effort) {
    Question question = ask_loop(ts_, asked_, Loops::Exactly);
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
