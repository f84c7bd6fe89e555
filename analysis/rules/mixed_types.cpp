#include <vector>

#include "analysis/rules/support.h"

namespace rung {
namespace {

constexpr std::string_view kDoc = R"md(
## Finds
A word that stands where a bit is needed, or a bit that is used as a number.

## Why it matters
It works by conversion: true counts as 1, and any number but 0 as true. What was
meant is not said, and a ladder cannot show it.

## Example
Bad:

    Q0 = I0 + I1 + I2 >= 2;

Good:

    Q0 = I0 && I1 || I1 && I2 || I0 && I2;

## Limits
A comparison of a bit with a literal is told by `literal-comparison`.
)md";

bool beside_literal(const RuleRun& run, std::uint32_t node) {
  const std::uint32_t parent = run.index.parent[node];
  if (parent == ProgramIndex::kNone) return false;
  const Node& it = run.program.nodes[parent];
  if (!is_comparison(it.op)) return false;
  const std::uint32_t other = it.a == node ? it.b : it.a;
  return run.program.nodes[other].op == NodeOp::Constant;
}

void check(RuleRun& run) {
  // Elsewhere types are declared, and conversions are the reader's.
  if (run.program.language != "script" && run.program.language != "postfix") {
    return;
  }
  const std::vector<Node>& nodes = run.program.nodes;
  for (std::uint32_t i = 0; i < nodes.size(); ++i) {
    const Node& node = nodes[i];
    if (node.op == NodeOp::ToBit) {
      run.report(
          node.where,
          quoted(text_of(run, node.where)) + " is a number used as a bit",
          {.help = "compare it: `> 0`"});
    } else if (node.op == NodeOp::ToWord && !beside_literal(run, i) &&
               nodes[node.a].op != NodeOp::Constant) {
      run.report(node.where, quoted(text_of(run, node.where)) +
                                 " is a bit used as a number");
    }
  }
}

}  // namespace

constinit const Rule mixed_types = {
    "RP705", "mixed-types", Severity::Note, Decision::Syntax, kDoc, check};

}  // namespace rung
