#include <cassert>

#include "analysis/formula.h"
#include "analysis/transition_system.h"

namespace rung {

ExprId apply_operator(ExprArena& exprs, const FormulaNode& node,
                      const ExprId* operand) {
  const ExprId a = node.arguments > 0 ? operand[0] : ExprId();
  const ExprId b = node.arguments > 1 ? operand[1] : ExprId();
  switch (node.op) {
    case FormulaOp::Not:
      return exprs.negation(a);
    case FormulaOp::Negate:
      return exprs.negate(a);
    case FormulaOp::And:
      return exprs.conjunction(a, b);
    case FormulaOp::Or:
      return exprs.disjunction(a, b);
    case FormulaOp::Xor:
      return exprs.exclusive_or(a, b);
    case FormulaOp::Implies:
      return exprs.implication(a, b);
    case FormulaOp::Equivalent:
      return exprs.equivalence(a, b);
    case FormulaOp::Choose:
      return exprs.ite(a, b, operand[2]);
    case FormulaOp::Equal:
      return exprs.equal(a, b);
    case FormulaOp::NotEqual:
      return exprs.negation(exprs.equal(a, b));
    case FormulaOp::Less:
      return exprs.less(a, b);
    case FormulaOp::LessEqual:
      return exprs.less_equal(a, b);
    case FormulaOp::Greater:
      return exprs.less(b, a);
    case FormulaOp::GreaterEqual:
      return exprs.less_equal(b, a);
    case FormulaOp::Add:
      return exprs.add(a, b);
    case FormulaOp::Subtract:
      return exprs.subtract(a, b);
    case FormulaOp::Multiply:
      return exprs.multiply(a, b);
    case FormulaOp::Name:
    case FormulaOp::Number:
    case FormulaOp::Bool:
    case FormulaOp::Call:
      break;
  }
  assert(false && "leaves and calls are handled by the caller");
  return exprs.bit(false);
}

ExprId compile_formula(ExprArena& exprs, const Formula& formula,
                       NameResolver& names) {
  assert(formula.has_value());
  std::vector<ExprId> stack;
  for (const FormulaNode& node : formula.nodes) {
    if (node.op == FormulaOp::Name) {
      stack.push_back(names.resolve(node.text));
      assert(stack.back().has_value());
    } else if (node.op == FormulaOp::Number) {
      stack.push_back(exprs.word(node.number));
    } else if (node.op == FormulaOp::Bool) {
      stack.push_back(exprs.bit(node.number != 0));
    } else {
      const std::size_t first = stack.size() - node.arguments;
      const ExprId result = apply_operator(exprs, node, stack.data() + first);
      stack.resize(first);
      stack.push_back(result);
    }
  }
  assert(stack.size() == 1);
  return stack.back();
}

}  // namespace rung
