#include <cstdlib>

#include "analysis/rules/support.h"

namespace rung {
namespace {

constexpr std::string_view kDoc = R"md(
## Finds
Arithmetic whose result can leave its range: 16 bits on the controller of the
yun dialect, 32 bits for a cell of the sim dialect. The solver shows a scan in
which it does.

## Why it matters
The value wraps to the other sign, and comparisons with it turn around.

## Example
Bad:

    pin3 = A0 * 40 > 9000;

Good:

    pin3 = A0 > 225;

## Limits
Nothing is reported for sums that the ranges of the words keep small enough.
)md";

void check_wraps(RuleRun& run) {
  for (std::uint32_t i = 0; i < run.program.nodes.size(); ++i) {
    const Node& node = run.program.nodes[i];
    if (node.op != NodeOp::Wrap16 && node.op != NodeOp::Wrap) continue;
    const ExprId fits =
        run.ts.exprs.equal(run.ts.node_value[i], run.ts.node_value[node.a]);
    run.ask(RuleRun::Want::Witness, {fits},
            [i](RuleRun& now, std::span<const RuleRun::Evidence> answers) {
              if (answers[0].answer != RuleRun::Answer::No) return;
              const Node& wrap = now.program.nodes[i];
              const std::int64_t bits =
                  wrap.op == NodeOp::Wrap16 ? 16 : std::abs(wrap.value);
              now.report(wrap.where,
                         "the result can exceed " + std::to_string(bits) +
                             " bits and wraps",
                         {.help = witness_text(now, answers[0])});
            });
  }
}

void check_faults(RuleRun& run) {
  for (const Fault& fault : run.ts.faults) {
    run.ask(RuleRun::Want::Witness, {run.ts.exprs.negation(fault.condition)},
            [fault](RuleRun& now, std::span<const RuleRun::Evidence> answers) {
              if (answers[0].answer != RuleRun::Answer::No) return;
              now.report(fault.where, "the value can leave its range",
                         {.help = witness_text(now, answers[0])});
            });
  }
}

void check(RuleRun& run) {
  check_wraps(run);
  check_faults(run);
}

}  // namespace

constinit const Rule word_overflow = {
    "RP706", "word-overflow", Severity::Warning, Decision::Solver, kDoc, check};

}  // namespace rung
