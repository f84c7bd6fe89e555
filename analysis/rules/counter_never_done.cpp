#include "analysis/rules/never_true.h"
#include "analysis/rules/support.h"

namespace rung {
namespace {

constexpr std::string_view kDoc = R"md(
## Finds
A counter that reaches its preset in no run. Decided by the solver over all
reachable states.

## Why it matters
It is reset before it is full, its input never rises, or the two edges that it
should count exclude each other: what waits for it waits for ever.

## Example
Bad:

    M0 = C(0, 3, I0, false, !I0);
    Q0 = M0;

Good:

    M0 = C(0, 3, I0, false, I1);
    Q0 = M0;

## Limits
A counter that is never executed is told by `unreachable-element`.
)md";

void check(RuleRun& run) {
  ask_never_true(
      run, ElementFamily::Counter, [](RuleRun& now, const NeverTrue& found) {
        now.report(now.program.calls[found.call].where,
                   found.name + " can never reach its preset" + found.reason,
                   {.help = found.proof});
      });
}

}  // namespace

constinit const Rule counter_never_done = {
    "RP312", "counter-never-done", Severity::Warning, Decision::Solver, kDoc,
    check};

}  // namespace rung
