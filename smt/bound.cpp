#include "smt/bound.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdlib>
#include <utility>

#include "analysis/explanation.h"
#include "analysis/simulator.h"
#include "smt/run.h"
#include "smt/standstill.h"

namespace rung {
namespace {

constexpr std::int64_t kMostTime = std::int64_t{366} * 24 * 3'600'000;
constexpr std::uint64_t kExecuted = 20'000'000;  // rungs, to measure a run
constexpr std::uint64_t kHeldRungs = 1'000'000;  // rungs, to see how it ends
constexpr std::size_t kMostFlips = 32;           // inputs that are tried
constexpr int kMostRounds = 8;  // runs that are looked at for going round
constexpr double kShare = 0.5;  // of the time left, for one question
constexpr double kScansShare = 0.05;
constexpr int kMostSteps = 24;  // of galloping

std::size_t index(SpanUnit unit) { return static_cast<std::size_t>(unit); }

std::uint64_t executed_scans(const Program& program, std::uint64_t rungs) {
  return rungs / std::max<std::size_t>(program.rungs.size(), 1) + 1;
}

/// A run, and how long the wait is that it shows.
struct Shown {
  std::int64_t value = 0;
  Stimulus stimulus;  // ends with the wait; without steps: no run
};

/// Everything that was executed so far: by side and unit the run that goes
/// furthest.
class Evidence {
 public:
  Evidence(const Program& program, const PropertySet& properties,
           const ResponseQuestion& question)
      : program_(program),
        assumptions_(properties.assumptions),
        question_(question) {}

  const std::optional<Shown>& worst(SpanUnit unit) const {
    return worst_[index(unit)];
  }
  const std::optional<Shown>& best(SpanUnit unit) const {
    return best_[index(unit)];
  }
  /// A run from whose end Q never comes.
  const std::optional<Stimulus>& never() const { return never_; }
  const std::string& why_never() const { return why_never_; }

  void note(const Stimulus& stimulus) {
    measure(stimulus);
    // The same time in as many, and in as few scans as there can be.
    measure(at_pace(stimulus, program_.scan.min_ms));
    measure(at_pace(stimulus, program_.scan.max_ms));
  }

  /// What comes when the inputs stay as they are, or one of them changes.
  void go_on(const Stimulus& stimulus) {
    if (never_ || stimulus.steps.empty()) return;
    try_end(stimulus);
    std::size_t flips = 0;
    for (std::size_t i = 0; i < stimulus.inputs.size() && !never_; ++i) {
      const Cell& cell = program_.cells[stimulus.inputs[i]];
      if (cell.type != Type::Bit || ++flips > kMostFlips) continue;
      Stimulus other = stimulus;
      StimulusStep last = other.steps.back();
      last.repeat = 1;
      last.inputs[i] = last.inputs[i] == 0 ? 1 : 0;
      other.steps.push_back(std::move(last));
      try_end(std::move(other));
    }
  }

 private:
  void try_end(Stimulus stimulus) {
    Held held =
        hold(program_, assumptions_, question_, std::move(stimulus),
             program_.scan.max_ms, executed_scans(program_, kHeldRungs));
    if (held.end == Held::End::Answered) return note(held.stimulus);
    if (held.end == Held::End::Never) {
      never_ = std::move(held.stimulus);
      why_never_ = "nothing changes any more while the inputs stay";
      return;
    }
    go_round(held.stimulus);
  }

  /// Other parts of the program may never rest.
  void go_round(const Stimulus& stimulus) {
    if (!is_waiting(stimulus) || rounds_++ >= kMostRounds) return;
    if (!standstill_) standstill_.emplace(program_, assumptions_, question_);
    const std::uint64_t limit = executed_scans(program_, kHeldRungs);
    auto round = standstill_->find(stimulus, program_.scan.max_ms, limit);
    if (!round || !is_waiting(*round)) return;
    never_ = std::move(*round);
    why_never_ = "the inputs stay, and it goes round for ever";
  }

  /// Does the run end with a P that waits, as the simulator has it?
  bool is_waiting(const Stimulus& stimulus) const {
    const Waits waits =
        measure_waits(program_, assumptions_, question_, stimulus,
                      executed_scans(program_, kExecuted));
    return waits.valid && waits.open;
  }

  Stimulus at_pace(Stimulus stimulus, std::int64_t dt_ms) const {
    for (StimulusStep& step : stimulus.steps) {
      const std::int64_t time =
          step.dt_ms * static_cast<std::int64_t>(step.repeat);
      step.repeat = static_cast<std::uint64_t>((time + dt_ms - 1) / dt_ms);
      step.dt_ms = dt_ms;
    }
    return stimulus;
  }

  void measure(const Stimulus& stimulus) {
    const Waits waits =
        measure_waits(program_, assumptions_, question_, stimulus,
                      executed_scans(program_, kExecuted));
    if (!waits.valid) return;
    for (const SpanUnit unit : {SpanUnit::Milliseconds, SpanUnit::Scans}) {
      const std::size_t i = index(unit);
      keep(waits.longest[i], unit, true, stimulus, worst_[i]);
      keep(waits.shortest[i], unit, false, stimulus, best_[i]);
    }
  }

  static void keep(const Wait& wait, SpanUnit unit, bool longer,
                   const Stimulus& stimulus, std::optional<Shown>& kept) {
    if (wait.end == 0) return;
    const std::int64_t value = in(wait.span, unit);
    const bool further =
        !kept || (longer ? value > kept->value : value < kept->value);
    if (!further) return;
    kept = Shown{value, stimulus};
    cut_to(kept->stimulus, wait.end);
  }

  const Program& program_;
  const std::vector<std::string>& assumptions_;
  const ResponseQuestion& question_;
  std::array<std::optional<Shown>, 2> worst_;  // by SpanUnit
  std::array<std::optional<Shown>, 2> best_;
  std::optional<Stimulus> never_;
  std::string why_never_;
  std::optional<Standstill> standstill_;  // made when first needed
  int rounds_ = 0;
};

/// Asks verify() about one property, within what is left of the time.
class Asker {
 public:
  Asker(const Program& program, const PropertySet& properties,
        const ResponseQuestion& question, const VerifyOptions& options)
      : program_(program),
        properties_(properties),
        question_(question),
        options_(options),
        end_(Clock::now() +
             std::chrono::duration_cast<Clock::duration>(
                 std::chrono::duration<double>(options.budget.seconds))),
        evidence_(program, properties, question) {}

  const Program& program() const { return program_; }
  const ResponseQuestion& question() const { return question_; }
  Evidence& evidence() { return evidence_; }
  bool out_of_time() const { return Clock::now() >= end_; }
  std::vector<SelfCheckFailure> take_failures() { return std::move(failures_); }

  /// `share`: of the time that is left.
  ObligationResult ask(Property property, double share) {
    property.name = "bound";
    PropertySet set;
    set.assumptions = properties_.assumptions;
    set.properties.push_back(std::move(property));
    VerifyOptions options = options_;
    options.wanted = nullptr;
    const std::chrono::duration<double> left = end_ - Clock::now();
    options.budget.seconds = std::max(left.count() * share, 0.01);
    VerifyReport report = verify(program_, set, options);
    for (SelfCheckFailure& failure : report.failures) {
      failures_.push_back(std::move(failure));
    }
    return std::move(report.results.front());
  }

  /// What a run shows is noted; true when there is one.
  bool note_run(const ObligationResult& result) {
    if (!result.trace) return false;
    const Stimulus stimulus = stimulus_of(program_, *result.trace);
    evidence_.note(stimulus);
    return true;
  }

 private:
  using Clock = std::chrono::steady_clock;

  const Program& program_;
  const PropertySet& properties_;
  const ResponseQuestion& question_;
  const VerifyOptions& options_;
  Clock::time_point end_;
  Evidence evidence_;
  std::vector<SelfCheckFailure> failures_;
};

/// Searches for one number: the worst in one unit, or the best. Numbers of the
/// best are negated inside, so that what is proved is an upper bound, what is
/// shown a lower one.
class SpanSearch {
 public:
  enum class Side : std::uint8_t { Worst, Best };

  SpanSearch(Asker& asker, Side side, SpanUnit unit)
      : asker_(asker), side_(side), unit_(unit) {
    if (side == Side::Best) proved_ = 0;  // nothing comes before its cause
  }

  /// What follows from something else that was proved.
  void seed(std::int64_t value, const std::string& engine) {
    const std::int64_t claim = signed_value(value);
    if (proved_ && *proved_ <= claim) return;
    proved_ = claim;
    bound_.engine = engine;
    bound_.certificate.reset();
  }

  SpanBound run(std::int64_t most) {
    look();
    floor_ = shown_ ? *shown_ - 1 : -most - 1;
    while (open() && !asker_.out_of_time() && !unbounded()) {
      const std::optional<std::int64_t> claim = next(most);
      if (!claim) break;
      ask(*claim);
    }
    return conclude();
  }

 private:
  std::int64_t signed_value(std::int64_t value) const {
    return side_ == Side::Worst ? value : -value;
  }
  const std::optional<Shown>& evidence() const {
    return side_ == Side::Worst ? asker_.evidence().worst(unit_)
                                : asker_.evidence().best(unit_);
  }
  bool unbounded() const {
    return side_ == Side::Worst && asker_.evidence().never().has_value();
  }
  bool open() const { return !proved_ || floor_ + 1 < *proved_; }

  void look() {
    if (!evidence()) return;
    shown_ = signed_value(evidence()->value);
    floor_ = std::max(floor_, *shown_ - 1);
  }

  /// The claim to ask for. First that what is shown is the bound; then a little
  /// more, for scans start late and timers are late with them, and more and
  /// more while that is refuted. What was proved is halved, by turns with what
  /// is shown while it is far away.
  std::optional<std::int64_t> next(std::int64_t most) {
    const std::int64_t lowest = floor_ + 1;
    const std::int64_t near = unit_ == SpanUnit::Scans ? 4 : near_ms();
    if (unit_ == SpanUnit::Scans && std::abs(lowest) > kMostScans) return {};
    if (steps_++ == 0) return lowest;
    if (!proved_) {
      if (steps_ > kMostSteps || lowest >= most) return std::nullopt;
      reach_ = reach_ == 0 ? near : 4 * reach_;
      return std::min(lowest + reach_, most);
    }
    const std::int64_t rest = *proved_ - lowest;
    if (rest < 2 || (rest > near && steps_ % 2 == 0)) return lowest;
    const std::int64_t middle = lowest + rest / 2;
    return rest > near ? std::min(middle, lowest + 4 * near) : middle;
  }

  std::int64_t near_ms() const { return 2 * asker_.program().scan.max_ms; }

  Property claim_property(std::int64_t claim) const {
    const ResponseQuestion& question = asker_.question();
    const std::int64_t value = signed_value(claim);
    Property property;
    property.form = Property::Form::After;
    property.absent = side_ == Side::Best;
    property.formulas = {
        side_ == Side::Best ? rise_of(question) : question.cause,
        question.response};
    (unit_ == SpanUnit::Scans ? property.scans : property.milliseconds) = value;
    return property;
  }

  void ask(std::int64_t claim) {
    const double share = unit_ == SpanUnit::Scans ? kScansShare : kShare;
    ObligationResult answer = asker_.ask(claim_property(claim), share);
    if (answer.verdict == Verdict::Proved) {
      proved_ = claim;
      bound_.engine = answer.engine;
      bound_.certificate = std::move(answer.certificate);
      return;
    }
    floor_ = std::max(floor_, claim);
    if (!asker_.note_run(answer)) {
      undecided_ = true;
      return;
    }
    look();
    if (side_ != Side::Worst) return;
    asker_.evidence().go_on(stimulus_of(asker_.program(), *answer.trace));
    look();
  }

  SpanBound conclude() {
    if (unbounded()) {
      bound_.kind = SpanBound::Kind::Unbounded;
      bound_.reason = asker_.evidence().why_never();
      if (shown_) bound_.at_least = *shown_;
      show(*asker_.evidence().never());
      return std::move(bound_);
    }
    const bool exact = proved_ && shown_ && *proved_ == *shown_;
    bound_.kind = exact ? SpanBound::Kind::Exact : SpanBound::Kind::Between;
    if (side_ == Side::Worst) {
      bound_.at_least = shown_.value_or(0);
      bound_.at_most = proved_;
    } else {
      bound_.at_least = -proved_.value_or(0);
      if (shown_) bound_.at_most = -*shown_;
    }
    if (!exact) bound_.reason = why_open();
    if (evidence()) show(evidence()->stimulus);
    return std::move(bound_);
  }

  std::string why_open() const {
    if (asker_.out_of_time()) return "the time ran out";
    if (undecided_) return "neither a run nor a proof was found in between";
    return "not searched further";
  }

  void show(const Stimulus& stimulus) {
    bound_.trace = simulate_changes(asker_.program(), stimulus);
  }

  Asker& asker_;
  Side side_;
  SpanUnit unit_;
  std::int64_t floor_ = 0;  // no claim up to here can be proved
  std::optional<std::int64_t> proved_;
  std::optional<std::int64_t> shown_;
  bool undecided_ = false;
  int steps_ = 0;
  std::int64_t reach_ = 0;  // of the last claim above what was shown
  SpanBound bound_;
};

class BoundSearch {
 public:
  explicit BoundSearch(Asker& asker) : asker_(asker) {}

  ResponseBounds run() {
    if (reach_cause()) {
      if (!never_follows()) {
        search_time();
        search_scans();
      }
    }
    bounds_.failures = asker_.take_failures();
    return std::move(bounds_);
  }

 private:
  using Side = SpanSearch::Side;

  const ScanInterval& scan() const { return asker_.program().scan; }
  SpanBound& worst(SpanUnit unit) { return bounds_.worst[index(unit)]; }
  SpanBound& best(SpanUnit unit) { return bounds_.best[index(unit)]; }

  bool reach_cause() {
    Property property;
    property.form = Property::Form::Reach;
    property.formulas = {asker_.question().cause};
    const ObligationResult answer = asker_.ask(std::move(property), kShare);
    if (answer.verdict == Verdict::Proved) {
      bounds_.cause = ResponseBounds::Reach::Yes;
      asker_.note_run(answer);
      reached_ = stimulus_of(asker_.program(), *answer.trace);
      return true;
    }
    const bool never = answer.verdict == Verdict::Violated ||
                       answer.verdict == Verdict::Vacuous;
    if (never) bounds_.cause = ResponseBounds::Reach::No;
    bounds_.reason = answer.reason;
    return false;
  }

  /// Is it proved that no Q comes at or behind a P?
  bool never_follows() {
    Property property;
    property.form = Property::Form::Never;
    property.formulas = {"(" + asker_.question().response + ") && once(" +
                         asker_.question().cause + ")"};
    ObligationResult answer = asker_.ask(std::move(property), kShare);
    asker_.note_run(answer);
    if (answer.verdict != Verdict::Proved) return false;
    for (const SpanUnit unit : {SpanUnit::Milliseconds, SpanUnit::Scans}) {
      for (SpanBound* bound : {&worst(unit), &best(unit)}) {
        bound->kind = SpanBound::Kind::Unbounded;
        bound->engine = answer.engine;
        bound->certificate = answer.certificate;
      }
      worst(unit).trace = simulate_changes(asker_.program(), reached_);
    }
    return true;
  }

  void search_time() {
    asker_.evidence().go_on(reached_);
    worst(SpanUnit::Milliseconds) =
        SpanSearch(asker_, Side::Worst, SpanUnit::Milliseconds).run(kMostTime);
    best(SpanUnit::Milliseconds) =
        SpanSearch(asker_, Side::Best, SpanUnit::Milliseconds).run(kMostTime);
  }

  /// A scan takes some time at least, and some at most.
  void search_scans() {
    const std::string by_time = "the time";
    SpanSearch most(asker_, Side::Worst, SpanUnit::Scans);
    if (const auto& time = worst(SpanUnit::Milliseconds).at_most) {
      most.seed(*time / scan().min_ms, by_time);
    }
    worst(SpanUnit::Scans) = most.run(kMostScans);
    SpanSearch least(asker_, Side::Best, SpanUnit::Scans);
    const std::int64_t time = best(SpanUnit::Milliseconds).at_least;
    least.seed((time + scan().max_ms - 1) / scan().max_ms, by_time);
    best(SpanUnit::Scans) = least.run(kMostScans);
  }

  Asker& asker_;
  Stimulus reached_;
  ResponseBounds bounds_;
};

}  // namespace

ResponseBounds find_bounds(const Program& program,
                           const PropertySet& properties,
                           const ResponseQuestion& question,
                           const VerifyOptions& options) {
  Asker asker(program, properties, question, options);
  return BoundSearch(asker).run();
}

}  // namespace rung
