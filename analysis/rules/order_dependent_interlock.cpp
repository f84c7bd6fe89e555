#include <algorithm>
#include <vector>

#include "analysis/rules/interlock.h"
#include "analysis/rules/support.h"

namespace rung {
namespace {

constexpr std::string_view kDoc = R"md(
## Finds
Two outputs that are never on together at the end of a scan only because of the
order of their rungs: with the lower rung directly above the other one, the
solver shows a scan that ends with both. They are two latches of which one is
interlocked against the other, or a line says `//@ interlock` of them.

## Why it matters
Nobody sees in a rung that its place matters. Somebody sorts the rungs, or the
program goes to a tool that executes them in another order, and the interlock is
gone.

## Example
Bad:

    //@ interlock Q0, Q1
    Q0 = I0;
    Q1 = I1 && !Q0;

Good:

    //@ interlock Q0, Q1
    Q0 = I0 && !I1;
    Q1 = I1 && !I0;

## Limits
A note: in the order in which the rungs stand the interlock holds, which is
proved. Outputs with one rung each; of an `interlock` line, those that it names
plainly. `one-sided-interlock` tells where it does not hold.
)md";

struct Pair {
  CellId upper;  // its rung stands above, and does not read the other
  CellId lower;
};

/// The cell's only rung; no value when there is another number of them.
RungId only_rung(const RuleRun& run, CellId cell) {
  const std::span<const std::uint32_t> writers =
      run.index.writers[cell.index()];
  return writers.size() == 1 ? RungId(writers[0]) : RungId();
}

void ask(RuleRun& run, const Pair& pair) {
  const RungId upper = only_rung(run, pair.upper);
  const RungId lower = only_rung(run, pair.lower);
  if (!upper.has_value() || !lower.has_value() || lower < upper ||
      !reads(run, lower, pair.upper) || reads(run, upper, pair.lower)) {
    return;
  }
  ExprArena& exprs = run.ts.exprs;
  const ExprId upper_on = run.ts.cell_end[pair.upper.index()];
  const ExprId lower_on = run.ts.cell_end[pair.lower.index()];
  const ExprId earlier =
      value_with(run, lower, pair.upper, run.ts.cell_begin[pair.upper.index()]);
  if (!earlier.has_value()) return;
  run.ask(RuleRun::Want::Witness,
          {exprs.negation(exprs.conjunction(upper_on, lower_on)),
           exprs.negation(exprs.conjunction(upper_on, earlier))},
          [pair, upper, lower](RuleRun& now,
                               std::span<const RuleRun::Evidence> answers) {
            if (answers[0].answer != RuleRun::Answer::Yes ||
                answers[1].answer != RuleRun::Answer::No) {
              return;
            }
            const std::string name = quoted(now.program, pair.upper);
            now.report(
                now.program.rungs[lower].where,
                quoted(now.program, pair.lower) + " is interlocked against " +
                    name + " only by the order of the rungs",
                {.labels = {{now.program.rungs[upper].where,
                             "below this rung; above it both could be on"}},
                 .help = "above it: " + witness_text(now, answers[1])});
          });
}

/// The cells that an `interlock` line names.
std::vector<CellId> named(const RuleRun& run, const Property& property) {
  constexpr std::size_t kMost = 8;
  std::vector<CellId> cells;
  for (const std::string& formula : property.formulas) {
    const CellId cell = run.index.find(formula);
    if (!cell.has_value() || cells.size() == kMost) continue;
    if (run.program.cells[cell].type == Type::Bit) cells.push_back(cell);
  }
  return cells;
}

void check(RuleRun& run) {
  if (!run.has_oracle) return;
  const std::vector<OneSided> one_sided = one_sided_pairs(run);
  std::vector<Pair> pairs;
  pairs.reserve(one_sided.size());
  for (const OneSided& pair : one_sided) {
    pairs.push_back({pair.free->cell, pair.locked->cell});
  }
  for (const Property& property : run.properties.properties) {
    if (property.form != Property::Form::Interlock) continue;
    const std::vector<CellId> cells = named(run, property);
    for (const CellId a : cells) {
      for (const CellId b : cells) {
        const auto is_pair = [&](const Pair& pair) {
          return pair.upper == a && pair.lower == b;
        };
        if (a != b && std::none_of(pairs.begin(), pairs.end(), is_pair)) {
          pairs.push_back({a, b});
        }
      }
    }
  }
  for (const Pair& pair : pairs) ask(run, pair);
}

}  // namespace

constinit const Rule order_dependent_interlock = {
    "RP411",        "order-dependent-interlock",
    Severity::Note, Decision::Solver,
    kDoc,           check};

}  // namespace rung
