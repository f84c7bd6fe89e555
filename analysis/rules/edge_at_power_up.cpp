#include "analysis/rules/support.h"

namespace rung {
namespace {

constexpr std::string_view kDoc = R"md(
## Finds
A falling edge that is seen in the first scan, although nothing was on before
it. The solver shows it.

## Why it matters
The F_TRIG of IEC 61131-3 remembers the inverse of its input and begins with
false: with the input off at power-up it gives an edge that never was. What
counts or latches on it begins one step further.

## Example
Bad:

    PROGRAM main
    VAR_INPUT a : BOOL; END_VAR
    VAR_OUTPUT q : BOOL; END_VAR
    VAR edge : F_TRIG; END_VAR
    edge(CLK := a);
    q := edge.Q;
    END_PROGRAM

Good:

    PROGRAM main
    VAR_INPUT a : BOOL; END_VAR
    VAR_OUTPUT q : BOOL; END_VAR
    VAR edge : R_TRIG; old : BOOL; END_VAR
    edge(CLK := NOT a AND old);
    q := edge.Q;
    old := a;
    END_PROGRAM

## Limits
A note. A rising edge of an input that is on at power-up is not told: there it
did come on.
)md";

void ask(RuleRun& run, CallId id) {
  const ElementCall& call = run.program.calls[id];
  ExprArena& exprs = run.ts.exprs;
  const ExprId input = run.ts.node_value[call.arguments[0]];
  const ExprId seen =
      exprs.conjunction({run.past.first_scan(), exprs.negation(input),
                         run.ts.call_value[id.index()]});
  run.ask(RuleRun::Want::Witness, {exprs.negation(seen)},
          [id](RuleRun& now, std::span<const RuleRun::Evidence> answers) {
            if (answers[0].answer != RuleRun::Answer::No) return;
            const ElementCall& it = now.program.calls[id];
            now.report(it.where,
                       quoted(now.program.instances[it.instance].name) +
                           " gives a falling edge in the first scan, although "
                           "nothing was on before",
                       {.help = witness_text(now, answers[0])});
          });
}

void check(RuleRun& run) {
  if (!run.has_oracle) return;
  for (const CallId id : ids_of(run.program.calls)) {
    const ElementCall& call = run.program.calls[id];
    const ElementKind& kind = *run.program.instances[call.instance].kind;
    if (kind.family != ElementFamily::Edge || !call.operation->steps() ||
        call.arguments.empty()) {
      continue;
    }
    ask(run, id);
  }
}

}  // namespace

constinit const Rule edge_at_power_up = {
    "RP509", "edge-at-power-up", Severity::Note, Decision::Solver, kDoc, check};

}  // namespace rung
