#include <algorithm>

#include "analysis/rules/support.h"

namespace rung {
namespace {

constexpr std::string_view kDoc = R"md(
## Finds
A timer or a counter with preset 0.

## Why it matters
There is no delay and nothing to count. A sim timer with preset 0 is true even
while its input is false, and so is a counter.

## Example
Bad:

    Q0 = T(0, 0, I0);

Good:

    Q0 = T(0, 5, I0);

## Limits
A negative preset, or one that is no number, is an error of the reader. What is
less than a millisecond counts as 0.
)md";

void check(RuleRun& run) {
  for (const CallId id : ids_of(run.program.calls)) {
    const ElementCall& call = run.program.calls[id];
    const bool has_preset = std::any_of(
        call.operation->parameters.begin(), call.operation->parameters.end(),
        [](const ElementParameter& parameter) {
          return parameter.kind == ParameterKind::Seconds ||
                 parameter.kind == ParameterKind::Count;
        });
    if (!has_preset || call.parameter != 0) continue;
    run.explain(RungId(run.index.rung_of_call[id.index()]));
    const Instance& instance = run.program.instances[call.instance];
    run.report(call.where, "the " + std::string(family_name(instance)) + " " +
                               quoted(instance.name) + " has preset 0");
  }
}

}  // namespace

constinit const Rule zero_preset = {
    "RP501", "zero-preset", Severity::Warning, Decision::Syntax, kDoc, check};

}  // namespace rung
