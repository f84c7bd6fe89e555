#include "smt/verdicts.h"

#include <algorithm>

#include "analysis/simulator.h"
#include "smt/attempt.h"
#include "smt/faults.h"

namespace rung {
namespace {

using Status = Target::Status;

/// Executed to see that a left side can be true: some three seconds.
constexpr std::uint64_t kMostRungs = 30'000'000;

/// Test only: an invariant that no state meets; its initiation must fail.
void corrupt(Invariant& invariant) { invariant.lemmas.emplace_back(); }

}  // namespace

Verdicts::Verdicts(const Program& program, const PropertySet& properties,
                   const TransitionSystem& ts, const Questions& questions,
                   const VerifyOptions& options)
    : program_(program),
      properties_(properties),
      ts_(ts),
      questions_(questions),
      options_(options),
      proofs_(ts),
      group_of_(questions.targets.size(), 0),
      confirmed_(questions.obligations.size(), 0),
      replayed_(questions.targets.size(), false) {}

void Verdicts::replay_together(const FoundRun& run,
                               const std::vector<Claim>& claims) {
  Stimulus stimulus = to_stimulus(ts_, run);
  if (options_.inject_wrong_trace) stimulus.steps.clear();
  std::vector<ReplayTarget> targets;
  for (const Claim& claim : claims) {
    const Obligation& obligation = questions_.obligations[claim.obligation];
    targets.push_back({obligation.property, obligation.part, claim.trigger});
  }
  const ReplayAll replayed =
      replay_all(program_, properties_, targets, stimulus);
  if (!replayed.assumptions_hold) return;
  for (std::size_t i = 0; i < claims.size(); ++i) {
    if (replayed.decided_at[i] == 0) continue;
    replayed_[target_of(claims[i])] = true;
    if (claims[i].trigger) continue;
    // Another run may have met it before.
    std::uint64_t& confirmed = confirmed_[claims[i].obligation];
    if (confirmed == 0) confirmed = replayed.decided_at[i];
  }
}

void Verdicts::decided(const std::vector<std::size_t>& group,
                       const Invariant& invariant, bool overflow,
                       double milliseconds) {
  Group g;
  g.overflow = overflow;
  g.milliseconds = milliseconds;
  std::vector<ExprId> goals;
  for (std::size_t i : group) {
    group_of_[i] = groups_.size();
    const Target& target = questions_.targets[i];
    if (target.status == Status::Unreachable) goals.push_back(target.never);
  }
  if (!goals.empty() && !overflow) {
    g.k = invariant.k;
    for (const LemmaClause& lemma : invariant.lemmas) {
      g.lemmas.push_back(to_string(ts_, lemma));
    }
    if (g.k > 0) {
      for (const ExprId condition : invariant.conditions) {
        g.conditions.push_back(to_string(ts_, condition));
      }
    }
    Invariant checked = invariant;
    if (options_.inject_wrong_invariant) corrupt(checked);
    g.proof = proofs_.add(std::move(checked), std::move(goals),
                          "proof" + std::to_string(groups_.size() + 1));
  }
  groups_.push_back(std::move(g));
}

VerifyReport Verdicts::report() {
  if (options_.self_check) {
    proofs_.check({options_.budget.seconds,
                   options_.recheck,
                   options_.smtlib_directory,
                   {}});
  }
  VerifyReport report;
  for (std::size_t i = 0; i < questions_.obligations.size(); ++i) {
    ObligationResult result;
    const std::string failure = attempt([&] { result = conclude(i); });
    if (!failure.empty()) {
      result = {};
      result.obligation = questions_.obligations[i];
      result.reason = "it could not be concluded: " + failure;
    }
    report.results.push_back(std::move(result));
  }
  report.failures = std::move(failures_);
  return report;
}

/// Was it proved that this target is never met, and the proof checked?
bool Verdicts::is_shown(std::size_t i) const {
  const Target& target = questions_.targets[i];
  const Group& group = groups_[group_of_[i]];
  if (target.status != Status::Unreachable || group.overflow) return false;
  return !options_.self_check || (group.proof != Questions::kNone &&
                                  proofs_.shows(group.proof, target.never));
}

Certificate Verdicts::certificate(const Group& group) const {
  const CertificateReport& checked = proofs_.report(group.proof);
  Certificate result;
  result.k = group.k;
  result.conditions = group.conditions;
  result.lemmas = group.lemmas;
  for (const LemmaClause& lemma : checked.dropped) {
    std::erase(result.lemmas, to_string(ts_, lemma));
  }
  result.checked_by = checked.checked_by;
  result.reused = checked.reused;
  result.smtlib_path = checked.smtlib_path;
  return result;
}

VerifyReport Verdicts::no_run_at_all() {
  VerifyReport report;
  for (const Obligation& obligation : questions_.obligations) {
    ObligationResult result;
    result.obligation = obligation;
    result.verdict = Verdict::Vacuous;
    result.reason = "no inputs meet the assumptions";
    report.results.push_back(std::move(result));
  }
  return report;
}

ObligationResult Verdicts::conclude(std::size_t i) {
  ObligationResult result;
  const auto found = answered_.find(i);
  if (found != answered_.end()) {
    result = found->second.result;
    if (!found->second.failure.empty()) fail(result, found->second.failure);
    const bool may_be_vacuous = questions_.trigger[i] != Questions::kNone;
    if (result.verdict == Verdict::Proved && may_be_vacuous) {
      judge_vacuity(i, result);
    }
    return result;
  }
  result.obligation = questions_.obligations[i];
  const Target& target = questions_.targets[questions_.goal[i]];
  const Group& group = groups_[group_of_[questions_.goal[i]]];
  result.engine = target.engine;
  result.milliseconds = group.milliseconds;
  if (group.overflow) {
    result.reason = "a number in it has no bound that fits 62 bits";
    return result;
  }
  switch (target.status) {
    case Status::Reached:
      if (confirmed_[i] != 0) {
        result.verdict = Verdict::Proved;
        result.scans = confirmed_[i];
      } else {
        conclude_reached(target, result);
      }
      break;
    case Status::Unreachable:
      conclude_unreachable(i, result);
      break;
    case Status::Open:
      conclude_open(target, result);
      break;
  }
  return result;
}

void Verdicts::fail(ObligationResult& result, const std::string& what) {
  result.verdict = Verdict::Unknown;
  result.reason = "self-check failed: " + what;
  result.trace.reset();
  result.certificate.reset();
  failures_.push_back({result.obligation.name, what});
}

void Verdicts::conclude_reached(const Target& target,
                                ObligationResult& result) {
  const bool witness = result.obligation.goal == Goal::Reach;
  result.verdict = witness ? Verdict::Proved : Verdict::Violated;
  replay_into(target, result);
}

void Verdicts::replay_into(const Target& target, ObligationResult& result) {
  Stimulus stimulus = to_stimulus(ts_, target.run);
  result.scans = scans_of(stimulus);
  if (options_.inject_wrong_trace) drop_last_scan(stimulus);
  const Obligation& obligation = result.obligation;
  const bool keeps_trace = shows_run(obligation);
  if (!options_.self_check) {
    if (keeps_trace) result.trace = simulate_changes(program_, stimulus);
    return;
  }
  Replay replayed = replay(program_, properties_, obligation.property,
                           obligation.part, stimulus);
  if (replayed.decided_at == 0 || !replayed.assumptions_hold) {
    const std::string wider = wider_than_program(target);
    if (!wider.empty()) {
      result.verdict = Verdict::Unknown;
      result.reason = wider;
      result.scans = 0;
      return;
    }
    return fail(result, replayed.assumptions_hold
                            ? "engine " + result.engine + " found a run of " +
                                  std::to_string(result.scans) +
                                  " scans; the simulator does not get there"
                            : "the run found breaks an assumption");
  }
  if (replayed.decided_at < result.scans) {
    cut_to(stimulus, replayed.decided_at);
    replayed = replay(program_, properties_, obligation.property,
                      obligation.part, stimulus);
    result.scans = replayed.decided_at;
  }
  if (keeps_trace) result.trace = simulate_changes(program_, stimulus);
}

/// Why a run that only the encoding has says nothing; empty: it should not
/// exist.
std::string Verdicts::wider_than_program(const Target& target) const {
  for (ExprId id : dependencies(ts_, target.term)) {
    const Expr& e = ts_.exprs[id];
    if (e.op == ExprOp::Variable && ts_.vars[e.var].role == VarRole::Choice) {
      return "the only run found leaves the range in which a counter is exact";
    }
  }
  return {};
}

std::string Verdicts::open_fault(const Target& target) const {
  for (const std::size_t fault : faults_under(ts_, target.term)) {
    if (!is_shown(questions_.fault[fault])) {
      return may_leave_range(program_, ts_.faults[fault]);
    }
  }
  return {};
}

void Verdicts::conclude_unreachable(std::size_t i, ObligationResult& result) {
  const std::size_t goal = questions_.goal[i];
  const Target& target = questions_.targets[goal];
  const Group& group = groups_[group_of_[goal]];
  const CertificateReport& checked = proofs_.report(group.proof);
  if (!is_shown(goal)) {
    if (checked.outcome == CertificateOutcome::Rejected) {
      return fail(result, "certificate rejected: " + checked.what);
    }
    result.reason = "the certificate could not be checked: " + checked.what;
    return;
  }
  if (std::string fault = open_fault(target); !fault.empty()) {
    result.reason = std::move(fault);
    return;
  }
  result.certificate = certificate(group);
  result.milliseconds += checked.milliseconds;
  if (result.obligation.goal == Goal::Reach) {
    result.verdict = Verdict::Violated;
    result.reason = "no run gets there";
    return;
  }
  result.verdict = Verdict::Proved;
  if (questions_.trigger[i] != Questions::kNone) judge_vacuity(i, result);
}

/// Can the left side of what was proved be true? A run says so, and the
/// simulator has run it.
void Verdicts::judge_vacuity(std::size_t i, ObligationResult& result) {
  const std::size_t trigger = questions_.trigger[i];
  const Target& target = questions_.targets[trigger];
  if (is_shown(trigger)) {
    result.verdict = Verdict::Vacuous;
    result.reason = "its left side can never be true";
    return;
  }
  const bool reached = target.status == Status::Reached;
  if (reached && options_.self_check && !replayed_[trigger]) {
    if (scan_count(target.run.steps, ts_.scan) * program_.rungs.size() >
        kMostRungs) {
      result.reason =
          "the run found to its left side is too long to be executed";
      return;
    }
    replay_together(target.run, {{i, true}});
    if (!replayed_[trigger] && wider_than_program(target).empty()) {
      return fail(result, "engine " + std::string(target.engine) +
                              " found a run to its left side; the simulator "
                              "does not get there");
    }
  }
  if (!reached || (options_.self_check && !replayed_[trigger])) {
    result.reason = "whether its left side can be true was not decided";
  }
}

void Verdicts::conclude_open(const Target& target, ObligationResult& result) {
  result.engine = "bmc";
  result.scans = target.bound;
  const Obligation& obligation = result.obligation;
  if (!target.failure.empty()) {
    result.reason = "an engine failed: " + target.failure;
  } else if (obligation.goal == Goal::Invariant && target.bound > 0) {
    result.verdict = Verdict::Bounded;
    result.reason = open_fault(target);
    if (!result.reason.empty()) result.verdict = Verdict::Unknown;
  } else {
    result.reason = "no run of " + std::to_string(target.bound) +
                    " steps gets there, and no proof was found that none does";
  }
}

}  // namespace rung
