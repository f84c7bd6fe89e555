#include "analysis/rules/latch.h"

#include <utility>

#include "analysis/rules/jumped_over.h"

namespace rung {
namespace {

/// Walks from the read up to the root. No value (`cell` unset) when something
/// other than And and Or is on the way.
Latch latch_at(const Program& program, const ProgramIndex& index, RungId rung,
               std::uint32_t read) {
  const std::vector<Node>& nodes = program.nodes;
  Latch latch{rung, program.rungs[rung].target, read, {}, {}, {}};
  std::uint32_t node = read;
  for (std::uint32_t up = index.parent[node]; up != ProgramIndex::kNone;
       node = up, up = index.parent[node]) {
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

constexpr std::size_t kMostReads = 8;

}  // namespace

CellId guard_of(const Program& program, const Rung& rung) {
  const auto at = [&](std::uint32_t node) { return program.nodes[node]; };
  const Node root = at(rung.root());
  const bool word = root.op == NodeOp::Add;
  if (!word && root.op != NodeOp::Or) return {};
  const Node kept = at(root.b);
  if (kept.op != (word ? NodeOp::Multiply : NodeOp::And)) return {};
  Node condition = at(kept.a);
  if (word && condition.op == NodeOp::ToWord) condition = at(condition.a);
  if (condition.op != NodeOp::Not) return {};
  const Node read = at(condition.a);
  const bool made = read.op == NodeOp::Read && program.cells[read.cell].made;
  return made ? read.cell : CellId();
}

bool is_jumped_over(const Program& program, const Rung& rung) {
  return guard_of(program, rung).has_value();
}

std::vector<Latch> find_latches(const Program& program,
                                const ProgramIndex& index) {
  std::vector<Latch> latches;
  for (const RungId id : ids_of(program.rungs)) {
    if (!index.reads_itself[id.index()]) continue;
    const Rung& rung = program.rungs[id];
    if (program.cells[rung.target].type != Type::Bit) continue;
    if (is_jumped_over(program, rung)) continue;
    Latch best;
    std::size_t tried = 0;
    for (std::uint32_t i = rung.begin; i < rung.end; ++i) {
      const Node& node = program.nodes[i];
      if (node.op != NodeOp::Read || node.cell != rung.target) continue;
      Latch latch = latch_at(program, index, id, i);
      if (!latch.cell.has_value()) continue;
      if (!best.cell.has_value() || latch.breaks.size() < best.breaks.size()) {
        best = std::move(latch);
      }
      // A walk up is as long as the rung is deep: linear for a few of them.
      if (++tried == kMostReads) break;
    }
    if (best.cell.has_value()) latches.push_back(std::move(best));
  }
  return latches;
}

bool only_resets(const Latch& latch) { return latch.sets.empty(); }

}  // namespace rung
