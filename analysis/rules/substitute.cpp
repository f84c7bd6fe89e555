#include "analysis/rules/substitute.h"

#include <algorithm>

#include "analysis/rebuilt.h"

namespace rung {
std::vector<ExprId> substitute(
    TransitionSystem& ts, const std::vector<ExprId>& roots,
    const std::unordered_map<std::uint32_t, ExprId>& replacement) {
  std::uint32_t size = 0;
  std::vector<bool> needed(ts.exprs.size());
  for (const ExprId root : roots) {
    needed[root.index()] = true;
    size = std::max(size, root.index() + 1);
  }
  for (std::uint32_t i = size; i-- > 0;) {
    if (!needed[i]) continue;
    const Expr& expr = ts.exprs[ExprId(i)];
    for (const ExprId operand : {expr.a, expr.b, expr.c}) {
      if (operand.has_value()) needed[operand.index()] = true;
    }
  }
  std::vector<ExprId> made(size);
  const auto of = [&](ExprId id) {
    return id.has_value() ? made[id.index()] : id;
  };
  for (std::uint32_t i = 0; i < size; ++i) {
    if (!needed[i]) continue;
    const Expr expr = ts.exprs[ExprId(i)];  // a copy: the arena grows
    const auto found = expr.op == ExprOp::Variable
                           ? replacement.find(expr.var.index())
                           : replacement.end();
    made[i] = found != replacement.end()
                  ? found->second
                  : rebuilt(ts.exprs, expr, of(expr.a), of(expr.b), of(expr.c));
  }
  std::vector<ExprId> results;
  results.reserve(roots.size());
  for (const ExprId root : roots) results.push_back(made[root.index()]);
  return results;
}

}  // namespace rung
