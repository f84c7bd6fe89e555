#include "analysis/rules/never_true.h"
#include "analysis/rules/support.h"

namespace rung {
namespace {

constexpr std::string_view kDoc = R"md(
## Finds
A timer whose result is true in no scan of any run. Decided by the solver over
all reachable states.

## Why it matters
Its input never stays true for the preset: something resets it first, often the
timer that runs beside it. The sequence stops at this step.

## Example
Bad:

    M0 = T(0, 2, I0);
    M1 = T(1, 5, I0 && !M0);
    Q0 = M1;

Good:

    M0 = T(0, 2, I0);
    M1 = T(1, 5, I0 && M0);
    Q0 = M1;

## Limits
A timer that is never executed is told by `unreachable-element`.
)md";

void check(RuleRun& run) {
  ask_never_true(run, ElementFamily::Timer,
                 [](RuleRun& now, const NeverTrue& found) {
                   now.report(now.program.calls[found.call].where,
                              found.name + " can never fire" + found.reason,
                              {.help = found.proof});
                 });
}

}  // namespace

constinit const Rule timer_never_fires = {
    "RP311", "timer-never-fires", Severity::Warning, Decision::Solver, kDoc,
    check};

}  // namespace rung
