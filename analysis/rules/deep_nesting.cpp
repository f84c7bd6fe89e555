#include <algorithm>
#include <vector>

#include "analysis/rules/support.h"

namespace rung {
namespace {

constexpr std::string_view kDoc = R"md(
## Finds
A rung in which `&&` and `||` alternate more than five deep.

## Why it matters
Each level is a branch within a branch: the ladder of it cannot be drawn in a
readable way, and mistakes hide in the parentheses.

## Example
Bad:

    Q0 = I0 && (I1 || I2 && (I3 || I4 && (I5 || I6 && (I7 || I8))));

Good:

    M0 = I4 && (I5 || I6 && (I7 || I8));
    Q0 = I0 && (I1 || I2 && (I3 || M0));

## Limits
Chains of one operator count as one level, however long they are.
)md";

constexpr std::uint32_t kDeep = 5;

void check(RuleRun& run) {
  const std::vector<Node>& nodes = run.program.nodes;
  std::vector<std::uint32_t> depth(nodes.size(), 0);
  for (const Rung& rung : run.program.rungs) {
    for (std::uint32_t i = rung.begin; i < rung.end; ++i) {
      const NodeOp op = nodes[i].op;
      const std::uint32_t parent = run.index.parent[i];
      if (is_and_or(op)) depth[i] = std::max(depth[i], 1U);
      if (parent == ProgramIndex::kNone) continue;
      const bool deeper = is_and_or(nodes[parent].op) && nodes[parent].op != op;
      depth[parent] = std::max(depth[parent], depth[i] + (deeper ? 1U : 0U));
    }
    const std::uint32_t levels = depth[rung.root()];
    if (levels <= kDeep) continue;
    run.report(rung.where, "`&&` and `||` are nested " +
                               std::to_string(levels) + " deep, more than " +
                               std::to_string(kDeep));
  }
}

}  // namespace

constinit const Rule deep_nesting = {
    "RP702", "deep-nesting", Severity::Note, Decision::Syntax, kDoc, check};

}  // namespace rung
