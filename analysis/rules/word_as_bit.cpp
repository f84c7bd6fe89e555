#include <vector>

#include "analysis/rules/support.h"

namespace rung {
namespace {

constexpr std::string_view kDoc = R"md(
## Finds
A word that stands where a bit is needed, or a bit that is used as a number.

## Why it matters
It works by conversion: any number but 0 is true. Which numbers were meant is
not said.

## Example
Bad:

    Q0 = IW0 && I0;

Good:

    Q0 = IW0 > 0 && I0;

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

constinit const Rule word_as_bit = {
    "RP705", "word-as-bit", Severity::Note, Decision::Syntax, kDoc, check};

}  // namespace rung
