#include <vector>

#include "analysis/rules/support.h"

namespace rung {
namespace {

constexpr std::string_view kDoc = R"md(
## Finds
A timer or counter in the right operand of `&&` or `||` of the sim dialect that
is not executed in some scan.

## Why it matters
JavaScript does not evaluate the right operand when the left one decides. Then
the timer keeps running on its old state and the counter misses edges; on a
controller, which evaluates both, the same text does something else.

## Example
Bad:

    Q0 = I0 && T(0, 5, I1);

Good:

    M0 = T(0, 5, I1);
    Q0 = I0 && M0;

## Limits
When the solver proves that the element runs in every scan there is no finding;
when it shows a scan in which it does not, that scan is told.
)md";

void ask(RuleRun& run, CallId id, std::uint32_t branch) {
  run.ask(
      RuleRun::Want::Witness, {run.ts.call_executed[id.index()]},
      [id, branch](RuleRun& now, std::span<const RuleRun::Evidence> answers) {
        if (answers[0].answer == RuleRun::Answer::Yes || now.explained(id)) {
          return;
        }
        const ElementCall& call = now.program.calls[id];
        const Node& marker = now.program.nodes[branch];
        now.report(
            call.where,
            quoted(now.program.instances[call.instance].name) +
                " is not executed in scans in which the operand before it is " +
                (marker.skip_when ? "true" : "false"),
            {.labels = {{now.program.nodes[marker.a].where,
                         "this decides whether it is executed"}},
             .help = answers[0].answer == RuleRun::Answer::No
                         ? witness_text(now, answers[0])
                         : "call it in a rung of its own"});
      });
}

void check(RuleRun& run) {
  if (run.program.language == "il-iec") return;  // jumps are written to skip
  const std::vector<Node>& nodes = run.program.nodes;
  std::uint32_t branch = 0;
  std::uint32_t end = 0;  // of the outermost operand that may be skipped
  for (std::uint32_t i = 0; i < nodes.size(); ++i) {
    if (nodes[i].op == NodeOp::Branch && i >= end) {
      branch = i;
      end = nodes[i].target;
    }
    if (nodes[i].op == NodeOp::Call && i < end) ask(run, nodes[i].call, branch);
  }
}

}  // namespace

constinit const Rule skipped_element = {
    "RP507", "skipped-element", Severity::Warning, Decision::Solver, kDoc,
    check};

}  // namespace rung
