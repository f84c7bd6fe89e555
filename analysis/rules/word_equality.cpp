#include "analysis/rules/support.h"

namespace rung {
namespace {

constexpr std::string_view kDoc = R"md(
## Finds
A test for equality (`==`, `!=`, `Cmp(a, "=", b)`) of an analog input with
something else.

## Why it matters
The value is sampled once a scan and may step over the number: the level rises
from 49 to 51 and is never 50.

## Example
Bad:

    Q0 = IW0 == 50;

Good:

    Q0 = IW0 >= 50;

## Limits
A word that is a selector (1, 2, 3) is rightly compared so: allow it with that
reason. Cells that rungs compute are left out.
)md";

bool is_sampled(const Program& program, std::uint32_t node) {
  const Node& it = program.nodes[node];
  return it.op == NodeOp::Read && it.type == Type::Word &&
         program.cells[it.cell].role == CellRole::Input;
}

void check(RuleRun& run) {
  for (const Node& node : run.program.nodes) {
    if (node.op != NodeOp::Equal && node.op != NodeOp::NotEqual) continue;
    const bool left = is_sampled(run.program, node.a);
    if (!left && !is_sampled(run.program, node.b)) continue;
    const Node& word = run.program.nodes[left ? node.a : node.b];
    run.report(node.where,
               "the analog value " + quoted(run.program, word.cell) +
                   " may step over the one that it is compared with",
               {.help = "compare with `<` or `>`"});
  }
}

}  // namespace

constinit const Rule word_equality = {
    "RP503", "word-equality", Severity::Note, Decision::Syntax, kDoc, check};

}  // namespace rung
