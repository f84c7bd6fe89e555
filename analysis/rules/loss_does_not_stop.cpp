#include "analysis/rules/wiring.h"

namespace rung {
namespace {

constexpr std::string_view kDoc = R"md(
## Finds
A latch that is broken by an input which a line declares normally closed
(`//@ input I1 nc`), and that can be on while this input is false. The solver
shows such a scan.

## Why it matters
A stop is wired normally closed so that a cut wire or a loose terminal stops the
machine. Where the program reads it the other way round (`!I1`), or where the
start goes around it, losing the signal stops nothing.

## Example
Bad:

    //@ input I1 nc
    Q0 = (I0 || Q0) && !I1;

Good:

    //@ input I1 nc
    Q0 = (I0 || Q0) && I1;

## Limits
Only inputs that are declared `nc`, and only latches that have a contact of the
input among what breaks them. A `reset` is left out: it does not stop. That
nothing at all reads the input is told by `unused-input`.
)md";

void ask(RuleRun& run, const Latch& latch, const Wiring& wiring) {
  ExprArena& exprs = run.ts.exprs;
  const ExprId lost = exprs.negation(run.ts.cell_end[wiring.cell.index()]);
  const ExprId runs =
      exprs.conjunction(lost, run.ts.cell_end[latch.cell.index()]);
  run.ask(RuleRun::Want::Witness, {exprs.negation(runs)},
          [latch, wiring](RuleRun& now,
                          std::span<const RuleRun::Evidence> answers) {
            if (answers[0].answer != RuleRun::Answer::No) return;
            now.report(now.program.rungs[latch.rung].where,
                       quoted(now.program, latch.cell) + " can be on while " +
                           quoted(now.program, wiring.cell) +
                           ", which is normally closed, has no signal",
                       {.labels = {{wiring.where, "declared here"}},
                        .help = witness_text(now, answers[0])});
          });
}

void check(RuleRun& run) {
  if (run.properties.wirings.empty()) return;
  const std::vector<const Wiring*> wirings = wiring_of_cells(run);
  std::vector<const Latch*> asked(run.program.cells.size());
  for (const Latch& latch : run.latches) {
    for (const std::uint32_t node : latch.breaks) {
      for (const std::uint32_t leaf : leaves(run.program, node)) {
        const CellId cell = contact_at(run.program, leaf).cell;
        if (!cell.has_value() || asked[cell.index()] == &latch) continue;
        const Wiring* const wiring = wirings[cell.index()];
        if (wiring == nullptr || !wiring->normally_closed || wiring->reset) {
          continue;
        }
        asked[cell.index()] = &latch;
        ask(run, latch, *wiring);
      }
    }
  }
}

}  // namespace

constinit const Rule loss_does_not_stop = {
    "RP407", "loss-does-not-stop", Severity::Warning, Decision::Solver, kDoc,
    check,   Pack::Safety};

}  // namespace rung
