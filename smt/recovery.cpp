#include "smt/recovery.h"

#include <algorithm>
#include <memory>
#include <optional>
#include <utility>

#include "smt/bmc.h"
#include "smt/faults.h"
#include "smt/trap.h"
#include "smt/ways.h"

namespace rung {
namespace {

std::vector<ExprId> fault_terms(const TransitionSystem& ts, ExprId goal) {
  std::vector<ExprId> terms;
  for (const std::size_t fault : faults_under(ts, goal)) {
    terms.push_back(ts.faults[fault].condition);
  }
  return terms;
}

using Status = Target::Status;
using Values = Ways::Values;

constexpr std::size_t kRegions = 500;
constexpr std::size_t kFew = 30;
constexpr std::uint32_t kExtensions = 60;
constexpr std::uint32_t kShallow = 8;  // steps of the first searches
constexpr std::int64_t kConflicts = 2000;
constexpr std::uint32_t kMinimiseQueries = 300;
constexpr const char* kInexact =
    "a number in it may leave the range in which it is exact";

}  // namespace

class RecoverySearch::Impl {
 public:
  Impl(TransitionSystem& ts, const std::vector<ExprId>& growth, ExprId goal,
       const PortfolioOptions& options)
      : ts_(ts),
        growth_(growth),
        goal_(goal),
        options_(options),
        faults_(fault_terms(ts, goal)),
        cone_(ts, roots()),
        jump_(cone_, growth),
        ways_(ts, cone_, goal, *options.deadline) {
    for (const ExprId fault : faults_) {
      fault_ =
          cone_.circuit().aig().disjunction(fault_, cone_.circuit().bit(fault));
    }
  }

  Recovery decide(Patience patience) {
    patience_ = patience;
    if (cone_.circuit().overflow()) {
      return unknown("a number in it has no bound that fits 62 bits");
    }
    if (search_ == nullptr) {
      search_ = std::make_unique<BoundedSearch>(cone_, &jump_, fault_,
                                                *options_.deadline);
    }
    const std::size_t most = patience == Patience::Short ? kFew : kRegions;
    while (ways_.regions().size() < most) {
      if (options_.deadline->passed()) return unknown("out of time");
      const std::optional<Recovery> answer = one_round();
      if (answer) return *answer;
    }
    return unknown("more than " + std::to_string(most) +
                   " places to be told apart lead there");
  }

 private:
  /// The goal, and the faults on which it depends.
  std::vector<ExprId> roots() const {
    std::vector<ExprId> result = {goal_};
    result.insert(result.end(), faults_.begin(), faults_.end());
    return result;
  }

  static Recovery unknown(std::string reason) {
    Recovery result;
    result.engine = "recovery";
    result.reason = std::move(reason);
    return result;
  }

  Values initial() const {
    Values values;
    for (const std::uint32_t state : cone_.states()) {
      values.set(state, ts_.states[state].init);
    }
    return values;
  }

  AigLit outside() { return aig_not(cone_.circuit().bit(ways_.arrived())); }

  /// A state outside of all regions that some run reaches; nothing is left to
  /// be asked when there is none, or when from there is no way.
  std::optional<Recovery> one_round() {
    if (outside() == kAigFalse && faults_.empty()) return all_arrive({});
    while (depth_ <= kShallow) {
      BoundedSearch::Result result =
          search_->search(depth_, {outside()}, kConflicts);
      if (result.answer == BoundedSearch::Answer::Found) {
        return resolve_found(depth_, std::move(result));
      }
      if (result.answer == BoundedSearch::Answer::Unknown) break;
      ++depth_;
    }
    depth_ = kShallow + 1;
    extend();
    return ask_all();
  }

  /// Ways from states that perhaps no run reaches: the more states have one,
  /// the less has to be known of the others. What is left out cannot get back.
  void extend() {
    const std::uint32_t most =
        patience_ == Patience::Short ? kExtensions / 4 : kExtensions;
    for (; extended_ < most; ++extended_) {
      const std::optional<Values> state = ways_.any_outside();
      if (!state) return;
      if (ways_.step_from(*state) || search_way(*state)) continue;
      const std::vector<Bound> trap =
          trap_around(ts_, cone_, bad(), *state, *options_.deadline);
      if (trap.empty()) return;
      ways_.leave_out(trap);
    }
  }

  /// The goal, or a number that leaves its range.
  ExprId bad() {
    ExprId any = goal_;
    for (const ExprId fault : faults_) any = ts_.exprs.disjunction(any, fault);
    return any;
  }

  std::optional<Recovery> resolve_found(std::uint32_t depth,
                                        BoundedSearch::Result result) {
    FoundRun run{cone_.inputs(), result.run};
    std::optional<Recovery> answer = resolve(run);
    if (!answer || answer->answer != Recovery::Answer::Stuck) return answer;
    // The shortest run there that changes little is the one to look at; it may
    // end elsewhere.
    result = search_->search(depth, {outside()}, kConflicts);
    if (result.answer != BoundedSearch::Answer::Found) return answer;
    search_->minimise(result, kMinimiseQueries);
    std::optional<Recovery> calm = resolve({cone_.inputs(), result.run});
    if (calm && calm->answer == Recovery::Answer::Stuck) return calm;
    return answer;
  }

  /// By all engines: does every scan end in a region?
  std::optional<Recovery> ask_all() {
    std::vector<Target> targets = with_faults({target(
        ts_.exprs.negation(ways_.arrived()), Target::Purpose::Violation)});
    Portfolio portfolio(ts_, growth_, pointers(targets), options_);
    ask(portfolio);
    switch (targets[0].status) {
      case Status::Unreachable:
        if (any_open_fault(targets)) return unknown(kInexact);
        engine_ = targets[0].engine;
        return all_arrive(portfolio.invariant());
      case Status::Reached:
        return resolve(targets[0].run);
      case Status::Open:
        break;
    }
    return unknown(
        "whether a way back exists from every reachable state was "
        "not decided");
  }

  Recovery all_arrive(Invariant invariant) {
    Recovery result;
    result.answer = Recovery::Answer::Recoverable;
    result.regions = ways_.regions();
    result.invariant = std::move(invariant);
    result.engine = "recovery";
    if (!engine_.empty()) result.engine += ", " + engine_;
    return result;
  }

  /// Is there a way from the end of this run? Nothing when there is: it was
  /// learnt.
  std::optional<Recovery> resolve(const FoundRun& run) {
    const Values state = ways_.end_of(initial(), of_cone(run));
    if (ways_.contains(state)) {
      return unknown("the engines disagree about a state");
    }
    if (ways_.step_from(state) || search_way(state)) return std::nullopt;
    if (!ends_in(run, state)) {
      return unknown("the run found into a trap is none, scan by scan");
    }
    std::optional<Recovery> stuck = trapped(run, state);
    return stuck ? stuck : decide_from(run, state);
  }

  /// Where a stretch may not be what one long scan is, it is executed.
  bool ends_in(const FoundRun& run, const Values& state) const {
    if (jump_.exact()) return true;
    std::vector<ExprId> terms = roots();
    terms.insert(terms.end(), ts_.constraints.begin(), ts_.constraints.end());
    Interpreter scans(ts_, terms);
    if (!run_terms(ts_, to_stimulus(ts_, run), scans)) return false;
    return std::all_of(
        cone_.states().begin(), cone_.states().end(),
        [&](std::uint32_t i) { return scans.state(i) == state[i]; });
  }

  /// The run's steps with the inputs of our cone.
  Run of_cone(const FoundRun& found) const {
    Run run;
    for (const RunStep& step : found.steps) {
      RunStep own{{}, step.delta};
      for (const VarId input : cone_.inputs()) {
        const Variable& var = ts_.vars[input];
        std::int64_t value = std::clamp<std::int64_t>(0, var.low, var.high);
        for (std::size_t i = 0; i < found.inputs.size(); ++i) {
          if (found.inputs[i] == input) value = step.inputs[i];
        }
        own.inputs.push_back(value);
      }
      run.push_back(std::move(own));
    }
    return run;
  }

  bool search_way(const Values& state) {
    const AigLit arrived = aig_not(outside());
    BoundedSearch search(cone_, &jump_, fault_, *options_.deadline, &state);
    for (std::uint32_t depth = 1; depth <= kShallow; ++depth) {
      const BoundedSearch::Result result =
          search.search(depth, {arrived}, kConflicts);
      if (result.answer == BoundedSearch::Answer::Unknown) return false;
      if (result.answer == BoundedSearch::Answer::Found) {
        return ways_.learn(state, result.run);
      }
    }
    return false;
  }

  /// Is there a trap of the simplest kind around the end of the run?
  std::optional<Recovery> trapped(const FoundRun& run, const Values& state) {
    const std::vector<Bound> trap =
        trap_around(ts_, cone_, bad(), state, *options_.deadline);
    if (trap.empty()) return std::nullopt;
    Recovery result;
    result.answer = Recovery::Answer::Stuck;
    result.engine = "recovery";
    result.run = run;
    for (const Bound& bound : trap) {
      result.invariant.lemmas.push_back({atom(before_scan(ts_, bound))});
    }
    result.invariant.conditions.push_back(ts_.exprs.negation(goal_));
    for (const ExprId fault : faults_) {
      result.invariant.conditions.push_back(ts_.exprs.negation(fault));
    }
    return result;
  }

  LemmaAtom atom(ExprId term) const {
    const Expr& e = ts_.exprs[term];
    const bool negated =
        e.op == ExprOp::Not && ts_.exprs[e.a].op == ExprOp::Variable;
    return {negated ? e.a : term, {}, 0, negated};
  }

  /// By all engines, on the runs that start in `state`.
  std::optional<Recovery> decide_from(const FoundRun& run,
                                      const Values& state) {
    const StartingAt here(ts_, cone_.states(), state);
    std::vector<Target> targets =
        with_faults({target(goal_, Target::Purpose::Violation),
                     target(ways_.arrived(), Target::Purpose::Violation)});
    // What is only sketched keeps no run of what is hidden.
    for (Target& target : targets) target.hidden = patience_ == Patience::Long;
    Portfolio portfolio(ts_, growth_, pointers(targets), options_);
    ask(portfolio);
    if (targets[0].status == Status::Unreachable) {
      if (any_open_fault(targets)) return unknown(kInexact);
      Recovery result;
      result.answer = Recovery::Answer::Stuck;
      result.run = run;
      result.invariant = portfolio.invariant();
      result.engine = "recovery, " + std::string(targets[0].engine);
      return result;
    }
    for (const Target& target : {targets[0], targets[1]}) {
      if (target.status != Status::Reached) continue;
      if (ways_.learn(state, of_cone(target.run))) return std::nullopt;
      return unknown(
          "a way back was found from one state, and nothing like "
          "it from those around it");
    }
    return unknown(
        "from some state neither a way back was found nor a proof "
        "that there is none");
  }

  Target target(ExprId term, Target::Purpose purpose) {
    Target result;
    result.term = term;
    result.never = ts_.exprs.negation(term);
    result.purpose = purpose;
    return result;
  }

  std::vector<Target> with_faults(std::vector<Target> targets) {
    for (const ExprId fault : faults_) {
      targets.push_back(target(fault, Target::Purpose::Fault));
    }
    return targets;
  }

  static bool any_open_fault(const std::vector<Target>& targets) {
    return std::any_of(targets.begin(), targets.end(), [](const Target& t) {
      return t.purpose == Target::Purpose::Fault &&
             t.status != Status::Unreachable;
    });
  }

  void ask(Portfolio& portfolio) const {
    if (patience_ == Patience::Long) {
      portfolio.run();
    } else {
      portfolio.sketch();
    }
  }

  static std::vector<Target*> pointers(std::vector<Target>& targets) {
    std::vector<Target*> result;
    result.reserve(targets.size());
    for (Target& target : targets) result.push_back(&target);
    return result;
  }

  TransitionSystem& ts_;
  const std::vector<ExprId>& growth_;
  ExprId goal_;
  PortfolioOptions options_;
  Patience patience_ = Patience::Short;
  std::vector<ExprId> faults_;
  Cone cone_;
  JumpCircuit jump_;
  Ways ways_;
  AigLit fault_ = kAigFalse;
  std::unique_ptr<BoundedSearch> search_;
  std::uint32_t extended_ = 0;
  std::uint32_t depth_ = 1;  // up to which no run leaves the regions
  std::string engine_;
};

RecoverySearch::RecoverySearch(TransitionSystem& ts,
                               const std::vector<ExprId>& growth, ExprId goal,
                               const PortfolioOptions& options)
    : impl_(std::make_unique<Impl>(ts, growth, goal, options)) {}
RecoverySearch::~RecoverySearch() = default;

Recovery RecoverySearch::decide(Patience patience) {
  return impl_->decide(patience);
}

}  // namespace rung
