#include "analysis/rules/support.h"

namespace rung {
namespace {

constexpr std::string_view kDoc = R"md(
## Finds
A rung that holds itself and that, once true, is never false again, although it
has contacts that should break it. Decided by the solver.

## Why it matters
The stop is there and does not work: its contact can never open while the latch
is on, or a branch goes around it.

## Example
Bad:

    Q0 = (Q0 || I0) && !(I1 && !Q0);

Good:

    Q0 = (Q0 || I0) && !I1;

## Limits
A latch without any such contact is told by `set-without-reset`, a rung that
only resets by `reset-never-fires`, one that is never true by `latch-never-set`.
)md";

void check(RuleRun& run) {
  for (const Latch& latch : run.latches) {
    if (latch.breaks.empty() || only_resets(latch)) continue;
    if (run.explained(latch.rung)) continue;
    const std::size_t cell = latch.cell.index();
    if (run.index.writers[latch.cell.index()].back() != latch.rung.index()) {
      continue;
    }
    const ExprId before = run.ts.cell_begin[cell];
    const ExprId after = run.ts.cell_end[cell];
    run.ask(RuleRun::Want::Proof,
            {run.ts.exprs.implication(before, after),
             run.ts.exprs.negation(after), after},
            [latch](RuleRun& now, std::span<const RuleRun::Evidence> answers) {
              if (answers[0].answer != RuleRun::Answer::Yes ||
                  answers[1].answer != RuleRun::Answer::No ||
                  answers[2].answer != RuleRun::Answer::No) {
                return;
              }
              now.report(now.program.rungs[latch.rung].where,
                         "once true, " + quoted(now.program, latch.cell) +
                             " can never become false again",
                         {.help = proof_text(answers[0])});
            });
  }
}

}  // namespace

constinit const Rule latch_never_released = {
    "RP401", "latch-never-released", Severity::Warning, Decision::Solver, kDoc,
    check};

}  // namespace rung
