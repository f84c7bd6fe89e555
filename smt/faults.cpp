#include "smt/faults.h"

#include <algorithm>

#include "smt/bit_blast.h"

namespace rung {

std::vector<ExprId> comparisons(const TransitionSystem& ts, ExprId condition) {
  std::vector<ExprId> found;
  std::vector<ExprId> stack = {condition};
  while (!stack.empty()) {
    const ExprId id = stack.back();
    stack.pop_back();
    const Expr& e = ts.exprs[id];
    if (e.op == ExprOp::Less) found.push_back(id);
    if (e.op != ExprOp::And && e.op != ExprOp::Not) continue;
    const Operands under = operands(e);
    stack.insert(stack.end(), under.ids, under.ids + under.count);
  }
  return found;
}

std::unordered_set<ExprId> dependencies(const TransitionSystem& ts,
                                        ExprId root) {
  std::unordered_set<ExprId> seen;
  std::vector<ExprId> stack = {root};
  while (!stack.empty()) {
    const ExprId id = stack.back();
    stack.pop_back();
    if (!seen.insert(id).second) continue;
    const Expr& e = ts.exprs[id];
    const Operands under = operands(e);
    stack.insert(stack.end(), under.ids, under.ids + under.count);
    if (e.op == ExprOp::Variable && ts.vars[e.var].role == VarRole::State) {
      stack.push_back(ts.states[ts.vars[e.var].state].next);
    }
  }
  return seen;
}

std::vector<std::size_t> faults_under(const TransitionSystem& ts, ExprId root) {
  std::vector<std::size_t> found;
  if (ts.faults.empty()) return found;
  const std::unordered_set<ExprId> seen = dependencies(ts, root);
  for (std::size_t i = 0; i < ts.faults.size(); ++i) {
    const std::vector<ExprId> all = comparisons(ts, ts.faults[i].condition);
    if (std::any_of(all.begin(), all.end(),
                    [&](ExprId id) { return seen.count(id) != 0; })) {
      found.push_back(i);
    }
  }
  return found;
}

std::string may_leave_range(const Program& program, const Fault& fault) {
  return fault.cell.has_value()
             ? "`" + program.cells[fault.cell].name + "` may leave its range"
             : "a number may leave the range in which it is exact";
}

}  // namespace rung
