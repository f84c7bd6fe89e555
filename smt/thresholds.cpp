#include "smt/thresholds.h"

#include <algorithm>
#include <deque>

namespace rung {
namespace {

constexpr std::size_t kPerWord = 8;
constexpr std::size_t kVisited = 400;  // terms, looking for states
constexpr std::size_t kReaders = 4;    // words in one comparison

}  // namespace

std::vector<std::uint32_t> states_read(const TransitionSystem& ts, ExprId term,
                                       bool words_only, std::size_t limit) {
  std::vector<std::uint32_t> result;
  std::deque<ExprId> queue = {term};
  std::unordered_map<ExprId, bool> seen;
  while (!queue.empty() && seen.size() < kVisited && result.size() < limit) {
    const ExprId id = queue.front();
    queue.pop_front();
    if (!seen.emplace(id, true).second) continue;
    const Expr& e = ts.exprs[id];
    if (words_only && e.type == Type::Bit) continue;
    if (e.op == ExprOp::Variable && ts.vars[e.var].role == VarRole::State) {
      result.push_back(ts.vars[e.var].state);
    }
    const Operands under = operands(e);
    queue.insert(queue.end(), under.ids, under.ids + under.count);
  }
  return result;
}

std::unordered_map<std::uint32_t, std::vector<std::int64_t>> thresholds(
    const Cone& cone) {
  const TransitionSystem& ts = cone.ts();
  std::unordered_map<std::uint32_t, std::vector<std::int64_t>> result;
  for (std::uint32_t state : cone.states()) {
    const Variable& var = ts.vars[ts.states[state].var];
    if (var.type == Type::Word) result[state] = {};
  }
  for (ExprId id : cone.circuit().terms()) {
    const Expr& e = ts.exprs[id];
    if (e.op != ExprOp::Less && e.op != ExprOp::Equal) continue;
    const bool left = ts.exprs.is_constant(e.a);
    if (!left && !ts.exprs.is_constant(e.b)) continue;
    const std::int64_t c = ts.exprs[left ? e.a : e.b].value;
    for (std::uint32_t state :
         states_read(ts, left ? e.b : e.a, true, kReaders)) {
      std::vector<std::int64_t>& known = result[state];
      if (left || e.op == ExprOp::Equal) known.push_back(c + 1);
      if (!left) known.push_back(c);
    }
  }
  for (auto& [state, known] : result) {
    const Variable& var = ts.vars[ts.states[state].var];
    std::erase_if(known,
                  [&](std::int64_t c) { return c <= var.low || c > var.high; });
    std::sort(known.begin(), known.end());
    known.erase(std::unique(known.begin(), known.end()), known.end());
    if (known.size() > kPerWord) known.resize(kPerWord);
  }
  return result;
}

}  // namespace rung
