#include "analysis/rules/support.h"

namespace rung {
namespace {

constexpr std::string_view kDoc = R"md(
## Finds
A cell that has a `//Var` value or a declaration, and that nothing else
mentions.

## Why it matters
It is a leftover, or the rungs use another name for what was meant.

## Example
Bad:

    Q0 = I0;
    //Var
    M7 = true;

Good:

    Q0 = I0 && M7;
    M7 = !I1;
    //Var
    M7 = true;

## Limits
Variables of the plant alone are not looked at.
)md";

void check(RuleRun& run) {
  for (const CellId id : ids_of(run.program.cells)) {
    const Cell& cell = run.program.cells[id];
    if (cell.role != CellRole::Memory || !cell.initialised ||
        !run.index.reads[id.index()].empty() ||
        !run.index.writers[id.index()].empty() ||
        run.index.plant_reads[id.index()] ||
        run.index.plant_writes[id.index()] || run.index.mentioned[id.index()]) {
      continue;
    }
    run.report(cell.where,
               quoted(cell.name) + " is given a value and not used");
  }
}

}  // namespace

constinit const Rule unused_variable = {
    "RP203", "unused-variable", Severity::Note, Decision::Syntax, kDoc, check};

}  // namespace rung
