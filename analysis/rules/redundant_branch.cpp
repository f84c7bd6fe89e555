#include "analysis/rules/redundant.h"
#include "analysis/rules/support.h"

namespace rung {
namespace {

constexpr std::string_view kDoc = R"md(
## Finds
A parallel branch that can be removed without any change: whenever it is true
the rest of the rung is true without it. Decided by the solver; two equal
branches are the plain case.

## Why it matters
The branch was meant to add a case and adds none: it repeats another branch, or
one of its contacts names the wrong cell.

## Example
Bad:

    Q0 = I0 || I0 && I1;

Good:

    Q0 = I0 || I2 && I1;

## Limits
One finding a rung, the largest part first. Rungs with more than 64 operands,
and branches that hold a timer or a counter, are not looked at.
)md";

void check(RuleRun& run) {
  ask_redundant(run, [](RuleRun& now, const Redundant& found) {
    if (found.parent != NodeOp::Or) return;
    const SourceRange where = now.program.nodes[found.node].where;
    now.report(where,
               "the branch " + quoted(text_of(now, where)) +
                   " is redundant: without it the rung does the same",
               {.help = found.proof});
  });
}

}  // namespace

constinit const Rule redundant_branch = {
    "RP306", "redundant-branch", Severity::Note, Decision::Solver, kDoc, check};

}  // namespace rung
