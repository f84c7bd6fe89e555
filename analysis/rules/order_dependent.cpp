#include "analysis/rules/interlock.h"
#include "analysis/rules/support.h"

namespace rung {
namespace {

constexpr std::string_view kDoc = R"md(
## Finds
Two rungs that read each other's cells and that give other values when they
change places. The solver shows such a scan.

## Why it matters
The upper one sees what the lower one wrote in the scan before, the lower one
what the upper one has just written: with both inputs at once the upper one wins.
That may be meant, but nothing in the rungs says so.

## Example
Bad:

    Q0 = I0 && !Q1;
    Q1 = I1 && !Q0;

Good:

    Q0 = I0 && !I1;
    Q1 = I1 && !I0;

## Limits
A note. Cells with one rung each, where nothing that the lower rung reads is
written between the two.
)md";

bool has_one_rung(const RuleRun& run, CellId cell) {
  return run.index.writers[cell.index()].size() == 1 &&
         run.program.cells[cell].type == Type::Bit &&
         !run.program.cells[cell].made;
}

/// Could the lower rung stand above the upper one and read the same values,
/// but for the upper one's cell?
bool can_move(const RuleRun& run, RungId upper, RungId lower) {
  const Rung& rung = run.program.rungs[lower];
  for (std::uint32_t i = rung.begin; i < rung.end; ++i) {
    const Node& node = run.program.nodes[i];
    if (node.op == NodeOp::Call) return false;
    if (node.op != NodeOp::Read) continue;
    const std::uint32_t above = writer_above(run, node.cell, lower.index());
    if (above != ProgramIndex::kNone && above > upper.index()) return false;
  }
  return true;
}

void ask(RuleRun& run, RungId upper, RungId lower) {
  const CellId first = run.program.rungs[upper].target;
  const CellId second = run.program.rungs[lower].target;
  ExprArena& exprs = run.ts.exprs;
  const ExprId moved =
      value_with(run, lower, first, run.ts.cell_begin[first.index()]);
  if (!moved.has_value()) return;
  const ExprId then = value_with(run, upper, second, moved);
  if (!then.has_value()) return;
  const ExprId same = exprs.conjunction(
      exprs.equivalence(moved, run.ts.rung_value[lower.index()]),
      exprs.equivalence(then, run.ts.rung_value[upper.index()]));
  run.ask(
      RuleRun::Want::Witness, {same},
      [upper, lower](RuleRun& now, std::span<const RuleRun::Evidence> answers) {
        if (answers[0].answer != RuleRun::Answer::No) return;
        const Program& program = now.program;
        now.report(program.rungs[upper].where,
                   "the order of the rungs of " +
                       quoted(program, program.rungs[upper].target) + " and " +
                       quoted(program, program.rungs[lower].target) +
                       " decides: this one is first",
                   {.labels = {{program.rungs[lower].where,
                                "above it, this one would win"}},
                    .help = witness_text(now, answers[0])});
      });
}

void check(RuleRun& run) {
  if (!run.has_oracle) return;
  for (const RungId upper : ids_of(run.program.rungs)) {
    const Rung& rung = run.program.rungs[upper];
    if (!has_one_rung(run, rung.target)) continue;
    CellId last;  // one question a pair
    for (std::uint32_t i = rung.begin; i < rung.end; ++i) {
      const Node& node = run.program.nodes[i];
      if (node.op == NodeOp::Call) break;
      if (node.op != NodeOp::Read || node.cell == last ||
          !has_one_rung(run, node.cell)) {
        continue;
      }
      const RungId lower(run.index.writers[node.cell.index()][0]);
      if (lower <= upper || !reads(run, lower, rung.target) ||
          !can_move(run, upper, lower)) {
        continue;
      }
      last = node.cell;
      ask(run, upper, lower);
    }
  }
}

}  // namespace

constinit const Rule order_dependent = {
    "RP603", "order-dependent", Severity::Note, Decision::Solver, kDoc,
    check,   Pack::Pedantic};

}  // namespace rung
