#include "analysis/rules/support.h"

namespace rung {
namespace {

constexpr std::string_view kDoc = R"md(
## Finds
A timer, counter or edge whose result goes into a memory cell that nothing
reads.

## Why it matters
The element runs, and nobody looks at it: the delay or the count has no effect.

## Example
Bad:

    M0 = T(0, 5, I0);
    Q0 = I0;

Good:

    M0 = T(0, 5, I0);
    Q0 = M0;

## Limits
Only rungs that hold nothing but the call. A reset (`TR`, `CR`) is called for
its effect and is not reported, nor is an element that a property line or
another rung uses.
)md";

void check(RuleRun& run) {
  for (const CellId id : ids_of(run.program.cells)) {
    const Cell& cell = run.program.cells[id];
    const std::span<const std::uint32_t> writers =
        run.index.writers[id.index()];
    if (cell.role != CellRole::Memory || writers.empty() ||
        run.index.is_used(id)) {
      continue;
    }
    const Rung& rung = run.program.rungs[RungId(writers[0])];
    const Node& root = run.program.nodes[rung.root()];
    if (root.op != NodeOp::Call) continue;
    const ElementCall& call = run.program.calls[root.call];
    if (call.operation->resets || run.index.observed[call.instance.index()] ||
        has_status(*run.program.instances[call.instance].kind)) {
      continue;
    }
    run.report(root.where,
               "nothing uses the result of " +
                   quoted(run.program.instances[call.instance].name),
               {.labels = {{rung.target_where,
                            quoted(cell.name) + " is never read"}}});
  }
}

}  // namespace

constinit const Rule ignored_result = {
    "RP205", "ignored-result", Severity::Warning, Decision::Syntax, kDoc,
    check};

}  // namespace rung
