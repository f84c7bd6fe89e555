#include "smt/recovery_answers.h"

#include <algorithm>
#include <chrono>
#include <utility>

#include "analysis/simulator.h"
#include "smt/attempt.h"
#include "smt/faults.h"
#include "smt/recovery_check.h"

namespace rung {
namespace {

/// Test only: an invariant that no state meets, and a way less.
void corrupt(Recovery& recovery) {
  recovery.invariant.lemmas.emplace_back();
  if (!recovery.regions.empty())
    recovery.regions.erase(recovery.regions.begin());
}

/// Does the encoding allow runs that the program does not have?
bool is_wider_than_program(const TransitionSystem& ts, ExprId goal) {
  const std::unordered_set<ExprId> all = dependencies(ts, goal);
  return std::any_of(all.begin(), all.end(), [&](ExprId id) {
    const Expr& e = ts.exprs[id];
    return e.op == ExprOp::Variable && ts.vars[e.var].role == VarRole::Choice;
  });
}

using Clock = std::chrono::steady_clock;

double milliseconds_since(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start)
      .count();
}

void set_induction(const TransitionSystem& ts, const Recovery& recovery,
                   Certificate& certificate) {
  const Invariant& invariant = recovery.invariant;
  certificate.k = invariant.k;
  for (const LemmaClause& lemma : invariant.lemmas) {
    certificate.lemmas.push_back(to_string(ts, lemma));
  }
  if (invariant.k == 0) return;
  for (const ExprId condition : invariant.conditions) {
    certificate.conditions.push_back(to_string(ts, condition));
  }
}

}  // namespace

CertificateOptions RecoveryAnswers::certificate_options(
    const Obligation& obligation) const {
  return {options_.budget.seconds, options_.recheck, options_.smtlib_directory,
          obligation.name};
}

void RecoveryAnswers::search(const std::vector<ExprId>& goals,
                             const std::vector<ExprId>& growth,
                             const PortfolioOptions& engines) {
  for (const Patience patience : {Patience::Short, Patience::Long}) {
    for (const ExprId goal : goals) {
      Decided& one = decided_[goal];
      const bool is_new = !one.asked || *one.asked < patience;
      const bool is_open = one.recovery.answer == Recovery::Answer::Unknown;
      if (!is_open || !is_new) continue;
      const Clock::time_point start = Clock::now();
      one.asked = patience;
      const std::string failure = attempt([&] {
        if (one.search == nullptr) {
          one.search =
              std::make_unique<RecoverySearch>(ts_, growth, goal, engines);
        }
        one.recovery = one.search->decide(patience);
      });
      if (!failure.empty()) {
        one.recovery = {};
        one.recovery.reason = "an engine failed: " + failure;
        one.asked = Patience::Long;
      }
      one.milliseconds += milliseconds_since(start);
      const bool keep = one.recovery.answer == Recovery::Answer::Unknown &&
                        patience == Patience::Short;
      if (!keep) one.search.reset();
    }
  }
}

CheckedAnswer RecoveryAnswers::answer(const Obligation& obligation) {
  const Clock::time_point start = Clock::now();
  const Decided& decided = decided_.at(obligation.condition);
  Recovery recovery = decided.recovery;
  if (options_.inject_wrong_invariant) corrupt(recovery);
  CheckedAnswer answer;
  answer.result.obligation = obligation;
  answer.result.engine = recovery.engine;
  const std::string failure = attempt([&] { conclude(recovery, answer); });
  if (!failure.empty()) {
    answer = {};
    answer.result.obligation = obligation;
    answer.result.reason = "it could not be concluded: " + failure;
  }
  answer.result.milliseconds = decided.milliseconds + milliseconds_since(start);
  return answer;
}

void RecoveryAnswers::conclude(const Recovery& recovery,
                               CheckedAnswer& answer) {
  switch (recovery.answer) {
    case Recovery::Answer::Recoverable:
      return conclude_recoverable(recovery, answer);
    case Recovery::Answer::Stuck:
      return conclude_stuck(recovery, answer);
    case Recovery::Answer::Unknown:
      answer.result.reason = recovery.reason;
  }
}

/// Notes the certificate's check; a verdict only where it was accepted.
bool RecoveryAnswers::is_accepted(const CertificateReport& report,
                                  CheckedAnswer& answer) {
  Certificate& certificate = *answer.result.certificate;
  certificate.checked_by = report.checked_by;
  certificate.reused = report.reused;
  certificate.smtlib_path = report.smtlib_path;
  if (report.outcome == CertificateOutcome::Accepted) return true;
  answer.result.certificate.reset();
  if (report.outcome == CertificateOutcome::Rejected) {
    answer.failure = "certificate rejected: " + report.what;
  } else {
    answer.result.reason =
        "the certificate could not be checked: " + report.what;
  }
  return false;
}

void RecoveryAnswers::conclude_recoverable(const Recovery& recovery,
                                           CheckedAnswer& answer) {
  ObligationResult& result = answer.result;
  result.certificate.emplace();
  set_induction(ts_, recovery, *result.certificate);
  for (const Region& region : recovery.regions) {
    result.certificate->ways.push_back(to_string(ts_, region));
  }
  if (options_.self_check &&
      !is_accepted(check_ways(session_, ts_, result.obligation.condition,
                              recovery, certificate_options(result.obligation)),
                   answer)) {
    return;
  }
  result.verdict = Verdict::Proved;
}

void RecoveryAnswers::conclude_stuck(const Recovery& recovery,
                                     CheckedAnswer& answer) {
  ObligationResult& result = answer.result;
  const ExprId goal = result.obligation.condition;
  Stimulus stimulus = to_stimulus(ts_, recovery.run);
  result.scans = scans_of(stimulus);
  if (options_.inject_wrong_trace) drop_last_scan(stimulus);
  result.certificate.emplace();
  set_induction(ts_, recovery, *result.certificate);
  if (options_.self_check) {
    const RunEnd end = end_of_run(ts_, goal, stimulus);
    answer.failure = disagreement(program_, properties_, ts_, result.obligation,
                                  stimulus, end);
    const bool accepted =
        answer.failure.empty() &&
        is_accepted(check_trap(session_, ts_, goal, recovery.invariant, end,
                               certificate_options(result.obligation)),
                    answer);
    if (!accepted) {
      result.certificate.reset();
      if (answer.failure.empty() || !is_wider_than_program(ts_, goal)) return;
      answer.failure.clear();
      result.reason =
          "the only run found leaves the range in which a counter is exact";
      return;
    }
  }
  result.verdict = Verdict::Violated;
  result.reason = "no run leads back from there";
  result.trace = simulate_changes(program_, stimulus);
}

}  // namespace rung
