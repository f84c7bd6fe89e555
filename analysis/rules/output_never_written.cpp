#include "analysis/rules/support.h"

namespace rung {
namespace {

constexpr std::string_view kDoc = R"md(
## Finds
An output that no rung writes, although a rung reads it or a line declares it.

## Why it matters
The output keeps the value that it had before the first scan: the device
behind it never works, and contacts that read it never change.

## Example
Bad:

    Q1 = Q0 && I0;

Good:

    Q0 = I1;
    Q1 = Q0 && I0;

## Limits
Outputs that the program does not mention are not missed. That an output is
written more than once in a scan is told by `double-coil`.
)md";

void check(RuleRun& run) {
  for (const CellId id : ids_of(run.program.cells)) {
    const Cell& cell = run.program.cells[id];
    if (cell.role != CellRole::Output ||
        !run.index.writers[id.index()].empty()) {
      continue;
    }
    for (const std::uint32_t read : run.index.reads[id.index()]) {
      run.explain(RungId(run.index.rung_of[read]));
    }
    run.report(cell.where, "no rung writes the output " + quoted(cell.name));
  }
}

}  // namespace

constinit const Rule output_never_written = {
    "RP105", "output-never-written", Severity::Warning, Decision::Syntax, kDoc,
    check};

}  // namespace rung
