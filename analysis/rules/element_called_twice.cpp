#include "analysis/rules/support.h"

namespace rung {
namespace {

constexpr std::string_view kDoc = R"md(
## Finds
Two calls of one timer or counter with the same preset and the same inputs.

## Why it matters
Both calls run every scan. The first one takes the edge that the second one
would have counted, and a later change of one of them makes them differ.

## Example
Bad:

    Q0 = T(0, 5, I0);
    Q1 = T(0, 5, I0) && I1;

Good:

    M0 = T(0, 5, I0);
    Q0 = M0;
    Q1 = M0 && I1;

## Limits
Calls with other inputs or another preset are told by `shared-index`.
)md";

void check(RuleRun& run) {
  for (const InstanceId id : ids_of(run.program.instances)) {
    const Twins twins = conflicting_calls(run, id);
    if (!twins.second.has_value() || twins.differ) continue;
    const ElementCall& first = run.program.calls[twins.first];
    const ElementCall& second = run.program.calls[twins.second];
    run.report(second.where,
               quoted(run.program.instances[id].name) +
                   " is called a second time in the scan",
               {.labels = {{first.where, "first called here"}},
                .help = "keep the result in a memory cell"});
  }
}

}  // namespace

constinit const Rule element_called_twice = {
    "RP209", "element-called-twice", Severity::Note, Decision::Syntax, kDoc,
    check};

}  // namespace rung
