#include "analysis/rules/latch.h"

#include <utility>

namespace rung {
namespace {

/// Walks from the read up to the root. No value (`cell` unset) when something
/// other than And and Or is on the way.
Latch latch_at(const RuleRun& run, RungId rung, std::uint32_t read) {
  const std::vector<Node>& nodes = run.program.nodes;
  Latch latch{rung, run.program.rungs[rung].target, read, {}, {}, {}};
  std::uint32_t node = read;
  for (std::uint32_t up = run.index.parent[node]; up != ProgramIndex::kNone;
       node = up, up = run.index.parent[node]) {
    const Node& gate = nodes[up];
    const std::uint32_t other = gate.a == node ? gate.b : gate.a;
    if (gate.op == NodeOp::And) {
      latch.breaks.push_back(other);
    } else if (gate.op == NodeOp::Or) {
      latch.sets.push_back(other);
      latch.bypassed.push_back(latch.breaks.size());
    } else {
      return {};
    }
  }
  return latch;
}

}  // namespace

std::vector<Latch> find_latches(const RuleRun& run) {
  std::vector<Latch> latches;
  for (const RungId id : ids_of(run.program.rungs)) {
    if (!run.index.reads_itself[id.index()]) continue;
    const Rung& rung = run.program.rungs[id];
    if (run.program.cells[rung.target].type != Type::Bit) continue;
    Latch best;
    for (std::uint32_t i = rung.begin; i < rung.end; ++i) {
      const Node& node = run.program.nodes[i];
      if (node.op != NodeOp::Read || node.cell != rung.target) continue;
      Latch latch = latch_at(run, id, i);
      if (!latch.cell.has_value()) continue;
      if (!best.cell.has_value() ||
          latch.breaks.size() < best.breaks.size()) {
        best = std::move(latch);
      }
      // One walk up is as long as the rung is deep: a few reads tell enough.
      if (i - rung.begin > 1000) break;
    }
    if (best.cell.has_value()) latches.push_back(std::move(best));
  }
  return latches;
}

bool only_resets(const Latch& latch) { return latch.sets.empty(); }

}  // namespace rung
