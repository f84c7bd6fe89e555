#include "analysis/rules/support.h"

namespace rung {
namespace {

constexpr std::string_view kDoc = R"md(
## Finds
An output that a timer drives and that the solver proves never to be on for two
scans in a row: the timer switches itself off as soon as it is done.

## Why it matters
What hangs on the output sees a pulse of some milliseconds, or none at all. A
timer that restarts itself makes a clock pulse for a counter, not a light.

## Example
Bad:

    Q0 = T(0, 1, I0 && !Q0);

Good:

    M0 = T(0, 1, I0 && !M1);
    M1 = T(1, 1, M0);
    Q0 = M0;

## Limits
Outputs whose rung has the timer in it, or copies a cell whose rung is a timer,
where that timer depends on its own result. Memory cells are left out: there a
pulse is what one wants.
)md";

bool has_timer(const RuleRun& run, RungId rung) {
  const Rung& it = run.program.rungs[rung];
  for (std::uint32_t i = it.begin; i < it.end; ++i) {
    const Node& node = run.program.nodes[i];
    if (node.op != NodeOp::Call) continue;
    const ElementCall& call = run.program.calls[node.call];
    if (call.operation->steps() &&
        run.program.instances[call.instance].kind->family ==
            ElementFamily::Timer) {
      return true;
    }
  }
  return false;
}

/// The cell whose rung has the timer: the output, or what it copies.
CellId timed_cell(const RuleRun& run, CellId output) {
  CellId cell = output;
  for (int step = 0; step < 2; ++step) {
    const std::span<const std::uint32_t> writers =
        run.index.writers[cell.index()];
    if (writers.size() != 1) return {};
    const RungId rung(writers[0]);
    if (has_timer(run, rung)) {
      return run.index.in_loop[cell.index()] ? cell : CellId();
    }
    const Node& root = run.program.nodes[run.program.rungs[rung].root()];
    if (root.op != NodeOp::Read) return {};
    cell = root.cell;
  }
  return {};
}

void check(RuleRun& run) {
  ExprArena& exprs = run.ts.exprs;
  for (const CellId id : ids_of(run.program.cells)) {
    const Cell& cell = run.program.cells[id];
    if (cell.role != CellRole::Output || cell.type != Type::Bit ||
        !timed_cell(run, id).has_value()) {
      continue;
    }
    const ExprId on = run.ts.cell_end[id.index()];
    const ExprId stays = exprs.conjunction(on, run.ts.cell_begin[id.index()]);
    run.ask(RuleRun::Want::Proof, {exprs.negation(stays), exprs.negation(on)},
            [id](RuleRun& now, std::span<const RuleRun::Evidence> answers) {
              if (answers[0].answer != RuleRun::Answer::Yes ||
                  answers[1].answer != RuleRun::Answer::No) {
                return;
              }
              const RungId rung(now.index.writers[id.index()].back());
              now.report(now.program.rungs[rung].where,
                         quoted(now.program, id) +
                             " is never on for more than one scan: its timer "
                             "switches itself off",
                         {.help = proof_text(answers[0])});
            });
  }
}

}  // namespace

constinit const Rule one_scan_pulse = {
    "RP508", "one-scan-pulse", Severity::Warning, Decision::Solver, kDoc,
    check};

}  // namespace rung
