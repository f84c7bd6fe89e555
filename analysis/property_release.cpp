#include "analysis/property_release.h"

#include <algorithm>
#include <cstdint>
#include <unordered_map>
#include <unordered_set>
#include <utility>
#include <vector>

namespace rung {
namespace {

using Choice = std::unordered_map<VarId, std::int64_t>;

/// The terms below `roots`, operands first.
std::vector<ExprId> cone_of(const ExprArena& exprs,
                            const std::vector<ExprId>& roots) {
  std::vector<ExprId> open = roots;
  std::unordered_set<ExprId> seen(roots.begin(), roots.end());
  while (!open.empty()) {
    const Expr& expr = exprs[open.back()];
    open.pop_back();
    for (const ExprId operand : {expr.a, expr.b, expr.c}) {
      if (!operand.has_value() || !seen.insert(operand).second) continue;
      open.push_back(operand);
    }
  }
  std::vector<ExprId> cone(seen.begin(), seen.end());
  std::sort(cone.begin(), cone.end());
  return cone;
}

ExprId rebuilt(ExprArena& exprs, const Expr& expr, ExprId a, ExprId b,
               ExprId c) {
  switch (expr.op) {
    case ExprOp::Constant:
    case ExprOp::Variable:
      break;
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
  }
  return {};
}

/// `root` with the inputs of the scan replaced by a choice; those that it does
/// not name are 0, or what is nearest to that in their range.
class Substitution {
 public:
  Substitution(TransitionSystem& ts, const std::vector<ExprId>& roots)
      : ts_(ts), cone_(cone_of(ts.exprs, roots)) {
    for (const ExprId id : cone_) {
      const Expr& expr = ts.exprs[id];
      if (expr.op != ExprOp::Variable) continue;
      if (ts.vars[expr.var].role == VarRole::Input) inputs_.push_back(expr.var);
    }
  }

  /// The input variables in the cone, in order.
  const std::vector<VarId>& inputs() const { return inputs_; }

  void apply(const Choice& choice) {
    replaced_.clear();
    for (const ExprId id : cone_) {
      const Expr expr = ts_.exprs[id];
      ExprId result = id;
      if (expr.op == ExprOp::Variable) {
        result = leaf(id, ts_.vars[expr.var], expr.var, choice);
      } else if (expr.op != ExprOp::Constant) {
        result = rebuilt(ts_.exprs, expr, of(expr.a), of(expr.b), of(expr.c));
      }
      replaced_.emplace(id, result);
    }
  }

  ExprId of(ExprId id) const {
    return id.has_value() ? replaced_.at(id) : ExprId();
  }

 private:
  ExprId leaf(ExprId id, const Variable& var, VarId var_id,
              const Choice& choice) {
    if (var.role == VarRole::Dt) return ts_.exprs.word(var.low);
    if (var.role != VarRole::Input) return id;
    const auto found = choice.find(var_id);
    const std::int64_t value =
        found != choice.end() ? found->second
                              : std::clamp<std::int64_t>(0, var.low, var.high);
    return var.type == Type::Bit ? ts_.exprs.bit(value != 0)
                                 : ts_.exprs.word(value);
  }

  TransitionSystem& ts_;
  std::vector<ExprId> cone_;
  std::vector<VarId> inputs_;
  std::unordered_map<ExprId, ExprId> replaced_;
};

/// All inputs low, all high, then each one against all others.
std::vector<Choice> candidates(const TransitionSystem& ts,
                               const std::vector<VarId>& inputs) {
  constexpr std::size_t kMaxInputs = 12;
  Choice low;
  Choice high;
  for (const VarId input : inputs) {
    const Variable& var = ts.vars[input];
    low[input] = std::clamp<std::int64_t>(0, var.low, var.high);
    high[input] = var.high;
  }
  std::vector<Choice> result = {low, high};
  const std::size_t count = std::min(inputs.size(), kMaxInputs);
  for (std::size_t i = 0; i < count; ++i) {
    const VarId input = inputs[i];
    result.push_back(low);
    result.back()[input] = high[input];
    result.push_back(high);
    result.back()[input] = ts.vars[input].low;
  }
  return result;
}

bool all_true(const TransitionSystem& ts, const Substitution& substitution,
              const std::vector<ExprId>& terms) {
  return std::all_of(terms.begin(), terms.end(), [&](ExprId term) {
    return ts.exprs.is_true(substitution.of(term));
  });
}

}  // namespace

std::optional<ExprId> release_condition(PropertyTerms& terms,
                                        std::string_view latch,
                                        std::string_view reset) {
  TransitionSystem& ts = terms.ts();
  const ExprId after = terms.term(latch);
  const ExprId before = terms.before(latch);
  std::vector<ExprId> roots = ts.constraints;
  roots.push_back(terms.term(reset));
  // The choice is of what the reset and the assumptions are about.
  const std::vector<VarId> choosable = Substitution(ts, roots).inputs();
  roots.push_back(after);
  Substitution substitution(ts, roots);
  std::optional<ExprId> second_best;
  for (const Choice& choice : candidates(ts, choosable)) {
    substitution.apply(choice);
    if (!all_true(ts, substitution, ts.constraints)) continue;
    const ExprId condition =
        ts.exprs.implication(before, ts.exprs.negation(substitution.of(after)));
    if (ts.exprs.is_true(condition)) return condition;
    const bool resets =
        ts.exprs.is_true(substitution.of(roots[ts.constraints.size()]));
    if (resets && !second_best) second_best = condition;
  }
  return second_best;
}

}  // namespace rung
