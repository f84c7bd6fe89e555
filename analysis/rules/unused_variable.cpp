#include <unordered_set>

#include "analysis/rules/support.h"

namespace rung {
namespace {

constexpr std::string_view kDoc = R"md(
## Finds
A name that gets a `//Var` value and that neither a rung nor the plant uses.

## Why it matters
It is a leftover, or the rungs use another name for what was meant.

## Example
Bad:

    Q0 = I0;
    //Var
    M7 = true;

Good:

    M7 = !I1;
    Q0 = I0 && M7;
    //Var
    M7 = true;

## Limits
A use in a comment is no use.
)md";

void check(RuleRun& run) {
  const Plant& plant = run.program.plant;
  std::unordered_set<std::string_view> used;
  for (const AstNode& node : plant.nodes) {
    if (node.op == AstOp::Name) used.insert(node.text);
  }
  for (const PlantStatement& statement : plant.statements) {
    used.insert(statement.target);
  }
  for (const PlantStatement& initial : plant.initials) {
    if (used.contains(initial.target) || !initial.value.has_value()) continue;
    run.report(plant.nodes[initial.value.root()].where,
               quoted(initial.target) + " is given a value and never used");
  }
}

}  // namespace

constinit const Rule unused_variable = {
    "RP203", "unused-variable", Severity::Note, Decision::Syntax, kDoc, check};

}  // namespace rung
