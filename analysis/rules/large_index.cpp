#include "analysis/rules/support.h"

namespace rung {
namespace {

constexpr std::string_view kDoc = R"md(
## Finds
A timer or counter of the yun dialect whose index is 100 or more.

## Why it matters
The controller of that dialect keeps elements in arrays with the index as their
subscript, about ten bytes each, in 2560 bytes of memory, and does not check
the subscript. A large index writes over something else.

## Example
Bad:

    y0 = T(500, 5, pin1);
    y1 = TR(500, !pin1);
    pin3 = y0;

Good:

    y0 = T(0, 5, pin1);
    y1 = TR(0, !pin1);
    pin3 = y0;

## Limits
How long the arrays of a given controller are is not known here; the postfix
format of this project numbers elements from 0, whatever their index is.
)md";

constexpr std::int64_t kLarge = 100;

void check(RuleRun& run) {
  if (run.program.dialect != "yun") return;
  for (const Instance& instance : run.program.instances) {
    if (instance.index < kLarge) continue;
    run.report(instance.where,
               "the index of " + quoted(instance.name) +
                   " may lie outside the arrays of the controller",
               {.help = "number elements from 0"});
  }
}

}  // namespace

constinit const Rule large_index = {
    "RP704", "large-index", Severity::Warning, Decision::Syntax, kDoc, check};

}  // namespace rung
