#include "analysis/rules/support.h"

namespace rung {
namespace {

constexpr std::string_view kDoc = R"md(
## Finds
A statement of the `//Sim` plant that assigns a cell which a rung writes, or an
output.

## Why it matters
The plant stands for the machine: it gives inputs their values. When it writes
a coil, the simulation shows a program that the controller will not run.

## Example
Bad:

    Q0 = I0;
    //Var
    h = 0;
    //Sim
    h = h + 1;
    Q0 = h > 10;

Good:

    Q0 = I0;
    //Var
    h = 0;
    //Sim
    h = h + Q0;
    IW0 = h;

## Limits
Assignments that an `if` guards are reported too.
)md";

SourceRange place_of(const Program& program, const PlantStatement& statement) {
  return program.plant.nodes[statement.value.root()].where;
}

void check(RuleRun& run) {
  for (const PlantStatement& statement : run.program.plant.statements) {
    if (statement.kind != AstPlantStatement::Kind::Assign ||
        !statement.value.has_value()) {
      continue;
    }
    const CellId cell = run.index.find(statement.target);
    if (!cell.has_value()) continue;
    const std::span<const std::uint32_t> writers =
        run.index.writers[cell.index()];
    if (writers.empty()) continue;
    const Rung& rung = run.program.rungs[RungId(writers[0])];
    run.report(place_of(run.program, statement),
               "the plant assigns " + quoted(run.program, cell) +
                   ", which a rung writes",
               {.labels = {{rung.target_where, "written by this rung"}}});
  }
}

}  // namespace

constinit const Rule plant_writes_coil = {
    "RP104", "plant-writes-coil", Severity::Warning, Decision::Syntax, kDoc,
    check};

}  // namespace rung
