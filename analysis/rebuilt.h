#pragma once

#include "analysis/expr.h"

namespace rung {

/// The term `e` over other operands. It is made as any term is, so it may
/// become a simpler one. `e` may be of another arena.
ExprId rebuilt(ExprArena& exprs, const Expr& e, ExprId a, ExprId b, ExprId c);

}  // namespace rung
