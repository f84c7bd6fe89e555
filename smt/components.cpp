#include "smt/components.h"

#include <algorithm>
#include <cstdint>
#include <unordered_map>
#include <unordered_set>
#include <utility>

namespace rung {
namespace {

std::vector<ExprId> roots_of(const TransitionSystem& ts,
                             const Invariant& invariant) {
  std::vector<ExprId> roots = invariant.conditions;
  roots.insert(roots.end(), invariant.consequences.begin(),
               invariant.consequences.end());
  roots.insert(roots.end(), ts.constraints.begin(), ts.constraints.end());
  for (const LemmaClause& lemma : invariant.lemmas) {
    for (const LemmaAtom& atom : lemma) {
      roots.push_back(atom.term.has_value() ? atom.term : ts.of(atom.var));
    }
  }
  return roots;
}

/// The inputs that assumptions about the past speak of: they tie what reads
/// them to what is known of that past.
std::unordered_set<ExprId> tying_inputs(const TransitionSystem& ts) {
  std::unordered_set<ExprId> seen;
  std::unordered_set<ExprId> inputs;
  bool any_state = false;
  std::vector<ExprId> open = ts.constraints;
  while (!open.empty()) {
    const ExprId id = open.back();
    open.pop_back();
    if (!seen.insert(id).second) continue;
    const Expr& e = ts.exprs[id];
    for (const ExprId operand : {e.a, e.b, e.c}) {
      if (operand.has_value()) open.push_back(operand);
    }
    if (e.op != ExprOp::Variable) continue;
    if (ts.vars[e.var].role == VarRole::State) {
      any_state = true;
    } else {
      inputs.insert(id);
    }
  }
  if (!any_state) inputs.clear();
  return inputs;
}

/// The terms of a cone, joined where one is made of the other, now or in the
/// next scan. Terms without a state join nothing: inputs may be shared, unless
/// assumptions tie them to a state.
class TermGroups {
 public:
  TermGroups(const TransitionSystem& ts, std::vector<ExprId> open)
      : ts_(ts), tying_(tying_inputs(ts)) {
    while (!open.empty()) {
      const ExprId id = open.back();
      open.pop_back();
      if (!place_.emplace(id, 0U).second) continue;
      terms_.push_back(id);
      const Expr& e = ts.exprs[id];
      for (const ExprId operand : {e.a, e.b, e.c}) {
        if (operand.has_value()) open.push_back(operand);
      }
      const ExprId next = next_of(id);
      if (next.has_value()) open.push_back(next);
    }
    std::sort(terms_.begin(), terms_.end());  // operands first
    for (std::uint32_t i = 0; i < terms_.size(); ++i) {
      place_[terms_[i]] = i;
      parent_.push_back(i);
    }
    has_state_.assign(terms_.size(), false);
    for (const ExprId id : terms_) join_operands(id);
    for (const ExprId id : terms_) {
      const ExprId next = next_of(id);
      if (next.has_value()) join(id, next);
    }
  }

  bool has_state(ExprId id) const { return has_state_[place_.at(id)]; }
  std::uint32_t find(ExprId id) {
    std::uint32_t i = place_.at(id);
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(ExprId a, ExprId b) {
    if (has_state(a) && has_state(b)) parent_[find(a)] = find(b);
  }

 private:
  ExprId next_of(ExprId id) const {
    const Expr& e = ts_.exprs[id];
    if (e.op != ExprOp::Variable) return {};
    const Variable& variable = ts_.vars[e.var];
    if (variable.role != VarRole::State) return {};
    return ts_.states[variable.state].next;
  }

  void join_operands(ExprId id) {
    const std::uint32_t i = place_.at(id);
    const Expr& e = ts_.exprs[id];
    has_state_[i] = next_of(id).has_value() || tying_.count(id) != 0;
    for (const ExprId operand : {e.a, e.b, e.c}) {
      if (!operand.has_value() || !has_state(operand)) continue;
      has_state_[i] = true;
      join(id, operand);
    }
  }

  const TransitionSystem& ts_;
  std::unordered_set<ExprId> tying_;
  std::unordered_map<ExprId, std::uint32_t> place_;
  std::vector<ExprId> terms_;
  std::vector<std::uint32_t> parent_;  // by place
  std::vector<bool> has_state_;
};

/// The parts, by the group that their claims fall in.
class Parts {
 public:
  Parts(TermGroups& groups, std::uint32_t k) : groups_(groups), k_(k) {}

  Invariant& of(const std::vector<ExprId>& terms) {
    std::uint32_t group = kNoState;
    for (const ExprId term : terms) {
      if (groups_.has_state(term)) group = groups_.find(term);
    }
    const auto [entry, is_new] = place_.emplace(group, parts_.size());
    if (is_new) parts_.push_back({.k = k_});
    return parts_[entry->second];
  }
  std::vector<Invariant> take() { return std::move(parts_); }

 private:
  static constexpr std::uint32_t kNoState = 0xffff'ffff;
  TermGroups& groups_;
  std::uint32_t k_;
  std::vector<Invariant> parts_;
  std::unordered_map<std::uint32_t, std::size_t> place_;
};

std::vector<ExprId> atoms(const TransitionSystem& ts,
                          const LemmaClause& lemma) {
  std::vector<ExprId> terms;
  for (const LemmaAtom& atom : lemma) {
    terms.push_back(atom.term.has_value() ? atom.term : ts.of(atom.var));
  }
  return terms;
}

}  // namespace

std::vector<Invariant> split_certificate(const TransitionSystem& ts,
                                         const Invariant& invariant) {
  TermGroups groups(ts, roots_of(ts, invariant));
  const auto join_all = [&](const std::vector<ExprId>& terms) {
    for (std::size_t i = 1; i < terms.size(); ++i)
      groups.join(terms[0], terms[i]);
  };
  for (const LemmaClause& lemma : invariant.lemmas) {
    // Through any atom with a state: the first may have none.
    std::vector<ExprId> terms = atoms(ts, lemma);
    std::stable_partition(terms.begin(), terms.end(),
                          [&](ExprId id) { return groups.has_state(id); });
    join_all(terms);
  }
  Parts parts(groups, invariant.k);
  for (const LemmaClause& lemma : invariant.lemmas) {
    parts.of(atoms(ts, lemma)).lemmas.push_back(lemma);
  }
  for (const ExprId condition : invariant.conditions) {
    parts.of({condition}).conditions.push_back(condition);
  }
  for (const ExprId consequence : invariant.consequences) {
    parts.of({consequence}).consequences.push_back(consequence);
  }
  return parts.take();
}

}  // namespace rung
