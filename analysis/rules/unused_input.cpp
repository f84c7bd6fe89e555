#include "analysis/rules/support.h"

namespace rung {
namespace {

constexpr std::string_view kDoc = R"md(
## Finds
An input that a line declares or that the plant drives, and that no rung reads.

## Why it matters
A sensor or a button is wired that the program ignores: a forgotten contact.

## Example
Bad:

    //@ input I1
    Q0 = Q0 || I0;

Good:

    //@ input I1
    Q0 = (Q0 || I0) && !I1;

## Limits
Inputs are otherwise known by being read, so only declared ones can be unused.
)md";

void check(RuleRun& run) {
  for (const CellId id : ids_of(run.program.cells)) {
    const Cell& cell = run.program.cells[id];
    if (cell.role != CellRole::Input || !run.index.reads[id.index()].empty() ||
        !run.index.writers[id.index()].empty()) {
      continue;
    }
    run.report(cell.where, "no rung reads the input " + quoted(cell.name));
  }
}

}  // namespace

constinit const Rule unused_input = {
    "RP204", "unused-input", Severity::Note, Decision::Syntax, kDoc, check};

}  // namespace rung
