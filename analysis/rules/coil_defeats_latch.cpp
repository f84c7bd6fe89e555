#include "analysis/rules/support.h"

namespace rung {
namespace {

constexpr std::string_view kDoc = R"md(
## Finds
A rung that looks as if it held itself (`Q0 = Q0 || I1`), on a cell that an
earlier rung assigns anew in every scan.

## Why it matters
The earlier rung overwrites the held value before the latch reads it, so the
latch never remembers anything: it is only an or.

## Example
Bad:

    Q0 = I0;
    Q0 = (Q0 || I1) && !I2;

Good:

    Q0 = (Q0 || I0 || I1) && !I2;

## Limits
A rung that takes the earlier value further without a branch of its own
(`Q0 = Q0 && !I2`) is a usual way to write an enable, and is not reported.
)md";

void check(RuleRun& run) {
  for (const Latch& latch : run.latches) {
    if (only_resets(latch)) continue;
    const std::uint32_t plain =
        writer_above(run, latch.cell, latch.rung.index());
    if (plain == ProgramIndex::kNone || run.index.reads_itself[plain]) continue;
    const Rung& coil = run.program.rungs[RungId(plain)];
    run.report(run.program.rungs[latch.rung].where,
               "this rung does not hold " + quoted(run.program, latch.cell) +
                   ": another one assigns it first in every scan",
               {.labels = {{coil.target_where, "assigned here"}}});
  }
}

}  // namespace

constinit const Rule coil_defeats_latch = {
    "RP103", "coil-defeats-latch", Severity::Warning, Decision::Syntax, kDoc,
    check};

}  // namespace rung
