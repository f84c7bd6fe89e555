#include <vector>

#include "analysis/rules/support.h"

namespace rung {
namespace {

constexpr std::string_view kDoc = R"md(
## Finds
Two latching outputs of which one is interlocked against the other, but not the
other way round, and that the solver shows to be on together at the end of a
scan.

## Why it matters
An interlock works only when both sides have it. Here the second start switches
the second output on while the first one still is: two contactors across one
motor.

## Example
Bad:

    Q0 = (Q0 || I0) && !I2 && !Q1;
    Q1 = (Q1 || I1) && !I2;

Good:

    Q0 = (Q0 || I0) && !I2 && !Q1;
    Q1 = (Q1 || I1) && !I2 && !Q0;

## Limits
Both rungs must hold themselves. What must never be on together is better said
by `//@ interlock`, which is proved for any rungs.
)md";

/// Outputs whose inverted contact breaks the latch.
std::vector<CellId> locked_against(const RuleRun& run, const Latch& latch) {
  std::vector<CellId> cells;
  for (const std::uint32_t node : latch.breaks) {
    for (const std::uint32_t part : operands(run.program, node, NodeOp::And)) {
      const Contact contact = contact_at(run.program, part);
      if (contact.cell.has_value() && contact.inverted &&
          contact.cell != latch.cell &&
          run.program.cells[contact.cell].role == CellRole::Output) {
        cells.push_back(contact.cell);
      }
    }
  }
  return cells;
}

bool reads(const RuleRun& run, const Rung& rung, CellId cell) {
  for (std::uint32_t i = rung.begin; i < rung.end; ++i) {
    const Node& node = run.program.nodes[i];
    if (node.op == NodeOp::Read && node.cell == cell) return true;
  }
  return false;
}

void ask(RuleRun& run, const Latch& locked, const Latch& free) {
  const ExprId both = run.ts.exprs.conjunction(
      run.ts.cell_end[locked.cell.index()], run.ts.cell_end[free.cell.index()]);
  run.ask(
      RuleRun::Want::Witness, {run.ts.exprs.negation(both)},
      [locked, free](RuleRun& now, std::span<const RuleRun::Evidence> answers) {
        if (answers[0].answer != RuleRun::Answer::No) return;
        const std::string first = quoted(now.program, locked.cell);
        const std::string second = quoted(now.program, free.cell);
        now.report(now.program.rungs[free.rung].where,
                   second + " is not interlocked against " + first +
                       ", and both can be on",
                   {.labels = {{now.program.rungs[locked.rung].where,
                                first + " is interlocked against " + second}},
                    .help = witness_text(now, answers[0])});
      });
}

void check(RuleRun& run) {
  std::vector<const Latch*> latch_of(run.program.cells.size());
  for (const Latch& latch : run.latches) {
    if (!latch.sets.empty() &&
        run.program.cells[latch.cell].role == CellRole::Output) {
      latch_of[latch.cell.index()] = &latch;
    }
  }
  for (const Latch& latch : run.latches) {
    if (latch_of[latch.cell.index()] != &latch) continue;
    for (const CellId other : locked_against(run, latch)) {
      const Latch* const free = latch_of[other.index()];
      if (free == nullptr ||
          reads(run, run.program.rungs[free->rung], latch.cell)) {
        continue;
      }
      ask(run, latch, *free);
    }
  }
}

}  // namespace

constinit const Rule one_sided_interlock = {
    "RP406", "one-sided-interlock", Severity::Warning, Decision::Solver, kDoc,
    check};

}  // namespace rung
