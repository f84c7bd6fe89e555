#include <vector>

#include "analysis/rules/wiring.h"

namespace rung {
namespace {

constexpr std::string_view kDoc = R"md(
## Finds
An output that a declared trip (`//@ input I1 trip`) switches off and that comes
back by itself when the trip clears: no other input has changed, and nobody
presses a start or a reset. The solver shows such a run.

## Why it matters
An overload relay that cools down, or an emergency stop that is unlocked, must
not start a machine. Somebody may be working in it.

## Example
Bad:

    //@ input I2 trip
    M0 = (I0 || M0) && !I1;
    Q0 = M0 && !I2;

Good:

    //@ input I2 trip
    Q0 = (I0 || Q0) && !I1 && !I2;

## Limits
Only inputs that are declared `trip`. A button is an input that sets a latch, or
is declared `reset`; in the run that is shown none is pressed. Outputs that only
follow the trip, as the lamp of a healthy supply, are left out.
)md";

/// By cell: an input that sets a latch, or is declared to be a reset.
std::vector<bool> find_buttons(const RuleRun& run) {
  std::vector<bool> buttons(run.program.cells.size());
  for (const Latch& latch : run.latches) {
    for (const std::uint32_t set : latch.sets) {
      for (std::uint32_t i = run.index.first[set]; i <= set; ++i) {
        const Node& node = run.program.nodes[i];
        if (node.op == NodeOp::Read) buttons[node.cell.index()] = true;
      }
    }
  }
  for (const Wiring& wiring : run.properties.wirings) {
    buttons[wiring.cell.index()] = wiring.reset;
  }
  return buttons;
}

/// Outputs that depend on the trip, through any number of rungs.
std::vector<CellId> outputs_of(const RuleRun& run, CellId trip) {
  std::vector<bool> seen(run.program.cells.size());
  std::vector<CellId> open = {trip};
  std::vector<CellId> outputs;
  seen[trip.index()] = true;
  while (!open.empty()) {
    const CellId cell = open.back();
    open.pop_back();
    for (const std::uint32_t node : run.index.reads[cell.index()]) {
      const RungId rung(run.index.rung_of[node]);
      const CellId target = run.program.rungs[rung].target;
      if (seen[target.index()]) continue;
      seen[target.index()] = true;
      open.push_back(target);
      const Cell& it = run.program.cells[target];
      if (it.role == CellRole::Output && it.type == Type::Bit) {
        outputs.push_back(target);
      }
    }
  }
  return outputs;
}

/// In this scan and in the two before it the inputs are alike, but the trip,
/// and no button is pressed. No value: the output has no other input.
ExprId others_rest(RuleRun& run, CellId output, const Wiring& trip,
                   const std::vector<bool>& buttons) {
  ExprArena& exprs = run.ts.exprs;
  const std::vector<bool> cone =
      cone_of_influence(run.ts, {run.ts.cell_end[output.index()]});
  std::vector<ExprId> rest;
  const auto variables = static_cast<std::uint32_t>(cone.size());
  for (std::uint32_t i = 0; i < variables; ++i) {
    const Variable var = run.ts.vars[VarId(i)];
    if (!cone[i] || var.role != VarRole::Input || var.cell == trip.cell) {
      continue;
    }
    const ExprId before = run.past.previous(var.expr);
    rest.push_back(exprs.equal(var.expr, before));
    rest.push_back(exprs.equal(before, run.past.previous(before)));
    if (var.type == Type::Bit && buttons[var.cell.index()]) {
      rest.push_back(exprs.negation(var.expr));
    }
  }
  return rest.empty() ? ExprId() : exprs.conjunction(rest);
}

void ask(RuleRun& run, CellId output, const Wiring& trip,
         const std::vector<bool>& buttons) {
  ExprArena& exprs = run.ts.exprs;
  const ExprId rest = others_rest(run, output, trip, buttons);
  if (!rest.has_value()) return;
  const ExprId on = run.ts.cell_end[output.index()];
  const ExprId on_before = run.past.previous(on);
  const ExprId active = is_active(run, trip);
  const ExprId was_active = run.past.previous(active);
  const ExprId stops = exprs.conjunction(
      {was_active, exprs.negation(run.past.previous(was_active)),
       exprs.negation(on_before), run.past.previous(on_before)});
  const ExprId restarts =
      exprs.conjunction({rest, stops, exprs.negation(active), on});
  run.ask(
      RuleRun::Want::Witness, {exprs.negation(restarts)},
      [output, trip](RuleRun& now, std::span<const RuleRun::Evidence> answers) {
        if (answers[0].answer != RuleRun::Answer::No) return;
        const RungId rung(now.index.writers[output.index()].back());
        now.report(now.program.rungs[rung].where,
                   quoted(now.program, output) +
                       " starts again by itself when " +
                       device(now.program, trip) + " clears",
                   {.labels = {{trip.where, "declared here"}},
                    .help = witness_text(now, answers[0])});
      });
}

void check(RuleRun& run) {
  if (!run.has_oracle) return;
  constexpr std::size_t kMostQuestions = 32;  // each looks at a whole cone
  std::size_t asked = 0;
  const std::vector<bool> buttons = find_buttons(run);
  for (const Wiring& wiring : run.properties.wirings) {
    if (!wiring.trip) continue;
    for (const CellId output : outputs_of(run, wiring.cell)) {
      if (asked++ == kMostQuestions) return;
      ask(run, output, wiring, buttons);
    }
  }
}

}  // namespace

constinit const Rule automatic_restart = {
    "RP409", "automatic-restart", Severity::Warning, Decision::Solver, kDoc,
    check,   Pack::Safety};

}  // namespace rung
