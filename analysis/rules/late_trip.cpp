#include <vector>

#include "analysis/rules/wiring.h"

namespace rung {
namespace {

constexpr std::string_view kDoc = R"md(
## Finds
An output that a declared trip or normally closed stop (`//@ input I1 nc`)
reaches only through a rung that stands below its reader: it acts one scan late.

## Why it matters
On the path of a stop every scan counts, and the delay grows with each rung that
is in the wrong place. Nobody sees it in a test by hand.

## Example
Bad:

    //@ input I1 nc trip
    Q0 = I0 && M0;
    M0 = I1;

Good:

    //@ input I1 nc trip
    M0 = I1;
    Q0 = I0 && M0;

## Limits
Only inputs that are declared, and outputs that no path reaches in the same
scan. Whether the path matters is not asked: a lamp is told, too.
)md";

/// What the input reaches within a scan, then what it reaches later.
class Reach {
 public:
  Reach(const RuleRun& run, CellId from)
      : run_(run), reached_(run.program.cells.size()) {
    add(from);
    spread();
  }

  /// The first read on the way to each output that is reached late only.
  std::vector<std::uint32_t> late_reads() {
    std::vector<std::uint32_t> found;
    const std::vector<std::uint32_t> late = late_;
    for (const std::uint32_t node : late) {
      const CellId target = target_of(node);
      if (reached_[target.index()]) continue;
      outputs_ = 0;
      add(target);
      spread();
      if (outputs_ > 0) found.push_back(node);
    }
    return found;
  }

 private:
  CellId target_of(std::uint32_t node) const {
    return run_.program.rungs[RungId(run_.index.rung_of[node])].target;
  }

  void add(CellId cell) {
    reached_[cell.index()] = true;
    open_.push_back(cell);
    if (run_.program.cells[cell].role == CellRole::Output) ++outputs_;
  }

  void spread() {
    while (!open_.empty()) {
      const CellId cell = open_.back();
      open_.pop_back();
      for (const std::uint32_t node : run_.index.reads[cell.index()]) {
        if (is_late(cell, node)) {
          late_.push_back(node);
        } else if (!reached_[target_of(node).index()]) {
          add(target_of(node));
        }
      }
    }
  }

  /// Nothing above the reader has written the cell in this scan.
  bool is_late(CellId cell, std::uint32_t node) const {
    return !run_.index.writers[cell.index()].empty() &&
           writer_above(run_, cell, run_.index.rung_of[node]) ==
               ProgramIndex::kNone;
  }

  const RuleRun& run_;
  std::vector<bool> reached_;  // by cell
  std::vector<CellId> open_;
  std::vector<std::uint32_t> late_;  // nodes that read what is not yet written
  std::size_t outputs_ = 0;
};

void check(RuleRun& run) {
  constexpr std::size_t kMostInputs = 64;  // each walks over the program
  std::size_t inputs = 0;
  std::vector<bool> told(run.program.nodes.size());
  for (const Wiring& wiring : run.properties.wirings) {
    if (wiring.reset || inputs++ == kMostInputs) continue;
    for (const std::uint32_t node : Reach(run, wiring.cell).late_reads()) {
      if (told[node]) continue;
      told[node] = true;
      const Node& it = run.program.nodes[node];
      const std::uint32_t below = run.index.writers[it.cell.index()].front();
      run.report(it.where,
                 device(run.program, wiring) + " acts one scan late here: " +
                     quoted(run.program, it.cell) + " is written further down",
                 {.labels = {{run.program.rungs[RungId(below)].where,
                              "written here"}}});
    }
  }
}

}  // namespace

constinit const Rule late_trip = {
    "RP604", "late-trip", Severity::Warning, Decision::Syntax,
    kDoc,    check,       Pack::Safety};

}  // namespace rung
