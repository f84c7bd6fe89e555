#include <unordered_set>

#include "analysis/rules/support.h"

namespace rung {
namespace {

constexpr std::string_view kDoc = R"md(
## Finds
An input that the plant drives, or that a line declares, and that no rung reads.

## Why it matters
The machine has a sensor that the program ignores: a forgotten contact.

## Example
Bad:

    Q0 = I0 && !I1;
    //Var
    h = 0;
    //Sim
    h = h + 1;
    I2 = h > 10;

Good:

    Q0 = I0 && !I1 && !I2;
    //Var
    h = 0;
    //Sim
    h = h + 1;
    I2 = h > 10;

## Limits
Inputs are known by being read, so only those can be unused.
)md";

bool is_input_name(std::string_view name) {
  if (name.starts_with("IW")) name.remove_prefix(1);
  return name.size() == 2 && (name[0] == 'I' || name[0] == 'W') &&
         name[1] >= '0' && name[1] <= '8';
}

void report_driven(RuleRun& run) {
  const Plant& plant = run.program.plant;
  std::unordered_set<std::string_view> known;
  for (const PlantStatement& statement : plant.statements) {
    if (statement.kind != AstPlantStatement::Kind::Assign ||
        !statement.value.has_value() || !is_input_name(statement.target) ||
        run.index.find(statement.target).has_value() ||
        !known.insert(statement.target).second) {
      continue;
    }
    run.report(
        plant.nodes[statement.value.root()].where,
        "the plant drives " + quoted(statement.target) + ", no rung reads it");
  }
}

void check(RuleRun& run) {
  report_driven(run);
  for (const CellId id : ids_of(run.program.cells)) {
    const Cell& cell = run.program.cells[id];
    if (cell.role != CellRole::Input || !run.index.reads[id.index()].empty()) {
      continue;
    }
    run.report(cell.where, "no rung reads the input " + quoted(cell.name));
  }
}

}  // namespace

constinit const Rule unused_input = {
    "RP204", "unused-input", Severity::Note, Decision::Syntax, kDoc, check};

}  // namespace rung
