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

std::string literal(const Node& node) {
  if (node.type == Type::Word) return std::to_string(node.value);
  return node.value != 0 ? "true" : "false";
}

void check(RuleRun& run) {
  for (const RungId id : ids_of(run.program.rungs)) {
    const Rung& rung = run.program.rungs[id];
    if (!is_literal(run, id) ||
        run.index.writers[rung.target.index()].size() != 1) {
      continue;
    }
    run.report(rung.where, quoted(run.program, rung.target) + " is always " +
                               literal(run.program.nodes[rung.root()]));
  }
}

}  // namespace

constinit const Rule constant_coil = {
    "RP315", "constant-coil", Severity::Note, Decision::Syntax, kDoc, check};

}  // namespace rung
