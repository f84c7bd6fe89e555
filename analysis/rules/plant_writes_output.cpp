#include "analysis/rules/support.h"

namespace rung {
namespace {

constexpr std::string_view kDoc = R"md(
## Finds
A statement of the `//Sim` plant that assigns an output (`Q0` to `Q8`, `QW0`,
`QW1`).

## Why it matters
The plant stands for the machine: it gives inputs their values. When it drives
an output, the simulation shows a device working that the rungs do not control.

## Example
Bad:

    Q0 = I0 && Q1;
    //Var
    h = 0;
    //Sim
    h = h + 1;
    Q1 = h > 10;

Good:

    Q0 = I0 && I1;
    //Var
    h = 0;
    //Sim
    h = h + 1;
    I1 = h > 10;

## Limits
A cell that both a rung and the plant assign is an error of the reader. An
assignment that an `if` guards is reported too.
)md";

bool is_output_name(std::string_view name) {
  if (name.starts_with("QW")) name.remove_prefix(1);
  return name.size() == 2 && (name[0] == 'Q' || name[0] == 'W') &&
         name[1] >= '0' && name[1] <= '8';
}

void check(RuleRun& run) {
  const Plant& plant = run.program.plant;
  for (const PlantStatement& statement : plant.statements) {
    if (statement.kind != AstPlantStatement::Kind::Assign ||
        !statement.value.has_value() || !is_output_name(statement.target)) {
      continue;
    }
    run.report(plant.nodes[statement.value.root()].where,
               "the plant drives the output " + quoted(statement.target));
  }
}

}  // namespace

constinit const Rule plant_writes_output = {
    "RP104", "plant-writes-output", Severity::Warning, Decision::Syntax, kDoc,
    check};

}  // namespace rung
