#include <vector>

#include "analysis/rules/support.h"

namespace rung {
namespace {

constexpr std::string_view kDoc = R"md(
## Finds
A rung that holds itself and that no run ever sets. Decided by the solver over
all reachable states.

## Why it matters
What the latch remembers never happens: its start is covered by its own stop,
or waits for something that waits for the latch.

## Example
Bad:

    Q0 = (Q0 || I0 && I1) && !I0;

Good:

    Q0 = (Q0 || I0 && I1) && !I2;

## Limits
A rung without any branch that could set it is told by `reset-without-set`.
)md";

void check(RuleRun& run) {
  for (const Latch& latch : run.latches) {
    const std::span<const std::uint32_t> writers =
        run.index.writers[latch.cell.index()];
    if (writers.back() != latch.rung.index()) continue;
    // What one rung sets and another resets in the same scan is set.
    std::vector<ExprId> values;
    values.reserve(writers.size());
    for (const std::uint32_t rung : writers) {
      values.push_back(run.ts.rung_value[rung]);
    }
    run.ask(RuleRun::Want::Proof,
            {run.ts.exprs.negation(run.ts.exprs.disjunction(values))},
            [latch](RuleRun& now, std::span<const RuleRun::Evidence> answers) {
              if (answers[0].answer != RuleRun::Answer::Yes ||
                  now.explained(latch.rung)) {
                return;
              }
              now.report(
                  now.program.rungs[latch.rung].where,
                  "nothing can ever set " + quoted(now.program, latch.cell),
                  {.help = proof_text(answers[0])});
            });
  }
}

}  // namespace

constinit const Rule latch_never_set = {
    "RP405", "latch-never-set", Severity::Warning, Decision::Solver, kDoc,
    check};

}  // namespace rung
