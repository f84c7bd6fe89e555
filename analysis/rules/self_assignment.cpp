#include "analysis/rules/jumped_over.h"
#include "analysis/rules/support.h"

namespace rung {
namespace {

constexpr std::string_view kDoc = R"md(
## Finds
A rung that gives its target the value that it has already: `Q0 = Q0`.

## Why it matters
It has no effect. The right side was to name another cell.

## Example
Bad:

    Q0 = I0;
    Q1 = Q1;

Good:

    Q0 = I0;
    Q1 = Q0;

## Limits
Terms are simplified first, so `Q0 = Q0 || Q0` is found as well.
)md";

void check(RuleRun& run) {
  for (const RungId id : ids_of(run.program.rungs)) {
    if (!run.index.reads_itself[id.index()]) continue;
    const Rung& rung = run.program.rungs[id];
    if (is_jumped_over(run.program, rung))
      continue;  // it may never be executed
    for (std::uint32_t i = rung.begin; i < rung.end; ++i) {
      const Node& node = run.program.nodes[i];
      if (node.op != NodeOp::Read || node.cell != rung.target) continue;
      if (run.ts.node_value[i] == run.ts.rung_value[id.index()]) {
        run.explain(id);
        run.report(rung.where,
                   quoted(run.program, rung.target) + " is assigned to itself");
      }
      break;
    }
  }
}

}  // namespace

constinit const Rule self_assignment = {
    "RP313", "self-assignment", Severity::Warning, Decision::Syntax, kDoc,
    check};

}  // namespace rung
