#include "analysis/rules/interlock.h"
#include "analysis/rules/support.h"

namespace rung {
namespace {

constexpr std::string_view kDoc = R"md(
## Finds
Two latching outputs of which one is interlocked against the other, but not the
other way round, and that the solver shows to be on together at the end of a
scan.

## Why it matters
An interlock works only when both sides have it. Here the second start switches
the second output on while the first one still is: two contactors across one
motor.

## Example
Bad:

    Q0 = (Q0 || I0) && !I2 && !Q1;
    Q1 = (Q1 || I1) && !I2;

Good:

    Q0 = (Q0 || I0) && !I2 && !Q1;
    Q1 = (Q1 || I1) && !I2 && !Q0;

## Limits
Both rungs must hold themselves. What must never be on together is better said
by `//@ interlock`, which is proved for any rungs.
)md";

void ask(RuleRun& run, const Latch& locked, const Latch& free) {
  const ExprId both = run.ts.exprs.conjunction(
      run.ts.cell_end[locked.cell.index()], run.ts.cell_end[free.cell.index()]);
  run.ask(
      RuleRun::Want::Witness, {run.ts.exprs.negation(both)},
      [locked, free](RuleRun& now, std::span<const RuleRun::Evidence> answers) {
        if (answers[0].answer != RuleRun::Answer::No) return;
        const std::string first = quoted(now.program, locked.cell);
        const std::string second = quoted(now.program, free.cell);
        now.report(now.program.rungs[free.rung].where,
                   second + " is not interlocked against " + first +
                       ", and both can be on",
                   {.labels = {{now.program.rungs[locked.rung].where,
                                first + " is interlocked against " + second}},
                    .help = witness_text(now, answers[0])});
      });
}

void check(RuleRun& run) {
  for (const OneSided& pair : one_sided_pairs(run)) {
    ask(run, *pair.locked, *pair.free);
  }
}

}  // namespace

constinit const Rule one_sided_interlock = {
    "RP406", "one-sided-interlock", Severity::Warning, Decision::Solver, kDoc,
    check};

}  // namespace rung
