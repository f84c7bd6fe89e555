#include "analysis/rules/support.h"

namespace rung {
namespace {

constexpr std::string_view kDoc = R"md(
## Finds
An address (`%IX0.0`) that stands in the logic itself, in a language that has
declared names.

## Why it matters
The day a module moves, every place that names the address has to change. A
variable declared `AT %IX0.0` is one place, and says what the signal is.

## Example
Bad:

    PROGRAM main
    %QX0.0 := %IX0.0;
    END_PROGRAM

Good:

    PROGRAM main
    VAR start AT %IX0.0 : BOOL; motor AT %QX0.0 : BOOL; END_VAR
    motor := start;
    END_PROGRAM

## Limits
A note, once an address. Languages whose names are addresses are left out.
)md";

void check(RuleRun& run) {
  const std::string_view language = run.program.language;
  if (language != "st" && language != "il-iec" && language != "plcopen") return;
  for (const Cell& cell : run.program.cells) {
    if (cell.made || !cell.name.starts_with('%')) continue;
    run.report(cell.where, "the address " + quoted(cell.name) +
                               " stands in the logic; a declared name says "
                               "what it is");
  }
}

}  // namespace

constinit const Rule physical_address = {
    "RP708", "physical-address", Severity::Note, Decision::Syntax, kDoc,
    check,   Pack::Pedantic};

}  // namespace rung
