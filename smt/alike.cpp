#include "smt/alike.h"

#include <string>
#include <unordered_set>

#include "analysis/rebuilt.h"
#include "smt/bit_blast.h"
#include "smt/term_order.h"

namespace rung {
namespace {

/// All that engines see of a part, as text: equal parts have equal ones.
class Shape {
 public:
  Shape(const TransitionSystem& ts, const std::vector<ExprId>& terms)
      : ts_(ts) {
    for (std::uint32_t i = 0; i < terms.size(); ++i) place_[terms[i]] = i;
    add(static_cast<std::int64_t>(terms.size()));
    for (const ExprId id : terms) add_term(ts.exprs[id]);
    for (const ExprId id : terms) {
      const Expr& e = ts.exprs[id];
      if (e.op == ExprOp::Variable) add_variable(ts.vars[e.var]);
    }
    for (const ExprId constraint : ts.constraints) add_place(constraint);
  }

  void add_target(const Target& target) {
    add_place(target.term);
    add(static_cast<std::int64_t>(target.purpose));
    add(target.hidden ? 1 : 0);
  }
  std::string take() { return std::move(text_); }

 private:
  void add(std::int64_t value) {
    text_.append(reinterpret_cast<const char*>(&value), sizeof value);
  }
  void add_place(ExprId id) {
    const auto found = place_.find(id);
    add(found == place_.end() ? -1 : std::int64_t{found->second});
  }

  void add_term(const Expr& e) {
    add(static_cast<std::int64_t>(e.op));
    add(static_cast<std::int64_t>(e.type));
    add(e.value);
    const Operands under = operands(e);
    for (std::uint32_t i = 0; i < under.count; ++i) add_place(under.ids[i]);
  }

  void add_variable(const Variable& variable) {
    add(static_cast<std::int64_t>(variable.role));
    add(variable.low);
    add(variable.high);
    if (variable.role != VarRole::State) return;
    const State& state = ts_.states[variable.state];
    add(state.init);
    add_place(state.next);
    add(state.clock ? 1 : 0);
    if (!state.clock) return;
    add_place(state.running);
    add(state.cap);
  }

  const TransitionSystem& ts_;
  std::unordered_map<ExprId, std::uint32_t> place_;
  std::string text_;
};

}  // namespace

AlikeParts::AlikeParts(const TransitionSystem& ts,
                       const std::vector<Target>& targets,
                       const std::vector<std::vector<std::size_t>>& parts) {
  std::unordered_map<std::string, std::size_t> first;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    std::vector<ExprId> roots;
    for (const std::size_t target : parts[i]) {
      roots.push_back(targets[target].term);
    }
    roots.insert(roots.end(), ts.constraints.begin(), ts.constraints.end());
    terms_.push_back(terms_in_order(ts, roots));
    Shape shape(ts, terms_.back());
    for (const std::size_t target : parts[i]) shape.add_target(targets[target]);
    const auto [entry, is_new] = first.emplace(shape.take(), i);
    model_.push_back(entry->second);
    if (is_new) continue;
    const std::vector<ExprId>& of_model = terms_[entry->second];
    for (std::size_t t = 0; t < of_model.size(); ++t) {
      const Expr& e = ts.exprs[of_model[t]];
      if (e.op != ExprOp::Variable) continue;
      if (ts.vars[e.var].role == VarRole::State) continue;
      inputs_.emplace_back(e.var, ts.exprs[terms_[i][t]].var);
    }
  }
}

FoundRun AlikeParts::in_all(const FoundRun& run) const {
  FoundRun wide = run;
  std::unordered_map<VarId, std::size_t> column;
  for (std::size_t i = 0; i < run.inputs.size(); ++i) column[run.inputs[i]] = i;
  std::unordered_set<VarId> given(run.inputs.begin(), run.inputs.end());
  std::vector<std::size_t> copied;
  for (const auto& [of_model, of_part] : inputs_) {
    const auto found = column.find(of_model);
    if (found == column.end() || !given.insert(of_part).second) continue;
    wide.inputs.push_back(of_part);
    copied.push_back(found->second);
  }
  for (RunStep& step : wide.steps) {
    step.inputs.reserve(wide.inputs.size());
    for (const std::size_t i : copied) step.inputs.push_back(step.inputs[i]);
  }
  return wide;
}

Renaming::Renaming(TransitionSystem& ts, const std::vector<ExprId>& from,
                   const std::vector<ExprId>& to)
    : ts_(ts) {
  for (std::size_t i = 0; i < from.size(); ++i) terms_.emplace(from[i], to[i]);
}

/// Terms that engines made of the model's are made of the part's.
ExprId Renaming::term(ExprId of_model) {
  std::vector<ExprId> stack = {of_model};
  while (!stack.empty()) {
    const ExprId id = stack.back();
    const Expr e = ts_.exprs[id];
    const std::size_t waiting = stack.size();
    const Operands under = operands(e);
    for (std::uint32_t i = 0; terms_.count(id) == 0 && i < under.count; ++i) {
      if (terms_.count(under.ids[i]) == 0) stack.push_back(under.ids[i]);
    }
    if (stack.size() != waiting) continue;
    stack.pop_back();
    if (terms_.count(id) != 0) continue;
    // Variables that no target depends on are in no part.
    terms_.emplace(id, under.count == 0 ? id : over_known(e));
  }
  return known(of_model);
}

ExprId Renaming::over_known(const Expr& e) {
  const auto operand = [&](ExprId id) {
    return id.has_value() ? known(id) : id;
  };
  return rebuilt(ts_.exprs, e, operand(e.a), operand(e.b), operand(e.c));
}

VarId Renaming::variable(VarId of_model) const {
  const auto found = terms_.find(ts_.of(of_model));
  return found == terms_.end() ? of_model : ts_.exprs[found->second].var;
}

Invariant Renaming::invariant(const Invariant& of_model) {
  Invariant result;
  result.k = of_model.k;
  for (const ExprId condition : of_model.conditions) {
    result.conditions.push_back(term(condition));
  }
  for (LemmaClause lemma : of_model.lemmas) {
    for (LemmaAtom& atom : lemma) {
      if (atom.term.has_value()) {
        atom.term = term(atom.term);
      } else {
        atom.var = variable(atom.var);
      }
    }
    result.lemmas.push_back(std::move(lemma));
  }
  return result;
}

FoundRun Renaming::run(const FoundRun& of_model) const {
  FoundRun result = of_model;
  for (VarId& input : result.inputs) input = variable(input);
  return result;
}

}  // namespace rung
