#include <utility>

#include "analysis/rules/clash.h"
#include "analysis/rules/jumped_over.h"
#include "analysis/rules/support.h"

namespace rung {
namespace {

constexpr std::string_view kDoc = R"md(
## Finds
Contacts in series that exclude each other: a cell and its inverse, two ranges
of one word that do not meet, or, decided by the solver, a series inside a rung
that no reachable state makes true. Also a cell and its inverse in parallel,
which is always true.

## Why it matters
The branch never conducts. One of the contacts was to be another cell.

## Example
Bad:

    Q0 = I0 && !I0 || I1;
    Q1 = IW0 < 20 && IW0 > 50;

Good:

    Q0 = I0 && !I2 || I1;
    Q1 = IW0 < 20 || IW0 > 50;

## Limits
A whole rung that the solver proves to be never true is told by
`coil-never-true`.
)md";

/// Asks about the series at `node`, which is a part of a rung.
void ask_series(RuleRun& run, std::uint32_t node) {
  const RungId rung(run.index.rung_of[node]);
  const CellId target = run.program.rungs[rung].target;
  if (run.program.cells[target].type != Type::Bit) return;
  const ExprId whole = run.ts.rung_value[rung.index()];
  std::vector<ExprId> claims = {run.ts.exprs.negation(run.ts.node_value[node]),
                                run.ts.exprs.negation(whole)};
  for (const std::uint32_t part : operands(run.program, node, NodeOp::And)) {
    claims.push_back(run.ts.exprs.negation(run.ts.node_value[part]));
  }
  run.ask(
      RuleRun::Want::Proof, std::move(claims),
      [node, rung](RuleRun& now, std::span<const RuleRun::Evidence> answers) {
        if (answers[0].answer != RuleRun::Answer::Yes ||
            answers[1].answer == RuleRun::Answer::Yes || now.explained(rung)) {
          return;
        }
        for (const RuleRun::Evidence& part : answers.subspan(2)) {
          // A part that is never true is the reason, and has its own
          // finding.
          if (part.answer != RuleRun::Answer::No) return;
        }
        now.report(now.program.nodes[node].where,
                   "these contacts in series are never true together",
                   {.help = proof_text(answers[0])});
      });
}

void check(RuleRun& run) {
  for (std::uint32_t i = 0; i < run.program.nodes.size(); ++i) {
    const NodeOp op = run.program.nodes[i].op;
    if (!is_and_or(op)) continue;
    const std::uint32_t parent = run.index.parent[i];
    const bool is_root = parent == ProgramIndex::kNone;
    if (!is_root && run.program.nodes[parent].op == op) continue;
    const RungId rung(run.index.rung_of[i]);
    if (is_jumped_over(run.program, run.program.rungs[rung])) continue;
    const Clash clash = find_clash(run.program, i, op);
    if (clash.second != Clash::kNone) {
      run.explain(rung);
      run.report(run.program.nodes[clash.second].where,
                 op == NodeOp::And
                     ? "this contact contradicts another one in series with it"
                     : "this branch and another one are always true together",
                 {.labels = {{run.program.nodes[clash.first].where,
                              "the other one"}}});
    } else if (op == NodeOp::And && !is_root) {
      ask_series(run, i);
    }
  }
}

}  // namespace

constinit const Rule contradictory_contacts = {"RP308",
                                               "contradictory-contacts",
                                               Severity::Warning,
                                               Decision::Solver,
                                               kDoc,
                                               check};

}  // namespace rung
