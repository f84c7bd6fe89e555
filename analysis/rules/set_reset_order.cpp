#include <vector>

#include "analysis/rules/support.h"

namespace rung {
namespace {

constexpr std::string_view kDoc = R"md(
## Finds
A cell that one rung sets (`Q0 = Q0 || I0`) and another one resets
(`Q0 = Q0 && !I1`), where both can act in one scan: then their order decides.
The solver shows such a scan.

## Why it matters
The rung further down wins. Moving a rung changes which of the two that is.

## Example
Bad:

    Q0 = Q0 && !I1;
    Q0 = Q0 || I0;

Good:

    Q0 = (Q0 || I0) && !I1;

## Limits
A note: an order in which the reset stands last is a usual and safe way to
write a latch.
)md";

struct Orders {
  const Latch* set = nullptr;
  const Latch* reset = nullptr;
};

void ask(RuleRun& run, const Latch& set, const Latch& reset) {
  ExprArena& exprs = run.ts.exprs;
  std::vector<ExprId> sets;
  std::vector<ExprId> breaks;
  for (const std::uint32_t node : set.sets) {
    sets.push_back(run.ts.node_value[node]);
  }
  for (const std::uint32_t node : reset.breaks) {
    breaks.push_back(exprs.negation(run.ts.node_value[node]));
  }
  const ExprId both =
      exprs.conjunction(exprs.disjunction(sets), exprs.disjunction(breaks));
  const bool reset_wins = reset.rung > set.rung;
  run.ask(RuleRun::Want::Witness, {exprs.negation(both)},
          [cell = set.cell, first = reset_wins ? set.rung : reset.rung,
           last = reset_wins ? reset.rung : set.rung, reset_wins](
              RuleRun& now, std::span<const RuleRun::Evidence> answers) {
            if (answers[0].answer != RuleRun::Answer::No) return;
            now.report(now.program.rungs[last].where,
                       quoted(now.program, cell) +
                           " can be set and reset in one scan: this " +
                           (reset_wins ? "reset" : "set") + " wins",
                       {.labels = {{now.program.rungs[first].where,
                                    reset_wins ? "set here" : "reset here"}},
                        .help = witness_text(now, answers[0])});
          });
}

void check(RuleRun& run) {
  std::vector<Orders> orders(run.program.cells.size());
  for (const Latch& latch : run.latches) {
    Orders& order = orders[latch.cell.index()];
    if (only_resets(latch)) order.reset = &latch;
    if (latch.breaks.empty() && !latch.sets.empty()) order.set = &latch;
  }
  for (const Orders& order : orders) {
    if (order.set == nullptr || order.reset == nullptr) continue;
    ask(run, *order.set, *order.reset);
  }
}

}  // namespace

constinit const Rule set_reset_order = {
    "RP404", "set-reset-order", Severity::Note, Decision::Solver, kDoc, check};

}  // namespace rung
