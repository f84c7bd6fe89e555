#include "analysis/rules/support.h"

namespace rung {
namespace {

constexpr std::string_view kDoc = R"md(
## Finds
A cell that rungs can only keep or clear, and that starts false.

## Why it matters
It is false for ever. The branch that should set it is missing, or names
another cell.

## Example
Bad:

    Q0 = Q0 && !I1;

Good:

    Q0 = (Q0 || I0) && !I1;

## Limits
Decided on the structure of the rungs. That a set branch exists but cannot work
is told by `latch-never-set`.
)md";

void check(RuleRun& run) {
  for (const Latch& latch : run.latches) {
    if (!only_resets(latch) || latch.breaks.empty()) continue;
    if (run.index.writers[latch.cell.index()].size() != 1) continue;
    if (run.program.cells[latch.cell].initial != 0) continue;
    const ExprId kept = run.ts.node_value[latch.read];
    if (run.ts.rung_value[latch.rung.index()] == kept) continue;  // Q = Q && Q
    run.explain(latch.rung);
    run.report(run.program.rungs[latch.rung].where,
               "nothing ever sets " + quoted(run.program, latch.cell) +
                   ": this rung only keeps or clears it");
  }
}

}  // namespace

constinit const Rule reset_without_set = {
    "RP107", "reset-without-set", Severity::Warning, Decision::Syntax, kDoc,
    check};

}  // namespace rung
