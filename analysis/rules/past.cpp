#include "analysis/rules/past.h"

#include <algorithm>
#include <string>
#include <vector>

namespace rung {

ExprId Past::previous(ExprId term) {
  const auto [entry, is_new] = memory_.try_emplace(term.index());
  if (!is_new) return entry->second;
  const Expr expr = ts_.exprs[term];  // a copy: the arena grows
  const std::int64_t initial = std::clamp<std::int64_t>(0, expr.low, expr.high);
  const std::uint32_t state =
      ts_.add_state(".before." + std::to_string(term.index()), expr.type,
                    expr.low, expr.high, initial);
  ts_.states[state].next = term;
  return entry->second = ts_.state_expr(state);
}

ExprId Past::inputs_rest(ExprId term) {
  const std::vector<bool> cone = cone_of_influence(ts_, {term});
  std::vector<ExprId> rest;
  for (std::uint32_t i = 0; i < cone.size(); ++i) {
    const Variable& var = ts_.vars[VarId(i)];
    if (!cone[i] || var.role != VarRole::Input) continue;
    const ExprId now = var.expr;
    rest.push_back(ts_.exprs.equal(now, previous(now)));
  }
  return ts_.exprs.conjunction(rest);
}

ExprId Past::first_scan() {
  if (!ran_.has_value()) {
    const std::uint32_t state = ts_.add_state(".ran", Type::Bit, 0, 1, 0);
    ts_.states[state].next = ts_.exprs.bit(true);
    ran_ = ts_.state_expr(state);
  }
  return ts_.exprs.negation(ran_);
}

}  // namespace rung
