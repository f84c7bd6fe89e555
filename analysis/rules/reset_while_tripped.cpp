#include "analysis/rules/wiring.h"

namespace rung {
namespace {

constexpr std::string_view kDoc = R"md(
## Finds
A memory that a declared trip sets (`//@ input I1 trip`) and that can be cleared
in a scan in which the trip is still active. The solver shows such a scan.

## Why it matters
The memory is there so that somebody looks at the machine before it runs again.
When it can be acknowledged while its cause is still there, the acknowledgement
says nothing, and an operator who holds the button has switched the memory off.

## Example
Bad:

    //@ input I1 trip
    //@ input I2 reset
    M0 = (I1 || M0) && !I2;
    Q0 = I0 && !M0;

Good:

    //@ input I1 trip
    //@ input I2 reset
    M0 = I1 || M0 && !I2;
    Q0 = I0 && !M0;

## Limits
Only inputs that are declared `trip`, and memories that have a contact of the
trip among what sets them. It does not say that the machine runs: another
contact of the trip may still hold it.
)md";

void ask(RuleRun& run, const Latch& latch, const Wiring& wiring) {
  ExprArena& exprs = run.ts.exprs;
  const ExprId cleared =
      exprs.conjunction(run.ts.cell_begin[latch.cell.index()],
                        exprs.negation(run.ts.cell_end[latch.cell.index()]));
  const ExprId early = exprs.conjunction(cleared, is_active(run, wiring));
  run.ask(RuleRun::Want::Witness, {exprs.negation(early)},
          [latch, wiring](RuleRun& now,
                          std::span<const RuleRun::Evidence> answers) {
            if (answers[0].answer != RuleRun::Answer::No) return;
            now.report(now.program.rungs[latch.rung].where,
                       quoted(now.program, latch.cell) +
                           " can be reset while " +
                           device(now.program, wiring) + " is still active",
                       {.labels = {{wiring.where, "declared here"}},
                        .help = witness_text(now, answers[0])});
          });
}

void check(RuleRun& run) {
  if (run.properties.wirings.empty()) return;
  const std::vector<const Wiring*> wirings = wiring_of_cells(run);
  std::vector<const Latch*> asked(run.program.cells.size());
  for (const Latch& latch : run.latches) {
    for (const std::uint32_t node : latch.sets) {
      for (const std::uint32_t leaf : leaves(run.program, node)) {
        const Contact contact = contact_at(run.program, leaf);
        if (!contact.cell.has_value()) continue;
        const Wiring* const wiring = wirings[contact.cell.index()];
        if (wiring == nullptr || !wiring->trip || !follows(*wiring, contact) ||
            asked[contact.cell.index()] == &latch) {
          continue;
        }
        asked[contact.cell.index()] = &latch;
        ask(run, latch, *wiring);
      }
    }
  }
}

}  // namespace

constinit const Rule reset_while_tripped = {
    "RP408", "reset-while-tripped", Severity::Warning, Decision::Solver, kDoc,
    check,   Pack::Safety};

}  // namespace rung
