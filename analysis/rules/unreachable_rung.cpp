#include <vector>

#include "analysis/rules/jumped_over.h"
#include "analysis/rules/support.h"

namespace rung {
namespace {

constexpr std::string_view kDoc = R"md(
## Finds
A statement that is executed in no scan of any run: it stands under a condition
that is never true, or behind a jump that is always taken. Decided by the solver
over all reachable states.

## Why it matters
It reads as if it did something. Often a condition was inverted, or a test was
left in.

## Example
Bad:

    PROGRAM main
    VAR_INPUT a : BOOL; END_VAR
    VAR_OUTPUT q : BOOL; r : BOOL; END_VAR
    q := a;
    IF a AND NOT q THEN r := TRUE; END_IF;
    END_PROGRAM

Good:

    PROGRAM main
    VAR_INPUT a : BOOL; b : BOOL; END_VAR
    VAR_OUTPUT q : BOOL; r : BOOL; END_VAR
    q := a;
    IF b AND NOT q THEN r := TRUE; ELSE r := FALSE; END_IF;
    END_PROGRAM

## Limits
Of the statements under one condition the first is told. A call that only an
`&&` or `||` skips is told by `unreachable-element`.
)md";

/// By cell: the first rung that it guards.
std::vector<RungId> first_guarded(const RuleRun& run) {
  std::vector<RungId> first(run.program.cells.size());
  for (const RungId id : ids_of(run.program.rungs)) {
    const Rung& rung = run.program.rungs[id];
    if (run.program.cells[rung.target].made) continue;
    const CellId guard = guard_of(run.program, rung);
    if (!guard.has_value() || first[guard.index()].has_value()) continue;
    if (run.index.writers[guard.index()].size() == 1) first[guard.index()] = id;
  }
  return first;
}

void check(RuleRun& run) {
  // There, one instruction is several statements of the reader.
  if (run.program.language == "ldmicro") return;
  const std::vector<RungId> first = first_guarded(run);
  for (const CellId guard : ids_of(run.program.cells)) {
    const RungId id = first[guard.index()];
    if (!id.has_value()) continue;
    run.ask(RuleRun::Want::Proof,
            {run.ts.exprs.negation(run.ts.cell_end[guard.index()])},
            [id](RuleRun& now, std::span<const RuleRun::Evidence> answers) {
              if (answers[0].answer != RuleRun::Answer::Yes) return;
              now.explain(id);
              const Rung& rung = now.program.rungs[id];
              now.report(rung.where,
                         "this statement, which assigns " +
                             quoted(now.program, rung.target) +
                             ", is never executed",
                         {.help = proof_text(answers[0])});
            });
  }
}

}  // namespace

constinit const Rule unreachable_rung = {
    "RP316", "unreachable-rung", Severity::Warning, Decision::Solver, kDoc,
    check};

}  // namespace rung
