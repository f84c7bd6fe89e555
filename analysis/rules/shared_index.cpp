#include "analysis/rules/support.h"

namespace rung {
namespace {

constexpr std::string_view kDoc = R"md(
## Finds
Two calls that run the same timer or counter (one index) with other inputs or
another preset.

## Why it matters
They share one state: each call starts, stops or counts the other one's
element. Two machines with one timer seem to work as long as only one runs.

## Example
Bad:

    Q0 = T(0, 5, I0);
    Q1 = T(0, 8, I1);

Good:

    Q0 = T(0, 5, I0);
    Q1 = T(1, 8, I1);

## Limits
Resets (`TR`, `CR`) are meant to name the index of another call.
)md";

void check(RuleRun& run) {
  for (const InstanceId id : ids_of(run.program.instances)) {
    const Instance& instance = run.program.instances[id];
    const Twins twins = conflicting_calls(run, id);
    if (!twins.second.has_value() || !twins.differ) continue;
    run.report(
        run.program.calls[twins.second].where,
        "this " + std::string(family_name(instance)) + " and another " +
            "share the state of " + quoted(instance.name),
        {.labels = {{run.program.calls[twins.first].where, "the other one"}},
         .help = "give each its own index"});
  }
}

}  // namespace

constinit const Rule shared_index = {
    "RP210", "shared-index", Severity::Warning, Decision::Syntax, kDoc, check};

}  // namespace rung
