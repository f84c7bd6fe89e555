#include <vector>

#include "analysis/rules/wiring.h"

namespace rung {
namespace {

constexpr std::string_view kDoc = R"md(
## Finds
A latch that a declared reset (`//@ input I2 reset`) clears although it was
pressed already in the scan before: the button acts by its level, not when it is
pressed. The solver shows such a run.

## Why it matters
A reset button that is jammed or bridged acknowledges every trip at once, and
nobody notices: ISO 13849-1 asks for an edge.

## Example
Bad:

    //@ input I1 trip
    //@ input I2 reset
    M0 = I1 || M0 && !I2;
    Q0 = I0 && !M0;

Good:

    //@ input I1 trip
    //@ input I2 reset
    M0 = I1 || M0 && !(I2 && !M1);
    M1 = I2;
    Q0 = I0 && !M0;

## Limits
Only inputs that are declared `reset`, and latches that read the input where
they are broken, in their own rung or in the rung above that.
)md";

/// By cell: the reset that it is, or that a rung of it reads.
std::vector<const Wiring*> near_resets(const RuleRun& run) {
  std::vector<const Wiring*> near(run.program.cells.size());
  for (const Wiring& wiring : run.properties.wirings) {
    if (!wiring.reset) continue;
    near[wiring.cell.index()] = &wiring;
    for (const std::uint32_t node : run.index.reads[wiring.cell.index()]) {
      const RungId rung(run.index.rung_of[node]);
      near[run.program.rungs[rung].target.index()] = &wiring;
    }
  }
  return near;
}

/// The reset that the expression at `node` depends on; null when none. What
/// the latch itself is does not count.
const Wiring* reset_in(const RuleRun& run, std::uint32_t node, CellId latch,
                       const std::vector<const Wiring*>& near) {
  for (std::uint32_t i = run.index.first[node]; i <= node; ++i) {
    const Node& it = run.program.nodes[i];
    if (it.op != NodeOp::Read || it.cell == latch) continue;
    if (near[it.cell.index()] != nullptr) return near[it.cell.index()];
  }
  return nullptr;
}

/// It was held, its break alone is open, and the latch lets go.
ExprId clears_when_held(RuleRun& run, const Latch& latch, std::size_t broken,
                        const Wiring& reset) {
  ExprArena& exprs = run.ts.exprs;
  const ExprId pressed = is_active(run, reset);
  std::vector<ExprId> all = {
      pressed, run.past.previous(pressed), run.ts.node_value[latch.read],
      exprs.negation(run.ts.rung_value[latch.rung.index()])};
  for (std::size_t i = 0; i < latch.breaks.size(); ++i) {
    const ExprId closed = run.ts.node_value[latch.breaks[i]];
    all.push_back(i == broken ? exprs.negation(closed) : closed);
  }
  return exprs.conjunction(all);
}

void ask(RuleRun& run, const Latch& latch, std::size_t broken,
         const Wiring& reset) {
  run.ask(
      RuleRun::Want::Witness,
      {run.ts.exprs.negation(clears_when_held(run, latch, broken, reset))},
      [latch, reset](RuleRun& now, std::span<const RuleRun::Evidence> answers) {
        if (answers[0].answer != RuleRun::Answer::No) return;
        now.report(now.program.rungs[latch.rung].where,
                   device(now.program, reset) + " clears " +
                       quoted(now.program, latch.cell) +
                       " by its level: held or bridged it resets at once",
                   {.labels = {{reset.where, "declared here"}},
                    .help = witness_text(now, answers[0])});
      });
}

void check(RuleRun& run) {
  if (!run.has_oracle || run.properties.wirings.empty()) return;
  const std::vector<const Wiring*> near = near_resets(run);
  for (const Latch& latch : run.latches) {
    for (std::size_t i = 0; i < latch.breaks.size(); ++i) {
      const Wiring* const reset =
          reset_in(run, latch.breaks[i], latch.cell, near);
      if (reset == nullptr) continue;
      ask(run, latch, i, *reset);
      break;
    }
  }
}

}  // namespace

constinit const Rule level_reset = {
    "RP410", "level-reset", Severity::Warning, Decision::Solver,
    kDoc,    check,         Pack::Safety};

}  // namespace rung
