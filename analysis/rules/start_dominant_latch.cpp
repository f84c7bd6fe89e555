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
stop does. Stop has to win. It is often only a missing pair of parentheses.

## Example
Bad:

    Q0 = I0 || Q0 && !I1;

Good:

    Q0 = (I0 || Q0) && !I1;

## Limits
Nothing is reported when start and stop can never be active together, or when a
property line of the cell says `dominant set`.
)md";

/// Does `//@ latch Q ... dominant set` say that it is meant so?
bool is_meant(const RuleRun& run, CellId cell) {
  for (const Property& property : run.properties.properties) {
    if (property.form == Property::Form::Latch && property.dominant_set &&
        !property.formulas.empty() &&
        property.formulas[0] == run.program.cells[cell].name) {
      return true;
    }
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
  for (const Latch& latch : run.latches) {
    if (is_meant(run, latch.cell)) continue;
    for (std::size_t set = 0; set < latch.sets.size(); ++set) {
      if (latch.bypassed[set] == 0) continue;
      ask(run, latch, set);
      break;
    }
  }
}

}  // namespace

constinit const Rule start_dominant_latch = {
    "RP402", "start-dominant-latch", Severity::Warning, Decision::Solver, kDoc,
    check};

}  // namespace rung
