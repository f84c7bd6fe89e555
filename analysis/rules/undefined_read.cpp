#include "analysis/rules/support.h"

namespace rung {
namespace {

constexpr std::string_view kDoc = R"md(
## Finds
A memory cell that rungs read, while nothing gives it a value: no rung, no
`//Var` line, no plant.

## Why it matters
In the browser such a name is undefined and reads as false; on a controller it
is whatever the reader made of it. Nearly always the name is a typing mistake.

## Example
Bad:

    M1 = I0 || M2;
    Q0 = M1;

Good:

    M1 = I0 || Q0;
    Q0 = M1;

## Limits
In the yun dialect a name outside the fixed sets is an error of the reader
already.
)md";

void check(RuleRun& run) {
  for (const CellId id : ids_of(run.program.cells)) {
    const Cell& cell = run.program.cells[id];
    const std::span<const std::uint32_t> reads = run.index.reads[id.index()];
    if (cell.role != CellRole::Memory || reads.empty() || cell.initialised ||
        run.index.plant_writes[id.index()] ||
        !run.index.writers[id.index()].empty()) {
      continue;
    }
    for (const std::uint32_t read : reads) {
      run.explain(RungId(run.index.rung_of[read]));
    }
    run.report(run.program.nodes[reads[0]].where,
               quoted(cell.name) + " is read, but nothing gives it a value",
               {.help = "it is false in every scan"});
  }
}

}  // namespace

constinit const Rule undefined_read = {
    "RP201", "undefined-read", Severity::Warning, Decision::Syntax, kDoc,
    check};

}  // namespace rung
