#include "analysis/rules/support.h"

namespace rung {
namespace {

constexpr std::string_view kDoc = R"md(
## Finds
Two rungs on one line of which the second reads what the first has written.

## Why it matters
A line reads as one rung, a coil with a contact behind it. Whoever reorders the
two, or takes them for parallel, changes the program.

## Example
Bad:

    Q0 = I0; Q1 = Q0 && I1;

Good:

    Q0 = I0;
    Q1 = Q0 && I1;

## Limits
Several independent rungs on a line are left alone.
)md";

/// Two statements of one instruction, or the status bit of the timer that the
/// same line calls: there is no other way to write that.
bool belong_together(const Program& program, const Rung& first,
                     const Rung& second) {
  return first.where == second.where ||
         program.nodes[first.root()].op == NodeOp::Call;
}

void check(RuleRun& run) {
  if (run.program.language == "plclib") return;  // statements, in their order
  std::uint32_t line = 0;
  const Rung* before = nullptr;
  for (const Rung& rung : run.program.rungs) {
    const std::uint32_t here = line_of(run, rung.target_where);
    const bool same_line = before != nullptr && here == line && here != 0 &&
                           !belong_together(run.program, *before, rung);
    for (std::uint32_t i = rung.begin; same_line && i < rung.end; ++i) {
      const Node& node = run.program.nodes[i];
      if (node.op != NodeOp::Read || node.cell != before->target ||
          node.cell == rung.target) {
        continue;
      }
      run.report(node.where,
                 quoted(run.program, node.cell) +
                     " is read on the line that writes it",
                 {.labels = {{before->target_where, "written here"}}});
      break;
    }
    line = here;
    before = &rung;
  }
}

}  // namespace

constinit const Rule coil_then_contact = {"RP602",        "coil-then-contact",
                                          Severity::Note, Decision::Syntax,
                                          kDoc,           check};

}  // namespace rung
