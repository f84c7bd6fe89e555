#include "analysis/rules/support.h"

namespace rung {
namespace {

constexpr std::string_view kDoc = R"md(
## Finds
A name of more than 40 characters.

## Why it matters
Ladder editors cut names off, often at 32 or 40 characters: two contacts that
differ at the end look the same.

## Example
Bad:

    Q0 = the_start_button_of_the_main_conveyor_on_the_left && I0;
    the_start_button_of_the_main_conveyor_on_the_left = I1;

Good:

    Q0 = conveyor_start && I0;
    conveyor_start = I1;

## Limits
A note, once a name.
)md";

void check(RuleRun& run) {
  constexpr std::size_t kLongest = 40;
  for (const Cell& cell : run.program.cells) {
    if (cell.made || cell.name.size() <= kLongest) continue;
    run.report(cell.where, quoted(cell.name) + " has " +
                               counted(cell.name.size(), "character"));
  }
}

}  // namespace

constinit const Rule long_name = {"RP710",          "long-name", Severity::Note,
                                  Decision::Syntax, kDoc,        check,
                                  Pack::Pedantic};

}  // namespace rung
