#include "analysis/rules/support.h"

namespace rung {
namespace {

constexpr std::string_view kDoc = R"md(
## Finds
A bit that a rung writes and that is true at the end of no scan of any run.
Decided by the solver over all reachable states.

## Why it matters
The device never works, and every contact of the cell is dead. The reason is
often far away: an interlock that is always active, a step that no step leads
to.

## Example
Bad:

    M0 = I0 && !I1;
    Q0 = M0 && I1;

Good:

    M0 = I0 && !I1;
    Q0 = M0 && I2;

## Limits
Rungs that hold themselves are told by `latch-never-set`, a timer or counter
alone in its rung by `timer-never-fires` and `counter-never-done`. Nothing is
said of a rung that only follows another cell, nor where another rule has named
the reason in the rung already.
)md";

void check(RuleRun& run) {
  std::vector<bool> latch(run.program.rungs.size());
  for (const Latch& it : run.latches) latch[it.rung.index()] = true;
  for (const CellId id : ids_of(run.program.cells)) {
    const std::span<const std::uint32_t> writers =
        run.index.writers[id.index()];
    if (writers.empty() || run.program.cells[id].type != Type::Bit) continue;
    const std::uint32_t last = writers.back();
    if (latch[last] || is_literal(run, RungId(last)) ||
        only_follows(run, RungId(last))) {
      continue;
    }
    run.ask(
        RuleRun::Want::Proof,
        {run.ts.exprs.negation(run.ts.cell_end[id.index()])},
        [id, last](RuleRun& now, std::span<const RuleRun::Evidence> answers) {
          if (answers[0].answer != RuleRun::Answer::Yes) return;
          if (now.explained(RungId(last))) return;
          now.report(now.program.rungs[RungId(last)].where,
                     quoted(now.program, id) + " can never become true",
                     {.help = proof_text(answers[0])});
        });
  }
}

}  // namespace

constinit const Rule coil_never_true = {
    "RP303", "coil-never-true", Severity::Warning, Decision::Solver, kDoc,
    check};

}  // namespace rung
