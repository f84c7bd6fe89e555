#include <algorithm>

#include "analysis/rules/support.h"

namespace rung {
namespace {

constexpr std::string_view kDoc = R"md(
## Finds
A counter that nothing sets back: in the yun dialect no `CR` with its index, in
the sim dialect a reset that is the literal `false`, and no counting down.

## Why it matters
It counts once. In the yun dialect it stays full for ever; in the sim dialect
its result is true at the preset only, and counting goes on past it.

## Example
Bad:

    Q0 = C(0, 3, I0, false, false);

Good:

    Q0 = C(0, 3, I0, false, I1);

## Limits
That a reset exists but never comes is not looked at here.
)md";

bool is_false(const Program& program, std::uint32_t node) {
  return program.nodes[node].op == NodeOp::Constant &&
         program.nodes[node].value == 0;
}

/// A call that takes the count back, by its operation or by its operands.
bool sets_back(const Program& program, const ElementCall& call) {
  if (call.operation->resets) return true;
  // The operands behind the first are `down` and `reset`, where there are any.
  return std::any_of(
      call.arguments.begin() + 1, call.arguments.end(),
      [&](std::uint32_t node) { return !is_false(program, node); });
}

void check(RuleRun& run) {
  for (const InstanceId id : ids_of(run.program.instances)) {
    const Instance& instance = run.program.instances[id];
    if (instance.kind->family != ElementFamily::Counter) continue;
    const std::span<const std::uint32_t> calls = run.index.calls[id.index()];
    const bool is_reset =
        std::any_of(calls.begin(), calls.end(), [&](std::uint32_t call) {
          return sets_back(run.program, run.program.calls[CallId(call)]);
        });
    if (is_reset) continue;
    run.report(instance.where,
               "nothing ever resets the counter " + quoted(instance.name));
  }
}

}  // namespace

constinit const Rule counter_without_reset = {
    "RP504", "counter-without-reset", Severity::Warning, Decision::Syntax, kDoc,
    check};

}  // namespace rung
