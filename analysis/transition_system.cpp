#include "analysis/transition_system.h"

#include <cassert>
#include <utility>

namespace rung {

VarId TransitionSystem::add_input(std::string name, VarRole role, Type type,
                                  std::int64_t low, std::int64_t high,
                                  CellId cell) {
  assert(role != VarRole::State);
  const VarId var(static_cast<std::uint32_t>(vars.size()));
  vars.add({.name = std::move(name),
            .role = role,
            .type = type,
            .low = low,
            .high = high,
            .cell = cell,
            .expr = exprs.variable(var, type, low, high)});
  return var;
}

std::uint32_t TransitionSystem::add_state(std::string name, Type type,
                                          std::int64_t low, std::int64_t high,
                                          std::int64_t init, CellId cell) {
  assert(low <= init && init <= high);
  const VarId var(static_cast<std::uint32_t>(vars.size()));
  const auto state = static_cast<std::uint32_t>(states.size());
  vars.add({.name = std::move(name),
            .role = VarRole::State,
            .type = type,
            .low = low,
            .high = high,
            .cell = cell,
            .state = state,
            .expr = exprs.variable(var, type, low, high)});
  states.push_back({.var = var, .init = init});
  return state;
}

std::uint32_t TransitionSystem::add_clock(std::string name, ExprId restart,
                                          std::int64_t cap) {
  const std::uint32_t state = add_state(std::move(name), Type::Word, 0, cap, 0);
  const ExprId grown =
      exprs.minimum(exprs.add(state_expr(state), of(dt)), exprs.word(cap));
  states[state].next = exprs.ite(restart, exprs.word(0), grown);
  states[state].clock = true;
  states[state].running = exprs.bit(true);
  states[state].cap = cap;
  return state;
}

std::vector<bool> cone_of_influence(const TransitionSystem& ts,
                                    const std::vector<ExprId>& roots) {
  std::vector<bool> in_cone(ts.vars.size(), false);
  std::vector<bool> seen(ts.exprs.size(), false);
  std::vector<ExprId> open;
  const auto visit = [&](ExprId id) {
    if (!id.has_value() || seen[id.index()]) return;
    seen[id.index()] = true;
    open.push_back(id);
  };
  for (const ExprId root : roots) visit(root);
  for (const ExprId constraint : ts.constraints) visit(constraint);
  while (!open.empty()) {
    const Expr& expr = ts.exprs[open.back()];
    open.pop_back();
    visit(expr.a);
    visit(expr.b);
    visit(expr.c);
    if (expr.op != ExprOp::Variable || in_cone[expr.var.index()]) continue;
    in_cone[expr.var.index()] = true;
    const Variable& var = ts.vars[expr.var];
    if (var.role == VarRole::State) visit(ts.states[var.state].next);
  }
  return in_cone;
}

}  // namespace rung
