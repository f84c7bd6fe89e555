#include "analysis/rules/support.h"

namespace rung {
namespace {

constexpr std::string_view kDoc = R"md(
## Finds
A bit that a rung writes and that is true at the end of every scan of every
run. Decided by the solver over all reachable states.

## Why it matters
Nothing switches the device off: a lamp that is always lit tells nothing, a
valve that is always open is a hazard.

## Example
Bad:

    M0 = I0 && I1;
    Q0 = !M0 || I1;

Good:

    M0 = I0 && I1;
    Q0 = !M0 && I1;

## Limits
A rung that is the literal `true` is told by `constant-coil`. Nothing is said of
a rung that only follows another cell, or one timer or counter.
)md";

void check(RuleRun& run) {
  for (const CellId id : ids_of(run.program.cells)) {
    const std::span<const std::uint32_t> writers =
        run.index.writers[id.index()];
    if (writers.empty() || run.program.cells[id].type != Type::Bit) continue;
    const std::uint32_t last = writers.back();
    if (is_literal(run, RungId(last)) || only_follows(run, RungId(last))) {
      continue;
    }
    run.ask(
        RuleRun::Want::Proof, {run.ts.cell_end[id.index()]},
        [id, last](RuleRun& now, std::span<const RuleRun::Evidence> answers) {
          if (answers[0].answer != RuleRun::Answer::Yes) return;
          if (now.explained(RungId(last))) return;
          now.report(now.program.rungs[RungId(last)].where,
                     quoted(now.program, id) + " can never become false",
                     {.help = proof_text(answers[0])});
        });
  }
}

}  // namespace

constinit const Rule coil_never_false = {
    "RP304", "coil-never-false", Severity::Warning, Decision::Solver, kDoc,
    check};

}  // namespace rung
