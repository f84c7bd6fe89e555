#include <algorithm>
#include <vector>

#include "analysis/rules/support.h"

namespace rung {
namespace {

constexpr std::string_view kDoc = R"md(
## Finds
A counter that is done in the first scan, before anything was counted. The
solver shows it.

## Why it matters
A CTD counts down from a value that it is given by LD. Until then its value is
0, and 0 is what it waits for: what the counter starts, starts at power-up.

## Example
Bad:

    PROGRAM main
    VAR_INPUT part : BOOL; load : BOOL; END_VAR
    VAR_OUTPUT full : BOOL; END_VAR
    VAR left : CTD; END_VAR
    left(CD := part, LD := load, PV := 10);
    full := left.Q;
    END_PROGRAM

Good:

    PROGRAM main
    VAR_INPUT part : BOOL; clear : BOOL; END_VAR
    VAR_OUTPUT full : BOOL; END_VAR
    VAR done : CTU; END_VAR
    done(CU := part, R := clear, PV := 10);
    full := done.Q;
    END_PROGRAM

## Limits
A note. Preset 0 is told by `zero-preset`.
)md";

/// A constant one; other counters are given a word.
bool has_preset(const ElementOperation& operation) {
  return std::any_of(operation.parameters.begin(), operation.parameters.end(),
                     [](const ElementParameter& parameter) {
                       return parameter.kind == ParameterKind::Count;
                     });
}

/// Done in the first scan with all inputs of the counter off.
ExprId done_at_once(RuleRun& run, CallId id) {
  const ElementCall& call = run.program.calls[id];
  std::vector<ExprId> all = {run.past.first_scan(),
                             run.ts.call_value[id.index()]};
  for (const std::uint32_t argument : call.arguments) {
    if (run.program.nodes[argument].type != Type::Bit) continue;
    all.push_back(run.ts.exprs.negation(run.ts.node_value[argument]));
  }
  return run.ts.exprs.conjunction(all);
}

void check(RuleRun& run) {
  if (!run.has_oracle) return;
  for (const CallId id : ids_of(run.program.calls)) {
    const ElementCall& call = run.program.calls[id];
    const Instance& instance = run.program.instances[call.instance];
    if (instance.kind->family != ElementFamily::Counter ||
        !call.operation->steps() || call.operation->word ||
        (call.parameter == 0 && has_preset(*call.operation))) {
      continue;
    }
    run.ask(RuleRun::Want::Witness,
            {run.ts.exprs.negation(done_at_once(run, id))},
            [id](RuleRun& now, std::span<const RuleRun::Evidence> answers) {
              if (answers[0].answer != RuleRun::Answer::No) return;
              const ElementCall& it = now.program.calls[id];
              now.report(it.where,
                         quoted(now.program.instances[it.instance].name) +
                             " is done at power-up, before it has counted",
                         {.help = witness_text(now, answers[0])});
            });
  }
}

}  // namespace

constinit const Rule done_at_power_up = {
    "RP317", "done-at-power-up", Severity::Note, Decision::Solver, kDoc, check};

}  // namespace rung
