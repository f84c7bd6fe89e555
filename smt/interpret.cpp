#include "smt/interpret.h"

#include <algorithm>

#include "smt/bit_blast.h"

namespace rung {

Interpreter::Interpreter(const TransitionSystem& ts,
                         const std::vector<ExprId>& roots)
    : ts_(&ts) {
  collect(roots);
  std::sort(terms_.begin(), terms_.end());
  for (std::uint32_t i = 0; i < terms_.size(); ++i) position_[terms_[i]] = i;
  for (std::uint32_t i = 0; i < terms_.size(); ++i) {
    const Expr& e = ts.exprs[terms_[i]];
    Step step{e.op, i, 0, 0, e.op == ExprOp::Constant ? e.value : 0};
    const Operands under = operands(e);
    std::uint32_t* const places[] = {&step.a, &step.b, &step.c};
    for (std::uint32_t o = 0; o < under.count; ++o) {
      *places[o] = position(under.ids[o]);
    }
    steps_.push_back(step);
    if (e.op != ExprOp::Variable) continue;
    const Variable& var = ts.vars[e.var];
    if (var.role != VarRole::State) continue;
    const ExprId next = ts.states[var.state].next;
    latches_.push_back({var.state, i, position(next)});
  }
  values_.resize(terms_.size(), 0);
  reset();
}

void Interpreter::collect(const std::vector<ExprId>& roots) {
  std::vector<ExprId> stack = roots;
  std::unordered_map<ExprId, bool> seen;
  while (!stack.empty()) {
    const ExprId id = stack.back();
    stack.pop_back();
    if (!seen.emplace(id, true).second) continue;
    terms_.push_back(id);
    const Expr& e = ts_->exprs[id];
    const Operands under = operands(e);
    stack.insert(stack.end(), under.ids, under.ids + under.count);
    if (e.op != ExprOp::Variable) continue;
    const Variable& var = ts_->vars[e.var];
    if (var.role == VarRole::State) {
      stack.push_back(ts_->states[var.state].next);
    }
  }
}

void Interpreter::reset() {
  current_.assign(terms_.size(), 0);
  for (std::uint32_t i = 0; i < terms_.size(); ++i) {
    const Expr& e = ts_->exprs[terms_[i]];
    if (e.op != ExprOp::Variable) continue;
    const Variable& var = ts_->vars[e.var];
    current_[i] = var.role == VarRole::State
                      ? ts_->states[var.state].init
                      : std::clamp<std::int64_t>(0, var.low, var.high);
  }
}

void Interpreter::set_input(VarId input, std::int64_t value) {
  const auto found = position_.find(ts_->of(input));
  if (found != position_.end()) current_[found->second] = value;
}

void Interpreter::scan() {
  const auto of = [&](std::uint32_t place) { return values_[place]; };
  for (std::uint32_t i = 0; i < steps_.size(); ++i) {
    const Step& e = steps_[i];
    std::int64_t& v = values_[i];
    switch (e.op) {
      case ExprOp::Constant:
        v = e.constant;
        break;
      case ExprOp::Variable:
        v = current_[i];
        break;
      case ExprOp::Not:
        v = of(e.a) == 0;
        break;
      case ExprOp::And:
        v = of(e.a) & of(e.b);
        break;
      case ExprOp::Xor:
        v = of(e.a) ^ of(e.b);
        break;
      case ExprOp::Equal:
        v = of(e.a) == of(e.b);
        break;
      case ExprOp::Less:
        v = of(e.a) < of(e.b);
        break;
      case ExprOp::Add:
        v = of(e.a) + of(e.b);
        break;
      case ExprOp::Multiply:
        v = of(e.a) * of(e.b);
        break;
      case ExprOp::Divide:
        v = of(e.a) / of(e.b);
        break;
      case ExprOp::Wrap16:
        v = static_cast<std::int16_t>(static_cast<std::uint64_t>(of(e.a)));
        break;
      case ExprOp::Ite:
        v = of(e.a) != 0 ? of(e.b) : of(e.c);
        break;
    }
  }
  for (const Latch& latch : latches_) current_[latch.at] = values_[latch.next];
}

std::int64_t Interpreter::value(ExprId term) const {
  return values_[position(term)];
}

std::int64_t Interpreter::state(std::uint32_t state) const {
  return current_[position(ts_->state_expr(state))];
}

}  // namespace rung
