#include "analysis/rules/redundant.h"
#include "analysis/rules/support.h"

namespace rung {
namespace {

constexpr std::string_view kDoc = R"md(
## Finds
A contact in series (or a group) that can be removed without any change: in
every reachable state the rung has the same value without it. Decided by the
solver.

## Why it matters
The contact looks as if it protected something. Either another condition covers
it already, or it names the wrong cell.

## Example
Bad:

    M0 = I0 && !I1;
    Q0 = M0 && I0;

Good:

    M0 = I0 && !I1;
    Q0 = M0 && I2;

## Limits
One finding a rung, the largest part first. Rungs with more than 64 operands,
and operands that hold a timer or a counter, are not looked at. An interlock
kept as a second line of defence is found as well: allow it with that reason.
)md";

void check(RuleRun& run) {
  ask_redundant(run, [](RuleRun& now, const Redundant& found) {
    if (found.parent != NodeOp::And) return;
    const SourceRange where = now.program.nodes[found.node].where;
    now.report(where,
               quoted(text_of(now, where)) +
                   " is redundant: without it the rung does the same",
               {.help = found.proof});
  });
}

}  // namespace

constinit const Rule redundant_contact = {"RP305",        "redundant-contact",
                                          Severity::Note, Decision::Solver,
                                          kDoc,           check};

}  // namespace rung
