#include "analysis/rules/support.h"

namespace rung {
namespace {

constexpr std::string_view kDoc = R"md(
## Finds
An output that, after an input has changed, takes another value for one scan and
then goes back, while all inputs are held: it reads a cell whose rung stands
below it. The solver shows such a run.

## Why it matters
The rungs do not agree for a scan: some see the new input already and some the
old one. A contactor may follow such a pulse, and a counter does.

## Example
Bad:

    Q0 = I0 && !M0;
    M0 = I0 && I1;

Good:

    M0 = I0 && I1;
    Q0 = I0 && !M0;

## Limits
A note. Only where the cell that is read too early depends on inputs alone. A
memory that is a plain copy makes an edge, and its pulse is meant.
)md";

/// Without elements and without memory: a function of what it reads.
bool is_plain(const RuleRun& run, RungId id) {
  const Rung& rung = run.program.rungs[id];
  if (run.index.in_loop[rung.target.index()]) return false;
  for (std::uint32_t i = rung.begin; i < rung.end; ++i) {
    if (run.program.nodes[i].op == NodeOp::Call) return false;
  }
  return true;
}

bool is_contact(const RuleRun& run, RungId id) {
  const Rung& rung = run.program.rungs[id];
  return contact_at(run.program, rung.root()).cell.has_value();
}

bool reads_inputs_only(const RuleRun& run, RungId id) {
  const Rung& rung = run.program.rungs[id];
  for (std::uint32_t i = rung.begin; i < rung.end; ++i) {
    const Node& node = run.program.nodes[i];
    if (node.op == NodeOp::Read &&
        run.program.cells[node.cell].role != CellRole::Input) {
      return false;
    }
  }
  return true;
}

/// The read of a cell that only a plain rung further down writes; kNone.
std::uint32_t early_read(const RuleRun& run, RungId id) {
  const Rung& rung = run.program.rungs[id];
  for (std::uint32_t i = rung.begin; i < rung.end; ++i) {
    const Node& node = run.program.nodes[i];
    if (node.op != NodeOp::Read) continue;
    const std::span<const std::uint32_t> writers =
        run.index.writers[node.cell.index()];
    if (writers.size() != 1 || writers[0] <= id.index()) continue;
    const RungId writer(writers[0]);
    if (is_plain(run, writer) && !is_contact(run, writer) &&
        reads_inputs_only(run, writer)) {
      return i;
    }
  }
  return ProgramIndex::kNone;
}

void ask(RuleRun& run, RungId id, std::uint32_t early) {
  ExprArena& exprs = run.ts.exprs;
  const CellId output = run.program.rungs[id].target;
  const ExprId now = run.ts.cell_end[output.index()];
  const ExprId before = run.past.previous(now);
  const ExprId pulse = exprs.conjunction(
      {exprs.exclusive_or(now, before),
       exprs.exclusive_or(before, run.past.previous(before)),
       run.past.inputs_rest(now),
       exprs.negation(run.past.previous(run.past.first_scan()))});
  run.ask(RuleRun::Want::Witness, {exprs.negation(pulse)},
          [id, early, output](RuleRun& later,
                              std::span<const RuleRun::Evidence> answers) {
            if (answers[0].answer != RuleRun::Answer::No) return;
            const Node& node = later.program.nodes[early];
            const RungId writer(later.index.writers[node.cell.index()][0]);
            later.report(later.program.rungs[id].where,
                         quoted(later.program, output) +
                             " can pulse for one scan when an input changes: " +
                             quoted(later.program, node.cell) +
                             " follows one scan later",
                         {.labels = {{later.program.rungs[writer].where,
                                      "written below its use"}},
                          .help = witness_text(later, answers[0])});
          });
}

void check(RuleRun& run) {
  if (!run.has_oracle) return;
  constexpr std::size_t kMostQuestions = 32;  // each looks at a whole cone
  std::size_t asked = 0;
  for (const RungId id : ids_of(run.program.rungs)) {
    const CellId target = run.program.rungs[id].target;
    const Cell& cell = run.program.cells[target];
    if (cell.role != CellRole::Output || cell.type != Type::Bit ||
        run.index.writers[target.index()].size() != 1 || !is_plain(run, id)) {
      continue;
    }
    const std::uint32_t early = early_read(run, id);
    if (early == ProgramIndex::kNone) continue;
    if (asked++ == kMostQuestions) return;
    ask(run, id, early);
  }
}

}  // namespace

constinit const Rule output_glitch = {
    "RP605", "output-glitch", Severity::Note, Decision::Solver, kDoc, check};

}  // namespace rung
