#include "analysis/rules/support.h"

namespace rung {
namespace {

constexpr std::string_view kDoc = R"md(
## Finds
A memory cell with a `//Var` value that rungs read and nothing ever writes.

## Why it matters
Its contacts never change: the coil that should drive it is missing, or it is a
constant in disguise.

## Example
Bad:

    Q0 = I0 && M0;
    //Var
    M0 = true;

Good:

    M0 = !I1;
    Q0 = I0 && M0;
    //Var
    M0 = true;

## Limits
Word cells are left out: a set point that only `//Var` gives is usual.
)md";

void check(RuleRun& run) {
  for (const CellId id : ids_of(run.program.cells)) {
    const Cell& cell = run.program.cells[id];
    const std::span<const std::uint32_t> reads = run.index.reads[id.index()];
    if (cell.role != CellRole::Memory || cell.type != Type::Bit ||
        reads.empty() || !cell.initialised ||
        run.index.plant_writes[id.index()] ||
        !run.index.writers[id.index()].empty()) {
      continue;
    }
    for (const std::uint32_t read : reads) {
      run.explain(RungId(run.index.rung_of[read]));
    }
    run.report(run.program.nodes[reads[0]].where,
               quoted(cell.name) + " is read, but no rung ever writes it",
               {.help = "it keeps the value that `//Var` gives it"});
  }
}

}  // namespace

constinit const Rule never_assigned = {
    "RP202", "never-assigned", Severity::Warning, Decision::Syntax, kDoc,
    check};

}  // namespace rung
