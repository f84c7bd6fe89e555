#include "analysis/rules/support.h"

namespace rung {
namespace {

constexpr std::string_view kDoc = R"md(
## Finds
A word cell of the sim dialect that a rung reads before any rung has written it
in the first scan, without a `//Var` value.

## Why it matters
In the browser the name is undefined in the first scan, arithmetic on it gives
NaN, and NaN stays: every comparison with it is false from then on. Here the
cell starts at 0, so proofs and the browser would differ.

## Example
Bad:

    N = N + 1;
    Q0 = N > 5;

Good:

    N = N + 1;
    Q0 = N > 5;
    //Var
    N = 0;

## Limits
Bits are left out: undefined reads as false there, which is their start value.
)md";

void check(RuleRun& run) {
  if (run.program.dialect != "sim") return;
  for (const CellId id : ids_of(run.program.cells)) {
    const Cell& cell = run.program.cells[id];
    const std::span<const std::uint32_t> writers =
        run.index.writers[id.index()];
    const std::span<const std::uint32_t> reads = run.index.reads[id.index()];
    if (cell.type != Type::Word || cell.role != CellRole::Memory ||
        cell.initialised || writers.empty() || reads.empty()) {
      continue;
    }
    if (run.index.rung_of[reads[0]] > writers[0]) continue;
    run.report(run.program.nodes[reads[0]].where,
               quoted(cell.name) + " has no value in the first scan",
               {.labels = {{run.program.rungs[RungId(writers[0])].target_where,
                            "first written here"}},
                .help = "give it one under `//Var`"});
  }
}

}  // namespace

constinit const Rule read_before_initialised = {"RP207",
                                                "read-before-initialised",
                                                Severity::Warning,
                                                Decision::Syntax,
                                                kDoc,
                                                check};

}  // namespace rung
