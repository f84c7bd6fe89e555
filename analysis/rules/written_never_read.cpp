#include "analysis/rules/support.h"

namespace rung {
namespace {

constexpr std::string_view kDoc = R"md(
## Finds
A memory cell that a rung writes and nothing reads: no rung, no property line,
no plant.

## Why it matters
The rung computes a value for nobody: an output was not connected, or a contact
further down names the wrong cell.

## Example
Bad:

    M0 = I0 && I1;
    Q0 = I0;

Good:

    M0 = I0 && I1;
    Q0 = M0;

## Limits
Outputs are read by the world. A rung that only resets a timer or a counter
needs a target that nobody reads. The result of a timer or counter is looked at
by `ignored-result`.
)md";

/// A reset is called for its effect; so are the other elements.
bool is_called_for_effect(const RuleRun& run, const Rung& rung) {
  return run.program.nodes[rung.root()].op == NodeOp::Call;
}

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
    if (is_called_for_effect(run, rung)) continue;
    run.report(rung.target_where, quoted(cell.name) + " is never read");
  }
}

}  // namespace

constinit const Rule written_never_read = {
    "RP109", "written-never-read", Severity::Warning, Decision::Syntax, kDoc,
    check};

}  // namespace rung
