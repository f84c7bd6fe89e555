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

}  // namespace

std::vector<std::vector<std::size_t>> partition(
    const TransitionSystem& ts, const std::vector<ExprId>& roots) {
  const std::vector<bool> in = reachable_terms(ts, roots);
  // Inputs are free in every scan, so sharing one joins nothing.
  std::vector<bool> has_state(ts.exprs.size(), false);
  Sets sets(ts.exprs.size());
  for (std::uint32_t i = 0; i < ts.exprs.size(); ++i) {
    if (!in[i]) continue;
    const Expr& e = ts.exprs[ExprId(i)];
    if (e.op == ExprOp::Variable) {
      has_state[i] = ts.vars[e.var].role == VarRole::State;
    }
    const Operands under = operands(e);
    for (std::uint32_t o = 0; o < under.count; ++o) {
      const std::uint32_t operand = under.ids[o].index();
      if (!has_state[operand]) continue;
      has_state[i] = true;
      sets.join(i, operand);
    }
  }
  for (std::uint32_t i = 0; i < ts.exprs.size(); ++i) {
    const Expr& e = ts.exprs[ExprId(i)];
    if (!in[i] || e.op != ExprOp::Variable || !has_state[i]) continue;
    const ExprId next = ts.states[ts.vars[e.var].state].next;
    if (has_state[next.index()]) sets.join(i, next.index());
  }
  std::vector<std::vector<std::size_t>> groups;
  std::unordered_map<std::uint32_t, std::size_t> group_of;
  for (std::size_t i = 0; i < roots.size(); ++i) {
    const std::uint32_t set = sets.find(roots[i].index());
    const auto [entry, is_new] = group_of.try_emplace(set, groups.size());
    if (is_new) groups.emplace_back();
    groups[entry->second].push_back(i);
  }
  return groups;
}

}  // namespace rung
