#include "backend/unit/unused.h"

#include <algorithm>
#include <cstdint>
#include <string_view>
#include <unordered_map>

#include "backend/unit/comments.h"

namespace rung::backend {
namespace {

/// Calls `use` with every cell that the rung reads, but for its own.
template <typename Use>
void for_reads(const Program& program, const Rung& rung, const Use& use) {
  for (std::uint32_t at = rung.begin; at < rung.end; ++at) {
    const Node& node = program.nodes[at];
    if (node.op == NodeOp::Read && node.cell != rung.target) use(node.cell);
  }
}

bool executes(const Program& program, const Rung& rung) {
  for (std::uint32_t at = rung.begin; at < rung.end; ++at) {
    const Node& node = program.nodes[at];
    if (node.op != NodeOp::Call) continue;
    if (!program.calls[node.call].operation->reads) return true;
  }
  return false;
}

}  // namespace

Unused find_unused(const Program& program) {
  Unused unused;
  unused.cells.resize(program.cells.size(), false);
  unused.rungs.resize(program.rungs.size(), false);
  std::vector<std::uint32_t> reads(program.cells.size(), 0);
  std::vector<std::vector<RungId>> writers(program.cells.size());
  std::vector<bool> kept(program.cells.size(), false);
  for (const RungId id : ids_of(program.rungs)) {
    const Rung& rung = program.rungs[id];
    for_reads(program, rung, [&](CellId cell) { ++reads[cell.index()]; });
    writers[rung.target.index()].push_back(id);
    if (executes(program, rung)) kept[rung.target.index()] = true;
  }
  // What a property line speaks of.
  std::unordered_map<std::string_view, CellId> made;
  for (const CellId id : ids_of(program.cells)) {
    if (program.cells[id].made) made.emplace(program.cells[id].name, id);
  }
  for (const AstAnnotation& line : program.annotations) {
    for (const std::string_view name : names_in(line.text)) {
      const auto found = made.find(name);
      if (found != made.end()) kept[found->second.index()] = true;
    }
  }
  std::vector<CellId> open;
  const auto look = [&](CellId id) {
    const std::size_t at = id.index();
    const bool idle = program.cells[id].made && reads[at] == 0 && !kept[at];
    if (idle && !unused.cells[at]) open.push_back(id);
    if (idle) unused.cells[at] = true;
  };
  for (const CellId id : ids_of(program.cells)) look(id);
  while (!open.empty()) {
    const CellId cell = open.back();
    open.pop_back();
    for (const RungId id : writers[cell.index()]) {
      unused.rungs[id.index()] = true;
      for_reads(program, program.rungs[id], [&](CellId read) {
        --reads[read.index()];
        look(read);
      });
    }
  }
  return unused;
}

}  // namespace rung::backend
