#include "smt/term_order.h"

#include <unordered_set>

#include "smt/bit_blast.h"

namespace rung {
namespace {

class Walk {
 public:
  explicit Walk(const TransitionSystem& ts) : ts_(ts) {}

  void visit(ExprId root) {
    stack_.push_back(root);
    while (!stack_.empty()) {
      const ExprId id = stack_.back();
      const std::size_t waiting = stack_.size();
      const Operands under = operands(ts_.exprs[id]);
      for (std::uint32_t i = under.count; seen_.count(id) == 0 && i-- > 0;) {
        if (seen_.count(under.ids[i]) == 0) stack_.push_back(under.ids[i]);
      }
      if (stack_.size() != waiting) continue;
      stack_.pop_back();
      if (seen_.insert(id).second) terms_.push_back(id);
    }
  }

  std::vector<ExprId> take() {
    // What they are made of in the next scan; that may bring more of them.
    for (std::size_t i = 0; i < terms_.size(); ++i) {
      const Expr& e = ts_.exprs[terms_[i]];
      if (e.op != ExprOp::Variable) continue;
      const Variable& variable = ts_.vars[e.var];
      if (variable.role == VarRole::State) {
        visit(ts_.states[variable.state].next);
      }
    }
    return std::move(terms_);
  }

 private:
  const TransitionSystem& ts_;
  std::unordered_set<ExprId> seen_;
  std::vector<ExprId> stack_;
  std::vector<ExprId> terms_;
};

}  // namespace

std::vector<ExprId> terms_in_order(const TransitionSystem& ts,
                                   const std::vector<ExprId>& roots) {
  Walk walk(ts);
  for (const ExprId root : roots) walk.visit(root);
  return walk.take();
}

}  // namespace rung
