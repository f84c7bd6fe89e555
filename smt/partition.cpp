#include "smt/partition.h"

#include <algorithm>
#include <numeric>
#include <unordered_map>

#include "smt/bit_blast.h"

namespace rung {
namespace {

/// Disjoint sets of terms, by ExprId index.
class Sets {
 public:
  explicit Sets(std::size_t count) : parent_(count) {
    std::iota(parent_.begin(), parent_.end(), 0U);
  }
  std::uint32_t find(std::uint32_t i) {
    while (parent_[i] != i) {
      parent_[i] = parent_[parent_[i]];
      i = parent_[i];
    }
    return i;
  }
  void join(std::uint32_t a, std::uint32_t b) {
    a = find(a);
    b = find(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<std::uint32_t> parent_;
};

/// Terms under `roots` and the next values of the states in them.
std::vector<bool> reachable_terms(const TransitionSystem& ts,
                                  const std::vector<ExprId>& roots) {
  std::vector<bool> in(ts.exprs.size(), false);
  std::vector<ExprId> stack = roots;
  while (!stack.empty()) {
    const ExprId id = stack.back();
    stack.pop_back();
    if (in[id.index()]) continue;
    in[id.index()] = true;
    const Expr& e = ts.exprs[id];
    const Operands under = operands(e);
    stack.insert(stack.end(), under.ids, under.ids + under.count);
    if (e.op == ExprOp::Variable && ts.vars[e.var].role == VarRole::State) {
      stack.push_back(ts.states[ts.vars[e.var].state].next);
    }
  }
  return in;
}

/// Terms of one cone, joined where they share state.
class Parts {
 public:
  Parts(const TransitionSystem& ts, const std::vector<ExprId>& roots)
      : ts_(ts),
        in_(reachable_terms(ts, roots)),
        has_state_(ts.exprs.size(), false),
        sets_(ts.exprs.size()) {
    join_operands();
    join_next_values();
    find_users();
    join_roots(roots);
  }

  std::uint32_t find(ExprId term) { return sets_.find(term.index()); }

 private:
  static constexpr std::uint32_t kNone = 0xffff'ffff;
  static constexpr std::uint32_t kMany = 0xffff'fffe;

  /// Inputs are free in every scan, so sharing one joins nothing.
  void join_operands() {
    for (std::uint32_t i = 0; i < in_.size(); ++i) {
      if (!in_[i]) continue;
      const Expr& e = ts_.exprs[ExprId(i)];
      if (e.op == ExprOp::Variable) {
        has_state_[i] = ts_.vars[e.var].role == VarRole::State;
      }
      const Operands under = operands(e);
      for (std::uint32_t o = 0; o < under.count; ++o) {
        const std::uint32_t operand = under.ids[o].index();
        if (!has_state_[operand]) continue;
        has_state_[i] = true;
        sets_.join(i, operand);
      }
    }
  }

  ExprId next_of(std::uint32_t i) const {
    const Expr& e = ts_.exprs[ExprId(i)];
    if (!in_[i] || e.op != ExprOp::Variable || !has_state_[i]) return {};
    return ts_.states[ts_.vars[e.var].state].next;
  }

  void join_next_values() {
    for (std::uint32_t i = 0; i < in_.size(); ++i) {
      const ExprId next = next_of(i);
      if (next.has_value() && has_state_[next.index()]) {
        sets_.join(i, next.index());
      }
    }
  }

  static std::uint32_t both(std::uint32_t a, std::uint32_t b) {
    if (a == kNone || a == b) return b;
    return b == kNone ? a : kMany;
  }
  void use(std::uint32_t term, std::uint32_t user) {
    if (!has_state_[term]) user_[term] = both(user_[term], user);
  }

  /// The one set that a term without state is used in.
  void find_users() {
    user_.assign(in_.size(), kNone);
    for (std::uint32_t i = 0; i < in_.size(); ++i) {
      const ExprId next = next_of(i);
      if (next.has_value()) use(next.index(), sets_.find(i));
    }
    for (auto i = static_cast<std::uint32_t>(in_.size()); i-- > 0;) {
      if (!in_[i]) continue;
      const Operands under = operands(ts_.exprs[ExprId(i)]);
      const std::uint32_t user = has_state_[i] ? sets_.find(i) : user_[i];
      for (std::uint32_t o = 0; o < under.count; ++o) {
        use(under.ids[o].index(), user);
      }
    }
  }

  /// A root over inputs of one set alone belongs to it: their runs are one.
  void join_roots(const std::vector<ExprId>& roots) {
    std::vector<std::uint32_t> of(in_.size(), kNone);  // of the inputs under it
    for (std::uint32_t i = 0; i < in_.size(); ++i) {
      if (!in_[i] || has_state_[i]) continue;
      const Expr& e = ts_.exprs[ExprId(i)];
      if (e.op == ExprOp::Variable) of[i] = user_[i];
      const Operands under = operands(e);
      for (std::uint32_t o = 0; o < under.count; ++o) {
        of[i] = both(of[i], of[under.ids[o].index()]);
      }
    }
    for (const ExprId root : roots) {
      const std::uint32_t user = of[root.index()];
      if (user < kMany) sets_.join(root.index(), user);
    }
  }

  const TransitionSystem& ts_;
  std::vector<bool> in_;
  std::vector<bool> has_state_;
  Sets sets_;
  std::vector<std::uint32_t> user_;
};

}  // namespace

std::vector<std::vector<std::size_t>> partition(
    const TransitionSystem& ts, const std::vector<ExprId>& roots) {
  Parts parts(ts, roots);
  std::vector<std::vector<std::size_t>> groups;
  std::unordered_map<std::uint32_t, std::size_t> group_of;
  for (std::size_t i = 0; i < roots.size(); ++i) {
    const std::uint32_t set = parts.find(roots[i]);
    const auto [entry, is_new] = group_of.try_emplace(set, groups.size());
    if (is_new) groups.emplace_back();
    groups[entry->second].push_back(i);
  }
  return groups;
}

}  // namespace rung
