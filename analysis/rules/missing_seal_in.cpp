#include <algorithm>
#include <vector>

#include "analysis/rules/support.h"

namespace rung {
namespace {

constexpr std::string_view kDoc = R"md(
## Finds
An output that an input starts and that the stop of another latch breaks, but
that does not hold itself.

## Why it matters
With push buttons the device runs only while the button is held. The seal-in
contact is missing, or names another output.

## Example
Bad:

    Q0 = (Q0 || I0) && !I2;
    Q1 = (Q0 || I1) && !I2;

Good:

    Q0 = (Q0 || I0) && !I2;
    Q1 = (Q1 || I1) && !I2;

## Limits
Inching by a button is written the same way; so the finding is a note. Only
rungs of the form `(X || start) && !stop ...`, where X is another output that
latches with the same stop, are found.
)md";

/// The inverted inputs in series at the outside of a rung.
std::vector<std::uint32_t> stops_of(const RuleRun& run, const Rung& rung) {
  std::vector<std::uint32_t> stops;
  if (run.program.nodes[rung.root()].op != NodeOp::And) return stops;
  for (const std::uint32_t node :
       operands(run.program, rung.root(), NodeOp::And)) {
    const Contact contact = contact_at(run.program, node);
    if (contact.cell.has_value() && contact.inverted &&
        run.program.cells[contact.cell].role == CellRole::Input) {
      stops.push_back(contact.cell.index());
    }
  }
  return stops;
}

/// A rung is read again for each one that names it: short ones only, so that
/// the whole stays linear.
constexpr std::uint32_t kMostNodes = 256;

struct Seal {
  CellId other;  // the output that stands where the seal-in should
  bool start = false;
};

/// `other || input` in series with the rest.
Seal foreign_seal(const RuleRun& run, const Rung& rung) {
  for (const std::uint32_t group :
       operands(run.program, rung.root(), NodeOp::And)) {
    if (run.program.nodes[group].op != NodeOp::Or) continue;
    Seal seal;
    for (const std::uint32_t branch :
         operands(run.program, group, NodeOp::Or)) {
      const Contact contact = contact_at(run.program, branch);
      if (!contact.cell.has_value() || contact.inverted) continue;
      const CellRole role = run.program.cells[contact.cell].role;
      if (role == CellRole::Output) seal.other = contact.cell;
      if (role == CellRole::Input) seal.start = true;
    }
    if (seal.other.has_value() && seal.start) return seal;
  }
  return {};
}

void check(RuleRun& run) {
  std::vector<RungId> latch_of(run.program.cells.size());
  for (const Latch& latch : run.latches) {
    latch_of[latch.cell.index()] = latch.rung;
  }
  for (const RungId id : ids_of(run.program.rungs)) {
    const Rung& rung = run.program.rungs[id];
    if (run.index.reads_itself[id.index()] ||
        run.program.cells[rung.target].role != CellRole::Output) {
      continue;
    }
    const std::vector<std::uint32_t> stops = stops_of(run, rung);
    if (stops.empty()) continue;
    const Seal seal = foreign_seal(run, rung);
    if (!seal.other.has_value() || !latch_of[seal.other.index()].has_value()) {
      continue;
    }
    const Rung& other = run.program.rungs[latch_of[seal.other.index()]];
    if (other.end - other.begin > kMostNodes) continue;
    const std::vector<std::uint32_t> theirs = stops_of(run, other);
    const bool shared =
        std::any_of(stops.begin(), stops.end(), [&](std::uint32_t stop) {
          return std::find(theirs.begin(), theirs.end(), stop) != theirs.end();
        });
    if (!shared) continue;
    run.report(
        rung.where,
        quoted(run.program, rung.target) +
            " has a start and a stop but does not hold itself",
        {.labels = {{other.where, quoted(run.program, seal.other) +
                                      ", which this rung reads, does"}}});
  }
}

}  // namespace

constinit const Rule missing_seal_in = {
    "RP403", "missing-seal-in", Severity::Note, Decision::Syntax, kDoc, check};

}  // namespace rung
