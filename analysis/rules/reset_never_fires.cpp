#include "analysis/rules/support.h"

namespace rung {
namespace {

constexpr std::string_view kDoc = R"md(
## Finds
A rung of its own that resets a cell (`Q0 = Q0 && !I1`), while in no reachable
state it changes that cell. Decided by the solver.

## Why it matters
The bit is stranded: who reads the program sees a reset, but nothing ever
clears the cell.

## Example
Bad:

    M0 = I1 && !I1;
    Q0 = Q0 || I0;
    Q0 = Q0 && !M0;

Good:

    Q0 = Q0 || I0;
    Q0 = Q0 && !I1;

## Limits
Only rungs that do nothing but reset. A reset inside a latch rung is looked at
by `latch-never-released`. Nothing is said about a cell that is never true.
)md";

void check(RuleRun& run) {
  for (const Latch& latch : run.latches) {
    if (!only_resets(latch) || latch.breaks.empty()) continue;
    if (run.explained(latch.rung)) continue;
    const ExprId before = run.ts.node_value[latch.read];
    const ExprId after = run.ts.rung_value[latch.rung.index()];
    run.ask(RuleRun::Want::Proof,
            {run.ts.exprs.implication(before, after),
             run.ts.exprs.negation(before)},
            [latch](RuleRun& now, std::span<const RuleRun::Evidence> answers) {
              if (answers[0].answer != RuleRun::Answer::Yes ||
                  answers[1].answer != RuleRun::Answer::No) {
                return;
              }
              now.explain(latch.rung);
              now.report(now.program.rungs[latch.rung].where,
                         "this reset of " + quoted(now.program, latch.cell) +
                             " can never fire",
                         {.help = proof_text(answers[0])});
            });
  }
}

}  // namespace

constinit const Rule reset_never_fires = {
    "RP108", "reset-never-fires", Severity::Warning, Decision::Solver, kDoc,
    check};

}  // namespace rung
