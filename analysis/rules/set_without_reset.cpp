#include "analysis/rules/support.h"

namespace rung {
namespace {

constexpr std::string_view kDoc = R"md(
## Finds
A cell that rungs set and hold, and that no rung ever resets.

## Why it matters
Once true it stays true until the power goes: a motor that no button stops, an
alarm that nobody can acknowledge.

## Example
Bad:

    Q0 = Q0 || I0;

Good:

    Q0 = (Q0 || I0) && !I1;

## Limits
Decided on the structure of the rungs. That a reset exists but cannot work is
told by `latch-never-released`.
)md";

void check(RuleRun& run) {
  for (const Latch& latch : run.latches) {
    if (!latch.breaks.empty() || latch.sets.empty()) continue;
    // Another rung on the same cell may reset it: other rules look at those.
    if (run.index.writers[latch.cell.index()].size() != 1) continue;
    run.explain(latch.rung);
    run.report(run.program.rungs[latch.rung].where,
               quoted(run.program, latch.cell) +
                   " is set here and nothing ever resets it",
               {.help = "put the reset in series: `(...) && !stop`"});
  }
}

}  // namespace

constinit const Rule set_without_reset = {
    "RP106", "set-without-reset", Severity::Warning, Decision::Syntax, kDoc,
    check};

}  // namespace rung
