#include "analysis/rules/support.h"

namespace rung {
namespace {

constexpr std::string_view kDoc = R"md(
## Finds
A cell that two rungs write, where the later rung does not build on the value
of the earlier one.

## Why it matters
Rungs run from top to bottom, every scan: the last one wins. What the earlier
rung computed is lost, or is seen only by the rungs between the two.

## Example
Bad:

    Q0 = I0;
    Q0 = I1;

Good:

    Q0 = I0 || I1;

## Limits
When the solver proves that both rungs write the same value in every scan the
finding is a note. A rung that reads its own target (`Q0 = Q0 && !I1`) goes on
with the earlier value and is not counted.
)md";

struct Pair {
  CellId cell;
  std::uint32_t earlier = 0;
  std::uint32_t later = 0;
};

void judge(RuleRun& run, const Pair& pair, std::size_t writers,
           std::span<const RuleRun::Evidence> answers) {
  if (run.explained(RungId(pair.later))) return;
  const Rung& earlier = run.program.rungs[RungId(pair.earlier)];
  const Rung& later = run.program.rungs[RungId(pair.later)];
  const std::string name = quoted(run.program, pair.cell);
  if (answers[0].answer == RuleRun::Answer::Yes) {
    run.report(later.target_where,
               name + " is written twice in a scan, with the same value",
               {.labels = {{earlier.target_where, "the same value here"}},
                .help = proof_text(answers[0]),
                .downgrade = true});
    return;
  }
  const bool differs = answers[0].answer == RuleRun::Answer::No;
  run.report(
      later.target_where,
      name + " is written by " + counted(writers, "rung") +
          "; the last one wins",
      {.labels = {{earlier.target_where, "this value is lost here"}},
       .help = differs ? "the values differ: " + witness_text(run, answers[0])
                       : ""});
}

void check(RuleRun& run) {
  for (const CellId cell : ids_of(run.program.cells)) {
    if (is_implicit(run.program, cell)) continue;
    const std::span<const std::uint32_t> writers =
        run.index.writers[cell.index()];
    for (std::size_t i = writers.size(); i-- > 1;) {
      if (run.index.reads_itself[writers[i]]) continue;
      const Pair pair{cell, writers[i - 1], writers[i]};
      const ExprId same = run.ts.exprs.equal(run.ts.rung_value[pair.earlier],
                                             run.ts.rung_value[pair.later]);
      run.ask(RuleRun::Want::Witness, {same},
              [pair, count = writers.size()](
                  RuleRun& later, std::span<const RuleRun::Evidence> answers) {
                judge(later, pair, count, answers);
              });
      break;  // the last such pair says it all
    }
  }
}

}  // namespace

constinit const Rule double_coil = {
    "RP101", "double-coil", Severity::Warning, Decision::Solver, kDoc, check};

}  // namespace rung
