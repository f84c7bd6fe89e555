#include "smt/recurrence_answers.h"

#include <algorithm>
#include <chrono>
#include <utility>

#include "analysis/loop_replay.h"
#include "smt/attempt.h"
#include "smt/faults.h"
#include "smt/interpret.h"

namespace rung {
namespace {

using Clock = std::chrono::steady_clock;
using Kind = LivenessAnswer::Kind;

std::vector<bool> cone_of(const TransitionSystem& ts,
                          const Obligation& obligation) {
  std::vector<ExprId> roots = {obligation.condition};
  if (obligation.trigger.has_value()) roots.push_back(obligation.trigger);
  return cone_of_influence(ts, roots);
}

Returning returning(const TransitionSystem& ts, const std::vector<bool>& cone) {
  Returning result;
  for (const State& state : ts.states) {
    const Variable& var = ts.vars[state.var];
    if (cone[state.var.index()] && var.cell.has_value()) {
      result.cells.push_back(var.cell);
    }
  }
  for (std::uint32_t i = 0; i < ts.instance_states.size(); ++i) {
    const std::vector<std::uint32_t>& states = ts.instance_states[i];
    const bool all =
        !states.empty() &&
        std::all_of(states.begin(), states.end(), [&](std::uint32_t state) {
          return cone[ts.states[state].var.index()];
        });
    if (all) result.instances.emplace_back(i);
  }
  return result;
}

/// On the terms, with all that formulas remember: is the state back?
bool comes_round(const TransitionSystem& ts, const Obligation& obligation,
                 const std::vector<bool>& cone, const Lasso& lasso) {
  std::vector<ExprId> roots = ts.constraints;
  roots.push_back(obligation.condition);
  if (obligation.trigger.has_value()) roots.push_back(obligation.trigger);
  Interpreter terms(ts, roots);
  const auto state = [&] {
    std::vector<std::int64_t> values;
    for (std::uint32_t i = 0; i < ts.states.size(); ++i) {
      if (cone[ts.states[i].var.index()]) values.push_back(terms.state(i));
    }
    return values;
  };
  if (!run_terms(ts, lasso.stem, terms)) return false;
  const std::vector<std::int64_t> first = state();
  return run_terms(ts, lasso.loop, terms) && state() == first;
}

bool is_wider_than_program(const TransitionSystem& ts,
                           const std::vector<bool>& cone) {
  for (const VarId id : ids_of(ts.vars)) {
    if (cone[id.index()] && ts.vars[id].role == VarRole::Choice) return true;
  }
  return false;
}

}  // namespace

CheckedAnswer RecurrenceAnswers::answer(const Obligation& obligation,
                                        Patience patience,
                                        const PortfolioOptions& engines) {
  const Clock::time_point start = Clock::now();
  CheckedAnswer answer;
  answer.result.obligation = obligation;
  const std::string failure =
      attempt([&] { decide(patience, engines, answer); });
  if (!failure.empty()) {
    answer = {};
    answer.result.obligation = obligation;
    answer.result.reason = "it could not be decided: " + failure;
  }
  answer.result.milliseconds =
      std::chrono::duration<double, std::milli>(Clock::now() - start).count();
  return answer;
}

void RecurrenceAnswers::decide(Patience patience,
                               const PortfolioOptions& engines,
                               CheckedAnswer& answer) {
  ObligationResult& result = answer.result;
  const Obligation& obligation = result.obligation;
  const Recurrence asked = {obligation.condition, obligation.trigger,
                            counts_below(cone_of(ts_, obligation))};
  LivenessAnswer found = decide_recurrence(ts_, asked, patience, engines);
  result.engine = found.engine;
  switch (found.kind) {
    case Kind::Always:
      conclude_always(found, answer);
      if (result.verdict == Verdict::Proved) judge_vacuity(engines, answer);
      break;
    case Kind::Loops:
      conclude_loops(found, answer);
      break;
    case Kind::Unknown:
      result.reason = found.reason;
      break;
  }
}

/// Counters below, and how far they count together.
std::int64_t RecurrenceAnswers::counts_below(
    const std::vector<bool>& cone) const {
  std::int64_t counts = 0;
  for (const InstanceId id : ids_of(program_.instances)) {
    const Instance& instance = program_.instances[id];
    const std::vector<std::uint32_t>& states = ts_.instance_states[id.index()];
    const bool below = instance.kind->family == ElementFamily::Counter &&
                       !states.empty() &&
                       cone[ts_.states[states.front()].var.index()];
    if (below) counts += std::max<std::int64_t>(instance.largest_parameter, 0);
  }
  constexpr std::int64_t kMost = 100'000;
  return std::min(counts, kMost);
}

/// Notes the certificate and its check; a verdict only where it was accepted.
bool RecurrenceAnswers::is_accepted(LivenessProof& proof,
                                    const Obligation& obligation,
                                    CheckedAnswer& answer) {
  Certificate certificate;
  for (const LemmaClause& lemma : proof.invariant.lemmas) {
    certificate.lemmas.push_back(to_string(proof.ts, lemma));
  }
  // Here the condition is not the property: it is always told.
  certificate.k = proof.invariant.k;
  for (const ExprId condition : proof.invariant.conditions) {
    certificate.conditions.push_back(to_string(proof.ts, condition));
  }
  if (options_.inject_wrong_invariant) proof.invariant.lemmas.emplace_back();
  if (options_.self_check) {
    std::vector<ExprId> goals = proof.no_faults;
    goals.push_back(proof.never);
    const CertificateReport report =
        session_.check(proof.ts, proof.invariant, goals,
                       {options_.budget.seconds, options_.recheck,
                        options_.smtlib_directory, obligation.name});
    if (report.outcome == CertificateOutcome::Rejected) {
      answer.failure = "certificate rejected: " + report.what;
      return false;
    }
    if (report.outcome != CertificateOutcome::Accepted) {
      answer.result.reason =
          "the certificate could not be checked: " + report.what;
      return false;
    }
    certificate.checked_by = report.checked_by;
    certificate.reused = report.reused;
    certificate.smtlib_path = report.smtlib_path;
  }
  answer.result.certificate = std::move(certificate);
  return true;
}

void RecurrenceAnswers::conclude_always(LivenessAnswer& found,
                                        CheckedAnswer& answer) {
  const Obligation& obligation = answer.result.obligation;
  if (is_accepted(*found.proof, obligation, answer)) {
    answer.result.verdict = Verdict::Proved;
  }
}

void RecurrenceAnswers::conclude_loops(const LivenessAnswer& found,
                                       CheckedAnswer& answer) {
  ObligationResult& result = answer.result;
  const Obligation& obligation = result.obligation;
  Lasso lasso = {to_stimulus(ts_, found.stem), to_stimulus(ts_, found.loop)};
  if (options_.inject_wrong_trace) drop_last_scan(lasso.loop);
  if (options_.self_check) {
    const std::vector<bool> cone = cone_of(ts_, obligation);
    std::string wrong = refuted_loop(program_, properties_, obligation.property,
                                     lasso, returning(ts_, cone), false);
    if (wrong.empty() && !comes_round(ts_, obligation, cone, lasso)) {
      wrong = "the loop found does not come round";
    }
    if (!wrong.empty() && is_wider_than_program(ts_, cone)) {
      result.reason =
          "the only run found leaves the range in which a counter is exact";
      return;
    }
    if (!wrong.empty()) {
      answer.failure = std::move(wrong);
      return;
    }
  }
  result.verdict = Verdict::Violated;
  result.trace = trace_of(program_, lasso);
  result.scans = scans_of(lasso.stem) + scans_of(lasso.loop);
}

/// Is there a run on which what is given as fair is true again and again?
void RecurrenceAnswers::judge_vacuity(const PortfolioOptions& engines,
                                      CheckedAnswer& answer) {
  ObligationResult& result = answer.result;
  const Obligation& obligation = result.obligation;
  const bool some = !obligation.trigger.has_value() && ts_.constraints.empty();
  if (some) return;
  LivenessAnswer found = decide_fairness(ts_, obligation.trigger, engines);
  if (found.kind == Kind::Always) {
    CheckedAnswer none;
    none.result = result;
    if (is_accepted(*found.proof, obligation, none)) {
      result.verdict = Verdict::Vacuous;
      result.reason = obligation.trigger.has_value()
                          ? "no run is fair for ever"
                          : "no run goes on for ever";
      return;
    }
    answer.failure = none.failure;
  }
  if (found.kind == Kind::Loops) {
    if (!options_.self_check) return;
    const Lasso lasso = {to_stimulus(ts_, found.stem),
                         to_stimulus(ts_, found.loop)};
    const std::vector<bool> cone = cone_of(ts_, obligation);
    const std::string wrong = refuted_loop(
        program_, properties_, obligation.property, lasso, {}, true);
    if (wrong.empty()) return;
    if (!is_wider_than_program(ts_, cone)) answer.failure = wrong;
  }
  result.reason = "whether some run is fair for ever was not decided";
}

}  // namespace rung
