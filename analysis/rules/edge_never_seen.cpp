#include "analysis/rules/never_true.h"
#include "analysis/rules/support.h"

namespace rung {
namespace {

constexpr std::string_view kDoc = R"md(
## Finds
An edge (R_TRIG, F_TRIG, and what other languages call so) that is true in no
scan of any run. Decided by the solver over all reachable states.

## Why it matters
Its signal never changes in the direction that is waited for, or the block is
not called while it does.

## Example
Bad:

    PROGRAM main
    VAR_INPUT a : BOOL; b : BOOL; END_VAR
    VAR_OUTPUT q : BOOL; END_VAR
    VAR edge : R_TRIG; END_VAR
    q := a AND b;
    edge(CLK := a AND b AND NOT q);
    q := q OR edge.Q;
    END_PROGRAM

Good:

    PROGRAM main
    VAR_INPUT a : BOOL; b : BOOL; END_VAR
    VAR_OUTPUT q : BOOL; END_VAR
    VAR edge : R_TRIG; END_VAR
    edge(CLK := a AND NOT b);
    q := a AND b OR edge.Q;
    END_PROGRAM

## Limits
An edge that is never executed is told by `unreachable-element` or
`unreachable-rung`; one written by hand by `early-edge-memory`.
)md";

void check(RuleRun& run) {
  ask_never_true(run, ElementFamily::Edge,
                 [](RuleRun& now, const NeverTrue& found) {
                   const ElementCall& call = now.program.calls[found.call];
                   now.report(call.where,
                              found.name + " never sees an edge" + found.reason,
                              {.help = found.proof});
                 });
}

}  // namespace

constinit const Rule edge_never_seen = {
    "RP318", "edge-never-seen", Severity::Warning, Decision::Solver, kDoc,
    check};

}  // namespace rung
