#include "ts_interpreter.h"

namespace rung {

TsInterpreter::TsInterpreter(const TransitionSystem& ts)
    : ts_(ts), vars_(ts.vars.size()), values_(ts.exprs.size()) {
  reset();
}

void TsInterpreter::reset() {
  for (const State& state : ts_.states) vars_[state.var.index()] = state.init;
}

std::int64_t TsInterpreter::evaluate(const Expr& expr) const {
  const auto at = [this](ExprId id) { return values_[id.index()]; };
  switch (expr.op) {
    case ExprOp::Constant:
      return expr.value;
    case ExprOp::Variable:
      return vars_[expr.var.index()];
    case ExprOp::Not:
      return at(expr.a) == 0 ? 1 : 0;
    case ExprOp::And:
      return at(expr.a) & at(expr.b);
    case ExprOp::Xor:
      return at(expr.a) ^ at(expr.b);
    case ExprOp::Equal:
      return at(expr.a) == at(expr.b) ? 1 : 0;
    case ExprOp::Less:
      return at(expr.a) < at(expr.b) ? 1 : 0;
    case ExprOp::Add:
      return at(expr.a) + at(expr.b);
    case ExprOp::Multiply:
      return at(expr.a) * at(expr.b);
    case ExprOp::Divide:
      return at(expr.a) / at(expr.b);
    case ExprOp::Wrap16: {
      const std::int64_t low = at(expr.a) & 0xffff;
      return low >= 0x8000 ? low - 0x10000 : low;
    }
    case ExprOp::Ite:
      return at(expr.a) != 0 ? at(expr.b) : at(expr.c);
  }
  return 0;
}

void TsInterpreter::step() {
  broken_bound_.clear();
  for (std::uint32_t i = 0; i < ts_.exprs.size(); ++i) {
    const Expr& expr = ts_.exprs[ExprId(i)];
    const std::int64_t value = evaluate(expr);
    values_[i] = value;
    if (value < expr.low || value > expr.high) {
      broken_bound_ = to_string(ts_, ExprId(i)) + " is " +
                      std::to_string(value) + ", not in " +
                      std::to_string(expr.low) + ".." +
                      std::to_string(expr.high);
    }
  }
  for (const State& state : ts_.states) {
    const Variable& var = ts_.vars[state.var];
    const std::int64_t value = values_[state.next.index()];
    vars_[state.var.index()] = value;
    if (value < var.low || value > var.high) {
      broken_bound_ = var.name + " becomes " + std::to_string(value) +
                      ", not in " + std::to_string(var.low) + ".." +
                      std::to_string(var.high);
    }
  }
}

}  // namespace rung
