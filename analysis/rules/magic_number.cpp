#include <map>
#include <utility>

#include "analysis/rules/support.h"

namespace rung {
namespace {

constexpr std::string_view kDoc = R"md(
## Finds
A word that is compared with the same number in three places or more.

## Why it matters
The limit is written several times, and one day it is changed in all places but
one. A bit that one rung computes (`hot = IW0 > 620`) says what the limit is
for.

## Example
Bad:

    Q0 = IW0 > 620 && I0;
    Q1 = IW0 > 620 && I1;
    Q2 = IW0 > 620 && I2;

Good:

    hot = IW0 > 620;
    Q0 = hot && I0;
    Q1 = hot && I1;
    Q2 = hot && I2;

## Limits
A note, once a word and number. 0, 1 and -1 are not counted, nor presets.
)md";

struct Uses {
  std::size_t count = 0;
  SourceRange first;
};

void check(RuleRun& run) {
  constexpr std::size_t kMany = 3;
  const Program& program = run.program;
  std::map<std::pair<CellId, std::int64_t>, Uses> uses;
  for (const Node& node : program.nodes) {
    if (!is_comparison(node.op)) continue;
    const Node& a = program.nodes[node.a];
    const Node& b = program.nodes[node.b];
    const bool right = b.op == NodeOp::Constant;
    const Node& word = right ? a : b;
    const Node& number = right ? b : a;
    if (word.op != NodeOp::Read || number.op != NodeOp::Constant ||
        (number.value >= -1 && number.value <= 1)) {
      continue;
    }
    Uses& seen = uses[{word.cell, number.value}];
    if (++seen.count == 1) seen.first = node.where;
    if (seen.count != kMany) continue;
    run.report(node.where,
               quoted(program, word.cell) + " is compared with " +
                   std::to_string(number.value) + " in " +
                   counted(kMany, "place") + " or more",
               {.labels = {{seen.first, "first here"}}});
  }
}

}  // namespace

constinit const Rule magic_number = {
    "RP709", "magic-number", Severity::Note, Decision::Syntax,
    kDoc,    check,          Pack::Pedantic};

}  // namespace rung
