#include <algorithm>

#include "analysis/rules/support.h"

namespace rung {
namespace {

constexpr std::string_view kDoc = R"md(
## Finds
A timer of the yun dialect without a `TR` on its index.

## Why it matters
In that dialect a timer starts once and runs on: that its input goes false does
not stop it, only `TR` does. So the second activation has no delay at all.

## Example
Bad:

    y0 = T(0, 5, pin1);
    pin3 = y0;

Good:

    y0 = T(0, 5, pin1);
    y1 = TR(0, !pin1);
    pin3 = y0;

## Limits
That the reset comes at the right time is not checked. A timer of the sim
dialect resets itself.
)md";

void check(RuleRun& run) {
  for (const InstanceId id : ids_of(run.program.instances)) {
    const Instance& instance = run.program.instances[id];
    const std::string_view reset = reset_name(*instance.kind);
    if (instance.kind->family != ElementFamily::Timer || reset.empty()) {
      continue;
    }
    const std::span<const std::uint32_t> calls = run.index.calls[id.index()];
    const bool is_reset =
        std::any_of(calls.begin(), calls.end(), [&](std::uint32_t call) {
          return run.program.calls[CallId(call)].operation->resets;
        });
    if (is_reset) continue;
    const std::string remedy =
        std::string(reset) + "(" + std::to_string(instance.index) + ", !input)";
    run.report(instance.where,
               "nothing resets the timer " + quoted(instance.name) +
                   ": its second activation has no delay",
               {.help = "add a rung with " + quoted(remedy)});
  }
}

}  // namespace

constinit const Rule timer_without_reset = {
    "RP506", "timer-without-reset", Severity::Warning, Decision::Syntax, kDoc,
    check};

}  // namespace rung
