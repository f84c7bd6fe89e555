#include "smt/recovery_check.h"

#include <algorithm>
#include <unordered_map>
#include <utility>

#include "analysis/simulator.h"
#include "smt/faults.h"
#include "smt/interpret.h"

namespace rung {
namespace {

constexpr std::uint32_t kRandomScans = 200;
constexpr std::uint32_t kTries = 8;  // for inputs that the assumptions allow

std::string wrong_bound(const TransitionSystem& ts, const Bound& bound) {
  const auto exists = [&](std::uint32_t state) {
    return state < ts.states.size();
  };
  if (!exists(bound.state)) return "a bound is of no state";
  if (bound.minus == Bound::kNone) return {};
  const auto is_word = [&](std::uint32_t state) {
    return ts.vars[ts.states[state].var].type == Type::Word;
  };
  if (exists(bound.minus) && is_word(bound.state) && is_word(bound.minus)) {
    return {};
  }
  return "a difference is not one of numbers";
}

/// A region may choose inputs and dt, each once and in its range, and nothing
/// else: a choice that cannot be made would lead anywhere.
std::string wrong_region(const TransitionSystem& ts, const Region& region) {
  for (const Bound& bound : region.bounds) {
    std::string wrong = wrong_bound(ts, bound);
    if (!wrong.empty()) return wrong;
  }
  std::vector<VarId> seen;
  for (const Region::Held& held : region.held) {
    if (!held.input.has_value() || held.input.index() >= ts.vars.size()) {
      return "an input is none";
    }
    const Variable& var = ts.vars[held.input];
    if (var.role != VarRole::Input && var.role != VarRole::Dt) {
      return "`" + var.name + "` cannot be chosen";
    }
    if (held.value < var.low || held.value > var.high) {
      return "`" + var.name + "` is never " + std::to_string(held.value);
    }
    if (std::find(seen.begin(), seen.end(), held.input) != seen.end()) {
      return "`" + var.name + "` is chosen twice";
    }
    seen.push_back(held.input);
  }
  if (region.clock == Bound::kNone) return {};
  return wrong_bound(ts, {region.clock, region.clock, false, 0});
}

std::vector<ExprId> no_faults(TransitionSystem& ts, ExprId goal) {
  std::vector<ExprId> terms;
  for (const std::size_t fault : faults_under(ts, goal)) {
    terms.push_back(ts.exprs.negation(ts.faults[fault].condition));
  }
  return terms;
}

/// Scans behind a run, with inputs that change now and then.
class RandomScans {
 public:
  RandomScans(const TransitionSystem& ts, Interpreter terms)
      : ts_(ts), terms_(std::move(terms)) {
    for (const VarId id : ids_of(ts.vars)) {
      const Variable& var = ts.vars[id];
      if (var.role == VarRole::Input) input_of_.emplace(var.cell, id);
    }
  }

  void append(Stimulus& run) {
    if (run.steps.empty()) return;
    for (std::uint32_t i = 0; i < kRandomScans; ++i) {
      std::uint32_t tries = 0;
      StimulusStep next = changed(run);
      while (!scan(run, next)) {
        if (++tries == kTries) return;
        next = changed(run);
      }
      run.steps.push_back(std::move(next));
    }
  }

 private:
  std::uint64_t random(std::uint64_t count) {
    seed_ ^= seed_ << 13;
    seed_ ^= seed_ >> 7;
    seed_ ^= seed_ << 17;
    return (seed_ >> 11) % count;
  }

  std::int64_t in_range(std::int64_t low, std::int64_t high) {
    return low + static_cast<std::int64_t>(
                     random(static_cast<std::uint64_t>(high - low) + 1));
  }

  StimulusStep changed(const Stimulus& run) {
    StimulusStep step = run.steps.back();
    step.repeat = 1;
    step.dt_ms = random(2) == 0 ? ts_.scan.min_ms : ts_.scan.max_ms;
    for (std::size_t i = 0; i < run.inputs.size(); ++i) {
      if (random(3) != 0) continue;
      const Variable& var = ts_.vars[input_of_.at(run.inputs[i])];
      step.inputs[i] = in_range(var.low, var.high);
    }
    return step;
  }

  /// False when the assumptions do not allow it.
  bool scan(const Stimulus& run, const StimulusStep& step) {
    Interpreter next = terms_;
    const Stimulus one{run.inputs, {step}};
    if (!run_terms(ts_, one, next)) return false;
    terms_ = std::move(next);
    return true;
  }

  const TransitionSystem& ts_;
  Interpreter terms_;
  std::unordered_map<CellId, VarId> input_of_;
  std::uint64_t seed_ = 0x9e37'79b9'7f4a'7c15U;
};

void state(std::vector<ExprId>& conditions, ExprId condition) {
  if (std::find(conditions.begin(), conditions.end(), condition) ==
      conditions.end()) {
    conditions.push_back(condition);
  }
}

}  // namespace

WayClaims way_claims(TransitionSystem& ts, ExprId goal,
                     const std::vector<Region>& regions) {
  WayClaims claims;
  ExprArena& e = ts.exprs;
  claims.arrived = goal;
  ExprId inside = e.bit(false);
  for (const Region& region : regions) {
    claims.error = wrong_region(ts, region);
    if (!claims.error.empty()) return claims;
    const ExprId here = before_scan(ts, region.bounds);
    const ExprId there = after_scan(ts, region.bounds);
    ExprId end = claims.arrived;
    if (region.clock != Bound::kNone) {
      end = e.disjunction(end, e.conjunction(there, clock_grows(ts, region)));
    }
    const ExprId chosen = e.conjunction(e.conjunction(here, e.negation(inside)),
                                        holds_inputs(ts, region));
    claims.consequences.push_back(
        e.implication(chosen, e.conjunction(allowed(ts), end)));
    inside = e.disjunction(inside, here);
    claims.arrived = e.disjunction(claims.arrived, there);
  }
  return claims;
}

CertificateReport check_ways(CertificateSession& session, TransitionSystem& ts,
                             ExprId goal, const Recovery& recovery,
                             const CertificateOptions& options) {
  WayClaims claims = way_claims(ts, goal, recovery.regions);
  if (!claims.error.empty()) {
    CertificateReport report;
    report.outcome = CertificateOutcome::Rejected;
    report.what = claims.error;
    return report;
  }
  Invariant invariant = recovery.invariant;
  invariant.consequences = std::move(claims.consequences);
  std::vector<ExprId> goals = no_faults(ts, goal);
  goals.push_back(claims.arrived);
  state(invariant.conditions, claims.arrived);
  return session.check(ts, invariant, goals, options);
}

RunEnd end_of_run(const TransitionSystem& ts, ExprId goal,
                  const Stimulus& stimulus) {
  RunEnd end;
  std::vector<ExprId> roots = ts.constraints;
  roots.push_back(goal);
  const std::vector<bool> cone = cone_of_influence(ts, {goal});
  for (std::uint32_t i = 0; i < ts.states.size(); ++i) {
    if (cone[ts.states[i].var.index()]) end.states.push_back(i);
  }
  Interpreter terms(ts, roots);
  end.allowed = run_terms(ts, stimulus, terms);
  for (const std::uint32_t i : end.states) end.values.set(i, terms.state(i));
  end.onward = stimulus;
  RandomScans(ts, std::move(terms)).append(end.onward);
  return end;
}

CertificateReport check_trap(CertificateSession& session, TransitionSystem& ts,
                             ExprId goal, const Invariant& trap,
                             const RunEnd& end,
                             const CertificateOptions& options) {
  const StartingAt here(ts, end.states, end.values);
  std::vector<ExprId> goals = no_faults(ts, goal);
  goals.push_back(ts.exprs.negation(goal));
  return session.check(ts, trap, goals, options);
}

std::string disagreement(const Program& program, const PropertySet& properties,
                         const TransitionSystem& ts,
                         const Obligation& obligation, const Stimulus& stimulus,
                         const RunEnd& end) {
  if (stimulus.steps.empty()) return "the run found has no scan";
  const Replay seen = replay(program, properties, obligation.property,
                             obligation.part, end.onward);
  if (!seen.assumptions_hold || !end.allowed) {
    return "the run found breaks an assumption";
  }
  const Trace::Step& last = seen.trace.steps[stimulus.steps.size() - 1];
  for (const std::uint32_t i : end.states) {
    const Variable& var = ts.vars[ts.states[i].var];
    if (!var.cell.has_value()) continue;
    const std::int64_t value = last.values[var.cell.index()];
    if (value == end.values[i]) continue;
    return "at the end of the run found, `" + var.name + "` is " +
           std::to_string(value) + " in the simulator and " +
           std::to_string(end.values[i]) + " in the terms";
  }
  if (seen.last_at < last.scan) return {};
  return "nothing was to lead back from scan " + std::to_string(last.scan) +
         "; the simulator gets there in scan " + std::to_string(seen.last_at);
}

}  // namespace rung
