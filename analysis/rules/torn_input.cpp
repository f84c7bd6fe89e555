#include <map>
#include <unordered_map>
#include <utility>
#include <vector>

#include "analysis/rules/substitute.h"
#include "analysis/rules/support.h"

namespace rung {
namespace {

constexpr std::string_view kDoc = R"md(
## Finds
An input that a plcLib sketch reads more than once in a scan, where the samples
may differ and the scan then ends as it would with neither value. The solver
shows such a scan.

## Why it matters
There is no input image: the button may be pressed between two reads. One rung
sees it pressed and the next does not, and two outputs that exclude each other
are on together.

## Example
Bad:

    #include <plcLib.h>
    void setup() { setupPLC(); }
    void loop() {
      in(X0);
      out(Y0);
      inNot(X0);
      out(Y1);
    }

Good:

    #include <plcLib.h>
    unsigned int start = 0;
    void setup() { setupPLC(); }
    void loop() {
      start = in(X0);
      in(start);
      out(Y0);
      inNot(start);
      out(Y1);
    }

## Limits
A note, of bits. With `--stable-inputs`, or a line `//@ inputs stable`, there is
one sample a scan.
)md";

/// The samples of one pin, the first one first.
using Samples = std::vector<CellId>;

std::vector<Samples> pins_of(const RuleRun& run) {
  std::map<std::uint32_t, Samples> by_pin;  // by the first sample
  for (const CellId id : ids_of(run.program.cells)) {
    const Cell& cell = run.program.cells[id];
    if (cell.role != CellRole::Input || cell.type != Type::Bit || !cell.made) {
      continue;
    }
    const std::size_t dot = cell.name.rfind('.');
    if (dot == std::string::npos) continue;
    const CellId pin =
        run.index.find(std::string_view(cell.name).substr(0, dot));
    if (!pin.has_value() || run.program.cells[pin].role != CellRole::Input ||
        run.program.cells[pin].type != Type::Bit) {
      continue;
    }
    Samples& samples = by_pin[pin.index()];
    if (samples.empty()) samples.push_back(pin);
    samples.push_back(id);
  }
  std::vector<Samples> pins;
  pins.reserve(by_pin.size());
  for (auto& [pin, samples] : by_pin) pins.push_back(std::move(samples));
  return pins;
}

/// What the scan leaves, with all samples of the pin being `value`.
std::vector<ExprId> ends_with(RuleRun& run, const std::vector<ExprId>& ends,
                              const Samples& pin, bool value) {
  std::unordered_map<std::uint32_t, ExprId> replacement;
  for (const CellId sample : pin) {
    const Expr& expr = run.ts.exprs[run.ts.cell_end[sample.index()]];
    if (expr.op != ExprOp::Variable) continue;
    replacement.emplace(expr.var.index(), run.ts.exprs.bit(value));
  }
  return substitute(run.ts, ends, replacement);
}

ExprId differs(ExprArena& exprs, const std::vector<ExprId>& a,
               const std::vector<ExprId>& b) {
  std::vector<ExprId> parts;
  parts.reserve(a.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    parts.push_back(exprs.negation(exprs.equal(a[i], b[i])));
  }
  return exprs.disjunction(parts);
}

void ask(RuleRun& run, const std::vector<ExprId>& ends, const Samples& pin) {
  ExprArena& exprs = run.ts.exprs;
  const ExprId torn =
      exprs.conjunction(differs(exprs, ends, ends_with(run, ends, pin, false)),
                        differs(exprs, ends, ends_with(run, ends, pin, true)));
  run.ask(RuleRun::Want::Witness, {exprs.negation(torn)},
          [pin](RuleRun& now, std::span<const RuleRun::Evidence> answers) {
            if (answers[0].answer != RuleRun::Answer::No) return;
            const Program& program = now.program;
            now.report(
                program.cells[pin[1]].where,
                quoted(program, pin[0]) + " is read " +
                    counted(pin.size(), "time") +
                    " in a scan, and may change in between",
                {.labels = {{program.cells[pin[0]].where, "the first sample"}},
                 .help = "the scan ends as with neither value: " +
                         witness_text(now, answers[0])});
          });
}

void check(RuleRun& run) {
  if (!run.has_oracle) return;
  constexpr std::size_t kMostPins = 16;  // each copies the system's terms
  std::vector<Samples> pins = pins_of(run);
  if (pins.empty()) return;
  if (pins.size() > kMostPins) pins.resize(kMostPins);
  std::vector<ExprId> ends;
  for (const CellId id : ids_of(run.program.cells)) {
    const Cell& cell = run.program.cells[id];
    const bool named = cell.role != CellRole::Input && !cell.made;
    if (named) ends.push_back(run.ts.cell_end[id.index()]);
  }
  for (const Samples& pin : pins) ask(run, ends, pin);
}

}  // namespace

constinit const Rule torn_input = {
    "RP606", "torn-input", Severity::Note, Decision::Solver, kDoc, check};

}  // namespace rung
