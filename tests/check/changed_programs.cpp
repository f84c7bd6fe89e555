#include "changed_programs.h"

namespace rung {

std::vector<Program> changed_programs(const Program& program) {
  std::vector<Program> result;
  const auto with = [&](auto change) {
    result.push_back(program);
    change(result.back());
  };
  for (std::size_t i = 0; i < program.nodes.size(); ++i) {
    const NodeOp op = program.nodes[i].op;
    if (op == NodeOp::And || op == NodeOp::Or) {
      with([&](Program& changed) {
        changed.nodes[i].op = op == NodeOp::And ? NodeOp::Or : NodeOp::And;
      });
    } else if (op == NodeOp::Not) {
      // A negation less: both operands of an And are the same.
      with([&](Program& changed) {
        changed.nodes[i].op = NodeOp::And;
        changed.nodes[i].b = changed.nodes[i].a;
      });
    }
  }
  for (const CallId id : ids_of(program.calls)) {
    with([&](Program& changed) { changed.calls[id].parameter /= 2; });
    with([&](Program& changed) { changed.calls[id].parameter += 1; });
  }
  for (const CellId id : ids_of(program.cells)) {
    if (program.cells[id].role == CellRole::Input) continue;
    with([&](Program& changed) { changed.cells[id].initial = 1; });
  }
  return result;
}

}  // namespace rung
