#include "analysis/rules/support.h"

namespace rung {
namespace {

constexpr std::string_view kDoc = R"md(
## Finds
A reset (`TR`, `CR`) on an index that no timer or counter uses.

## Why it matters
The reset clears nothing. Usually its index is a typing mistake, and the
element that it was meant for is never reset.

## Example
Bad:

    y0 = T(0, 5, pin1);
    y1 = TR(1, !pin1);
    pin3 = y0;

Good:

    y0 = T(0, 5, pin1);
    y1 = TR(0, !pin1);
    pin3 = y0;

## Limits
Only elements that are reset by a call of their own.
)md";

void check(RuleRun& run) {
  for (const InstanceId id : ids_of(run.program.instances)) {
    bool is_run = false;
    for (const std::uint32_t call : run.index.calls[id.index()]) {
      is_run = is_run || !run.program.calls[CallId(call)].operation->resets;
    }
    if (is_run) continue;
    const Instance& instance = run.program.instances[id];
    run.report(instance.where,
               quoted(instance.name) + " is reset here, but no rung runs it");
  }
}

}  // namespace

constinit const Rule unused_element = {
    "RP208", "unused-element", Severity::Warning, Decision::Syntax, kDoc,
    check};

}  // namespace rung
