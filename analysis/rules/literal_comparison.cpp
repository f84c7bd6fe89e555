#include "analysis/rules/support.h"

namespace rung {
namespace {

constexpr std::string_view kDoc = R"md(
## Finds
A bit that is compared with a literal: `I0 == true`, `I0 != false`, `I0 == 1`.

## Why it matters
The comparison says what `I0` or `!I0` says alone. In JavaScript the habit ends
in `=` for `==`.

## Example
Bad:

    Q0 = I0 == true && I1 == false;

Good:

    Q0 = I0 && !I1;

## Limits
Words compared with numbers are not meant.
)md";

bool is_constant(const Program& program, std::uint32_t node) {
  const Node& it = program.nodes[node];
  return it.op == NodeOp::Constant ||
         (it.op == NodeOp::ToWord &&
          program.nodes[it.a].op == NodeOp::Constant);
}

/// Bits are compared as words, or by an exclusive or.
bool is_bit(const Program& program, std::uint32_t node) {
  const Node& it = program.nodes[node];
  if (it.op == NodeOp::ToWord) return !is_constant(program, it.a);
  return it.type == Type::Bit && it.op != NodeOp::Constant;
}

void check(RuleRun& run) {
  for (const Node& node : run.program.nodes) {
    if (!is_comparison(node.op) && node.op != NodeOp::Xor) continue;
    const bool found =
        (is_bit(run.program, node.a) && is_constant(run.program, node.b)) ||
        (is_constant(run.program, node.a) && is_bit(run.program, node.b));
    if (found) {
      run.report(node.where, "a bit is compared with a literal",
                 {.help = "write the bit, or its inverse"});
    }
  }
}

}  // namespace

constinit const Rule literal_comparison = {"RP314",        "literal-comparison",
                                           Severity::Note, Decision::Syntax,
                                           kDoc,           check};

}  // namespace rung
