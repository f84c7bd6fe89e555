#include "analysis/rules/support.h"

namespace rung {
namespace {

constexpr std::string_view kDoc = R"md(
## Finds
A comparison that has the same result in every reachable state. Decided by the
ranges of the words, else by the solver.

## Why it matters
The limit lies outside what the sensor can give, or what the program computes:
the branch never opens, or never closes.

## Example
Bad:

    //@ input IW0 in 0..100
    Q0 = IW0 > 150;

Good:

    //@ input IW0 in 0..100
    Q0 = IW0 > 80;

## Limits
An input without a declared range has that of its type: 0 to 1023 for an analog
pin of the yun dialect, 16 bits elsewhere.
)md";

void check(RuleRun& run) {
  for (std::uint32_t i = 0; i < run.program.nodes.size(); ++i) {
    if (!is_comparison(run.program.nodes[i].op) || is_generated(run, i)) {
      continue;
    }
    const ExprId value = run.ts.node_value[i];
    run.ask(RuleRun::Want::Proof, {value, run.ts.exprs.negation(value)},
            [i](RuleRun& now, std::span<const RuleRun::Evidence> answers) {
              const bool always = answers[0].answer == RuleRun::Answer::Yes;
              const bool never = answers[1].answer == RuleRun::Answer::Yes;
              if (!always && !never) return;
              const Node& node = now.program.nodes[i];
              now.report(node.where,
                         "this comparison is always " +
                             std::string(always ? "true" : "false"),
                         {.help = proof_text(answers[always ? 0 : 1])});
            });
  }
}

}  // namespace

constinit const Rule constant_comparison = {
    "RP307", "constant-comparison", Severity::Warning, Decision::Solver, kDoc,
    check};

}  // namespace rung
