#include "analysis/rules/support.h"

namespace rung {
namespace {

constexpr std::string_view kDoc = R"md(
## Finds
A rung that assigns a literal and nothing else: `Q0 = true`.

## Why it matters
It may be a test at the machine that was not taken back. A value that never
changes is plainer as a `//Var` line.

## Example
Bad:

    Q0 = true;

Good:

    Q0 = I0;

## Limits
Only cells with this one writer: two rungs are told by `double-coil`.
)md";

void check(RuleRun& run) {
  for (const RungId id : ids_of(run.program.rungs)) {
    const Rung& rung = run.program.rungs[id];
    if (!is_literal(run, id) ||
        run.index.writers[rung.target.index()].size() != 1) {
      continue;
    }
    run.report(rung.where, quoted(run.program, rung.target) + " is always " +
                               std::string(text_of(
                                   run, run.program.nodes[rung.root()].where)));
  }
}

}  // namespace

constinit const Rule constant_coil = {
    "RP315", "constant-coil", Severity::Note, Decision::Syntax, kDoc, check};

}  // namespace rung
