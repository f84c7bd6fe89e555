#include "analysis/rules/support.h"

namespace rung {
namespace {

constexpr std::string_view kDoc = R"md(
## Finds
A timer or counter in the right operand of `&&` or `||` that is executed in no
scan of any run. Decided by the solver.

## Why it matters
The operand to its left always decides alone, so the element is dead code.

## Example
Bad:

    M0 = I0 && !I0;
    Q0 = M0 && T(0, 5, I1);

Good:

    M0 = T(0, 5, I1);
    Q0 = I0 && M0;

## Limits
Only languages that evaluate `&&` and `||` short-circuit, as the sim dialect
does. An element that runs in some scans is told by `skipped-element`.
)md";

void check(RuleRun& run) {
  if (run.program.evaluation == Evaluation::Strict) return;
  for (const CallId id : ids_of(run.program.calls)) {
    const ExprId executed = run.ts.call_executed[id.index()];
    if (run.ts.exprs.is_true(executed)) continue;
    run.ask(RuleRun::Want::Proof, {run.ts.exprs.negation(executed)},
            [id](RuleRun& now, std::span<const RuleRun::Evidence> answers) {
              if (answers[0].answer != RuleRun::Answer::Yes) return;
              now.explain(id);
              const ElementCall& call = now.program.calls[id];
              now.report(
                  call.where,
                  quoted(now.program.instances[call.instance].name) +
                      " is never executed: what stands before it decides",
                  {.help = proof_text(answers[0])});
            });
  }
}

}  // namespace

constinit const Rule unreachable_element = {
    "RP301", "unreachable-element", Severity::Warning, Decision::Solver, kDoc,
    check};

}  // namespace rung
