#include <vector>

#include "analysis/rules/support.h"

namespace rung {
namespace {

constexpr std::string_view kDoc = R"md(
## Finds
A latch whose start goes around its stop (`Q0 = I0 || Q0 && !I1`): with both
buttons pressed it is on. The solver shows a scan in which that happens.

## Why it matters
A start button that sticks, or is held, keeps the machine running whatever the
stop does: for a motor, stop has to win. It is often only a missing pair of
parentheses.

## Example
Bad:

    Q0 = I0 || Q0 && !I1;

Good:

    Q0 = (I0 || Q0) && !I1;

## Limits
A note: for the memory of an alarm it is right that setting wins. Nothing is
reported when start and stop can never be active together, when the start branch
reads the cell itself (a toggle), or when a property line of the cell says
`dominant set`.
)md";

/// By cell: a line `//@ latch Q ... dominant set` says that it is meant so.
std::vector<bool> meant_cells(const RuleRun& run) {
  std::vector<bool> meant(run.program.cells.size());
  for (const Property& property : run.properties.properties) {
    if (property.form != Property::Form::Latch || !property.dominant_set ||
        property.formulas.empty()) {
      continue;
    }
    const CellId cell = run.index.find(property.formulas[0]);
    if (cell.has_value()) meant[cell.index()] = true;
  }
  return meant;
}

/// `Q && !P || !Q && P`: a toggle has no start and no stop.
bool reads_target(const RuleRun& run, const Latch& latch, std::size_t set) {
  const std::uint32_t node = latch.sets[set];
  for (std::uint32_t i = run.index.first[node]; i <= node; ++i) {
    const Node& part = run.program.nodes[i];
    if (part.op == NodeOp::Read && part.cell == latch.cell) return true;
  }
  return false;
}

void ask(RuleRun& run, const Latch& latch, std::size_t set) {
  ExprArena& exprs = run.ts.exprs;
  std::vector<ExprId> broken;
  for (std::size_t i = 0; i < latch.bypassed[set]; ++i) {
    broken.push_back(exprs.negation(run.ts.node_value[latch.breaks[i]]));
  }
  const ExprId start = run.ts.node_value[latch.sets[set]];
  const ExprId both = exprs.conjunction(start, exprs.disjunction(broken));
  const ExprId on = run.ts.rung_value[latch.rung.index()];
  run.ask(
      RuleRun::Want::Witness, {exprs.negation(exprs.conjunction(both, on))},
      [latch, set](RuleRun& now, std::span<const RuleRun::Evidence> answers) {
        if (answers[0].answer != RuleRun::Answer::No) return;
        const SourceRange place = now.program.nodes[latch.sets[set]].where;
        const SourceRange stop = now.program.nodes[latch.breaks[0]].where;
        now.report(place,
                   quoted(text_of(now, place)) + " sets " +
                       quoted(now.program, latch.cell) + " even when " +
                       quoted(text_of(now, stop)) + " breaks it",
                   {.labels = {{stop, "this stop does not win"}},
                    .help = witness_text(now, answers[0])});
      });
}

void check(RuleRun& run) {
  const std::vector<bool> meant = meant_cells(run);
  for (const Latch& latch : run.latches) {
    if (meant[latch.cell.index()]) continue;
    for (std::size_t set = 0; set < latch.sets.size(); ++set) {
      if (latch.bypassed[set] == 0 || reads_target(run, latch, set)) continue;
      ask(run, latch, set);
      break;
    }
  }
}

}  // namespace

constinit const Rule start_dominant_latch = {
    "RP402", "start-dominant-latch", Severity::Note, Decision::Solver, kDoc,
    check};

}  // namespace rung
