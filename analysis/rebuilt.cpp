#include "analysis/rebuilt.h"

namespace rung {

ExprId rebuilt(ExprArena& exprs, const Expr& e, ExprId a, ExprId b, ExprId c) {
  switch (e.op) {
    case ExprOp::Not:
      return exprs.negation(a);
    case ExprOp::And:
      return exprs.conjunction(a, b);
    case ExprOp::Xor:
      return exprs.exclusive_or(a, b);
    case ExprOp::Equal:
      return exprs.equal(a, b);
    case ExprOp::Less:
      return exprs.less(a, b);
    case ExprOp::Add:
      return exprs.add(a, b);
    case ExprOp::Multiply:
      return exprs.multiply(a, b);
    case ExprOp::Divide:
      return exprs.divide(a, exprs[b].value);
    case ExprOp::Wrap16:
      return exprs.wrap16(a);
    case ExprOp::Ite:
      return exprs.ite(a, b, c);
    case ExprOp::Constant:
      return e.type == Type::Word ? exprs.word(e.value)
                                  : exprs.bit(e.value != 0);
    case ExprOp::Variable:
      return exprs.variable(e.var, e.type, e.low, e.high);
  }
  return {};
}

}  // namespace rung
