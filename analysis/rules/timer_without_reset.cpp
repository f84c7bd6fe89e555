#include <algorithm>

#include "analysis/rules/support.h"

namespace rung {
namespace {

constexpr std::string_view kDoc = R"md(
## Finds
A timer of the yun dialect without a `TR` on its index, and a retentive timer
of another language that nothing resets.

## Why it matters
In that dialect a timer starts once and runs on: that its input goes false does
not stop it, only `TR` does. So the second activation has no delay at all. A
retentive timer stops, but keeps its time: sooner or later it has no delay.

## Example
Bad:

    y0 = T(0, 5, pin1);
    pin3 = y0;

Good:

    y0 = T(0, 5, pin1);
    y1 = TR(0, !pin1);
    pin3 = y0;

## Limits
That the reset comes at the right time is not checked. Other timers reset
themselves.
)md";

void check(RuleRun& run) {
  for (const InstanceId id : ids_of(run.program.instances)) {
    const Instance& instance = run.program.instances[id];
    const std::string_view reset = reset_name(*instance.kind);
    if (!instance.kind->keeps) continue;
    const std::span<const std::uint32_t> calls = run.index.calls[id.index()];
    const bool is_reset =
        std::any_of(calls.begin(), calls.end(), [&](std::uint32_t call) {
          return run.program.calls[CallId(call)].operation->resets;
        });
    if (is_reset) continue;
    const bool is_function = reset.find('.') == std::string_view::npos;
    const std::string remedy =
        is_function ? "a rung with " +
                          quoted(std::string(reset) + "(" +
                                 std::to_string(instance.index) + ", !input)")
                    : "an instruction that resets it";
    run.report(instance.where,
               "nothing resets the timer " + quoted(instance.name) +
                   ": its second activation has no delay",
               {.help = "add " + remedy});
  }
}

}  // namespace

constinit const Rule timer_without_reset = {
    "RP506", "timer-without-reset", Severity::Warning, Decision::Syntax, kDoc,
    check};

}  // namespace rung
