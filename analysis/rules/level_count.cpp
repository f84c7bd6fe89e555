#include "analysis/rules/support.h"

namespace rung {
namespace {

constexpr std::string_view kDoc = R"md(
## Finds
A count written by hand (`n = n + 1` under a condition) that counts in two scans
in a row while all inputs are held. The solver shows such a run.

## Why it matters
It counts scans, not events: a part that stands in front of the sensor for a
second is counted a hundred times. A count goes with the edge.

## Example
Bad:

    QW0 = QW0 + I0;

Good:

    QW0 = QW0 + (I0 && !M0);
    M0 = I0;

## Limits
A note: a program may measure time in scans. Only sums of the cell and a bit or
a constant, under a condition; what counts in every scan whatever happens is
meant so.
)md";

/// Skips what only converts or wraps.
const Node& inner(const Program& program, std::uint32_t index) {
  const Node* node = &program.nodes[index];
  while (node->op == NodeOp::Wrap16 || node->op == NodeOp::Wrap) {
    node = &program.nodes[node->a];
  }
  return *node;
}

/// `n + 1`, `n - 1`, `n + bit`
bool is_step(const Program& program, const Node& node, CellId cell) {
  if (node.op != NodeOp::Add && node.op != NodeOp::Subtract) return false;
  const Node& a = inner(program, node.a);
  const Node& b = inner(program, node.b);
  const auto is_own = [&](const Node& it) {
    return it.op == NodeOp::Read && it.cell == cell;
  };
  const auto is_unit = [](const Node& it) {
    return it.op == NodeOp::ToWord ||
           (it.op == NodeOp::Constant && (it.value == 1 || it.value == -1));
  };
  return (is_own(a) && is_unit(b)) || (is_unit(a) && is_own(b));
}

/// Counts by steps of one, under some condition.
bool counts(const RuleRun& run, RungId id) {
  const Rung& rung = run.program.rungs[id];
  bool has_step = false;
  bool has_condition = false;
  for (std::uint32_t i = rung.begin; i < rung.end; ++i) {
    const Node& node = run.program.nodes[i];
    has_step = has_step || is_step(run.program, node, rung.target);
    has_condition =
        has_condition || (node.op == NodeOp::Read && node.type == Type::Bit);
  }
  return has_step && has_condition;
}

void ask(RuleRun& run, RungId id) {
  ExprArena& exprs = run.ts.exprs;
  const CellId cell = run.program.rungs[id].target;
  const ExprId end = run.ts.cell_end[cell.index()];
  const ExprId moved =
      exprs.negation(exprs.equal(end, run.ts.cell_begin[cell.index()]));
  const ExprId again = exprs.conjunction(
      {moved, run.past.previous(moved), run.past.inputs_rest(end)});
  run.ask(RuleRun::Want::Witness, {exprs.negation(again)},
          [id, cell](RuleRun& now, std::span<const RuleRun::Evidence> answers) {
            if (answers[0].answer != RuleRun::Answer::No) return;
            now.report(now.program.rungs[id].where,
                       quoted(now.program, cell) +
                           " counts scans: it moves again while all inputs "
                           "are held",
                       {.help = witness_text(now, answers[0])});
          });
}

void check(RuleRun& run) {
  if (!run.has_oracle) return;
  constexpr std::size_t kMostQuestions = 16;  // each looks at a whole cone
  std::size_t asked = 0;
  for (const RungId id : ids_of(run.program.rungs)) {
    const Cell& cell = run.program.cells[run.program.rungs[id].target];
    if (cell.type != Type::Word || cell.made ||
        !run.index.reads_itself[id.index()] || !counts(run, id)) {
      continue;
    }
    if (asked++ == kMostQuestions) return;
    ask(run, id);
  }
}

}  // namespace

constinit const Rule level_count = {
    "RP510", "level-count", Severity::Note, Decision::Solver, kDoc, check};

}  // namespace rung
