#include "analysis/rules/jumped_over.h"
#include "analysis/rules/support.h"

namespace rung {
namespace {

constexpr std::string_view kDoc = R"md(
## Finds
A literal `true` or `false` as an operand of `&&`, `||` or `!`.

## Why it matters
The operator has no effect, or the other operand has none. It is what a test at
the machine leaves behind: a contact bridged with `true`, a rung switched off
with `&& false`.

## Example
Bad:

    Q0 = I0 && true;

Good:

    Q0 = I0;

## Limits
A rung that is a literal and nothing else is told by `constant-coil`. Literals
as arguments of a timer or counter are usual.
)md";

/// What the literal does to the operator that it stands in.
std::string_view effect(NodeOp op, bool value) {
  if (op == NodeOp::And) {
    return value ? "has no effect" : "makes the whole series false";
  }
  if (op == NodeOp::Or) {
    return value ? "makes all branches true" : "has no effect";
  }
  return "makes this a constant";
}

/// Is the node the `run && x` of a statement under a condition? A literal there
/// is what is assigned.
bool is_assigned(const RuleRun& run, std::uint32_t node) {
  const Rung& rung = run.program.rungs[RungId(run.index.rung_of[node])];
  return is_jumped_over(run.program, rung) &&
         run.program.nodes[rung.root()].a == node;
}

void check(RuleRun& run) {
  const std::vector<Node>& nodes = run.program.nodes;
  for (std::uint32_t i = 0; i < nodes.size(); ++i) {
    const Node& node = nodes[i];
    if (node.op != NodeOp::Constant || node.type != Type::Bit) continue;
    const std::uint32_t parent = run.index.parent[i];
    if (parent == ProgramIndex::kNone) continue;
    if (is_assigned(run, parent)) continue;
    const NodeOp op = nodes[parent].op;
    if (!is_and_or(op) && op != NodeOp::Not) continue;
    run.explain(RungId(run.index.rung_of[i]));
    if (nodes[parent].where == node.where) continue;  // a reader's, as in Cmp
    run.report(node.where, std::string("this literal ") +
                               std::string(effect(op, node.value != 0)));
  }
}

}  // namespace

constinit const Rule constant_operand = {
    "RP302", "constant-operand", Severity::Warning, Decision::Syntax, kDoc,
    check};

}  // namespace rung
