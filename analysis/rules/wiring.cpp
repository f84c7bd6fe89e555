#include "analysis/rules/wiring.h"

namespace rung {

std::vector<std::uint32_t> leaves(const Program& program, std::uint32_t node) {
  std::vector<std::uint32_t> found;
  std::vector<std::uint32_t> open = {node};
  while (!open.empty()) {
    const std::uint32_t at = open.back();
    open.pop_back();
    if (!is_and_or(program.nodes[at].op)) {
      found.push_back(at);
      continue;
    }
    open.push_back(program.nodes[at].b);
    open.push_back(program.nodes[at].a);
  }
  return found;
}

std::vector<const Wiring*> wiring_of_cells(const RuleRun& run) {
  std::vector<const Wiring*> wirings(run.program.cells.size());
  for (const Wiring& wiring : run.properties.wirings) {
    wirings[wiring.cell.index()] = &wiring;
  }
  return wirings;
}

ExprId is_active(RuleRun& run, const Wiring& wiring) {
  const ExprId value = run.ts.cell_end[wiring.cell.index()];
  return wiring.normally_closed ? run.ts.exprs.negation(value) : value;
}

std::string device(const Program& program, const Wiring& wiring) {
  const std::string name = quoted(program, wiring.cell);
  if (wiring.trip) return "the trip " + name;
  return wiring.reset ? "the reset " + name : name;
}

}  // namespace rung
