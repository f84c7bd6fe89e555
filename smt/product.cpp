#include "smt/product.h"

#include <algorithm>
#include <string>
#include <unordered_map>
#include <utility>

#include "analysis/rebuilt.h"

namespace rung {
namespace {

/// Adds the terms of one system to the product, variable for variable.
class Importer {
 public:
  Importer(const TransitionSystem& from, TransitionSystem& to)
      : from_(from), to_(to), variable_(from.vars.size()) {}

  void bind(VarId of, ExprId term) { variable_[of.index()] = term; }
  ExprId bound(VarId to) const { return variable_[to.index()]; }
  bool is_bound(VarId of) const { return variable_[of.index()].has_value(); }

  /// Operands have smaller ids: one pass.
  void import_terms() {
    terms_.reserve(from_.exprs.size());
    for (std::uint32_t i = 0; i < from_.exprs.size(); ++i) {
      terms_.push_back(build(from_.exprs[ExprId(i)]));
    }
  }
  ExprId operator[](ExprId id) const {
    return id.has_value() ? terms_[id.index()] : ExprId();
  }

 private:
  ExprId build(const Expr& e) {
    if (e.op == ExprOp::Variable) return variable_[e.var.index()];
    return rebuilt(to_.exprs, e, (*this)[e.a], (*this)[e.b], (*this)[e.c]);
  }

  const TransitionSystem& from_;
  TransitionSystem& to_;
  std::vector<ExprId> variable_;
  std::vector<ExprId> terms_;
};

class ProductBuilder {
 public:
  ProductBuilder(const TransitionSystem& a, const TransitionSystem& b,
                 const SharedSignals& shared)
      : a_(a), b_(b), shared_(shared), from_a_(a, ts()), from_b_(b, ts()) {}

  Product build(const Merged& merged, const Comparison& comparison) {
    ts().scan = a_.scan;
    ts().dt = ts().add_input("dt", VarRole::Dt, Type::Word, a_.scan.min_ms,
                             a_.scan.max_ms);
    from_a_.bind(a_.dt, ts().of(ts().dt));
    from_b_.bind(b_.dt, ts().of(ts().dt));
    share_inputs();
    product_.state_a = add_states(a_, "a.", from_a_);
    product_.state_b.assign(b_.states.size(), kNoState);
    for (const StatePair& pair : merged.states) {
      const std::uint32_t one = product_.state_a[pair.a];
      product_.state_b[pair.b] = one;
      from_b_.bind(b_.states[pair.b].var, ts().state_expr(one));
    }
    add_rest(b_, "b.", from_b_, product_.state_b);
    add_choices(a_, "a.", from_a_);
    share_choices(merged.choices);
    add_choices(b_, "b.", from_b_);
    from_a_.import_terms();
    from_b_.import_terms();
    finish_states(a_, from_a_, product_.state_a);
    finish_states(b_, from_b_, product_.state_b);
    add_faults(a_, from_a_);
    add_faults(b_, from_b_);
    const ExprId when = comparison.settled ? settled() : ts().exprs.bit(true);
    for (const SignalPair& pair : shared_.outputs) {
      const ExprId same = ts().exprs.equal(
          ago(pair.a, comparison.delay), from_b_[b_.cell_end[pair.b.index()]]);
      product_.same.push_back(ts().exprs.implication(when, same));
    }
    return std::move(product_);
  }

 private:
  static constexpr std::uint32_t kNoState = 0xffff'ffff;

  TransitionSystem& ts() { return product_.ts; }

  /// See Comparison::settled.
  ExprId settled() {
    ExprArena& exprs = ts().exprs;
    std::vector<ExprId> terms;
    for (const State& state : ts().states) {
      terms.push_back(exprs.equal(ts().of(state.var), state.next));
    }
    const std::uint32_t ran = add_history("ran", Type::Bit, 0, 1, 0);
    ts().states[ran].next = exprs.bit(true);
    terms.push_back(ts().state_expr(ran));
    std::vector<VarId> inputs;
    for (const VarId id : ids_of(ts().vars)) {
      if (ts().vars[id].role == VarRole::Input) inputs.push_back(id);
    }
    for (const VarId id : inputs) {
      const Variable input = ts().vars[id];
      const std::uint32_t before = add_history(
          input.name + ".before", input.type, input.low, input.high, input.low);
      ts().states[before].next = ts().of(id);
      terms.push_back(exprs.equal(ts().state_expr(before), ts().of(id)));
    }
    return exprs.conjunction(terms);
  }

  std::uint32_t add_history(const std::string& name, Type type,
                            std::int64_t low, std::int64_t high,
                            std::int64_t init) {
    product_.history.push_back(ts().add_state(name, type, low, high, init));
    return product_.history.back();
  }

  /// What a cell of the first program was at the end of an earlier scan.
  ExprId ago(CellId cell, std::uint32_t scans) {
    ExprId value = from_a_[a_.cell_end[cell.index()]];
    const VarId var = a_.exprs[a_.cell_begin[cell.index()]].var;
    const Variable& model = a_.vars[var];
    const auto state = std::find_if(
        a_.states.begin(), a_.states.end(),
        [&](const State& candidate) { return candidate.var == var; });
    for (std::uint32_t i = 1; i <= scans; ++i) {
      const std::uint32_t link =
          add_history("a." + model.name + ".ago" + std::to_string(i),
                      model.type, model.low, model.high, state->init);
      ts().states[link].next = value;
      value = ts().state_expr(link);
    }
    return value;
  }

  static std::unordered_map<CellId, VarId> inputs_of(
      const TransitionSystem& system) {
    std::unordered_map<CellId, VarId> inputs;
    for (const VarId id : ids_of(system.vars)) {
      if (system.vars[id].role != VarRole::Input) continue;
      inputs.emplace(system.vars[id].cell, id);
    }
    return inputs;
  }

  void share_inputs() {
    const auto inputs_a = inputs_of(a_);
    const auto inputs_b = inputs_of(b_);
    for (std::uint32_t i = 0; i < shared_.inputs.size(); ++i) {
      const SignalPair& pair = shared_.inputs[i];
      const bool first = pair.a.has_value();
      const VarId of = first ? inputs_a.at(pair.a) : inputs_b.at(pair.b);
      const Variable& model = (first ? a_ : b_).vars[of];
      std::string name = model.name;
      if (!first) name.insert(0, "b.");
      if (!pair.b.has_value()) name.insert(0, "a.");
      const VarId input =
          ts().add_input(std::move(name), VarRole::Input, model.type, model.low,
                         model.high, CellId(i));
      if (first) from_a_.bind(of, ts().of(input));
      if (pair.b.has_value()) {
        from_b_.bind(inputs_b.at(pair.b), ts().of(input));
      }
    }
  }

  std::vector<std::uint32_t> add_states(const TransitionSystem& from,
                                        const std::string& side,
                                        Importer& importer) {
    std::vector<std::uint32_t> states(from.states.size(), kNoState);
    add_rest(from, side, importer, states);
    return states;
  }

  void add_rest(const TransitionSystem& from, const std::string& side,
                Importer& importer, std::vector<std::uint32_t>& states) {
    for (std::size_t i = 0; i < from.states.size(); ++i) {
      if (states[i] != kNoState) continue;
      const State& state = from.states[i];
      const Variable& model = from.vars[state.var];
      states[i] = ts().add_state(side + model.name, model.type, model.low,
                                 model.high, state.init);
      importer.bind(state.var, ts().state_expr(states[i]));
    }
  }

  void share_choices(const std::vector<ChoicePair>& pairs) {
    for (const ChoicePair& pair : pairs) {
      from_b_.bind(pair.b, from_a_.bound(pair.a));
    }
  }

  void add_choices(const TransitionSystem& from, const std::string& side,
                   Importer& importer) {
    for (const VarId id : ids_of(from.vars)) {
      if (from.vars[id].role != VarRole::Choice) continue;
      if (importer.is_bound(id)) continue;
      const VarId choice = ts().add_input(side + from.vars[id].name,
                                          VarRole::Choice, Type::Bit, 0, 1);
      importer.bind(id, ts().of(choice));
    }
  }

  void finish_states(const TransitionSystem& from, const Importer& importer,
                     const std::vector<std::uint32_t>& states) {
    for (std::size_t i = 0; i < from.states.size(); ++i) {
      State& state = ts().states[states[i]];
      if (state.next.has_value()) continue;  // merged: the first one's
      const State& model = from.states[i];
      state.next = importer[model.next];
      state.clock = model.clock;
      state.running = importer[model.running];
      state.cap = model.cap;
    }
  }

  void add_faults(const TransitionSystem& from, const Importer& importer) {
    for (const Fault& fault : from.faults) {
      ts().faults.push_back({importer[fault.condition], {}, fault.where});
    }
  }

  Product product_;
  const TransitionSystem& a_;
  const TransitionSystem& b_;
  const SharedSignals& shared_;
  Importer from_a_;
  Importer from_b_;
};

}  // namespace

Product make_product(const TransitionSystem& a, const TransitionSystem& b,
                     const SharedSignals& shared, const Merged& merged,
                     const Comparison& comparison) {
  return ProductBuilder(a, b, shared).build(merged, comparison);
}

Invariant widen_invariant(const Product& reduced, const Invariant& invariant,
                          Product& whole) {
  std::vector<VarId> variable(reduced.ts.vars.size());
  const auto place = [&](const std::vector<std::uint32_t>& from,
                         const std::vector<std::uint32_t>& to) {
    for (std::size_t i = 0; i < from.size(); ++i) {
      VarId& var = variable[reduced.ts.states[from[i]].var.index()];
      if (!var.has_value()) var = whole.ts.states[to[i]].var;
    }
  };
  place(reduced.state_a, whole.state_a);
  place(reduced.state_b, whole.state_b);
  place(reduced.history, whole.history);
  Importer importer(reduced.ts, whole.ts);
  // Inputs are the same in both, but no lemma has one.
  for (const VarId id : ids_of(reduced.ts.vars)) {
    if (!variable[id.index()].has_value()) variable[id.index()] = whole.ts.dt;
    const VarId var = variable[id.index()];
    const bool same_type = whole.ts.vars[var].type == reduced.ts.vars[id].type;
    importer.bind(id, same_type ? whole.ts.of(var) : whole.ts.exprs.bit(false));
  }
  importer.import_terms();
  Invariant result;
  result.k = invariant.k;
  for (LemmaClause lemma : invariant.lemmas) {
    for (LemmaAtom& atom : lemma) {
      if (atom.term.has_value()) {
        atom.term = importer[atom.term];
      } else {
        atom.var = variable[atom.var.index()];
      }
    }
    result.lemmas.push_back(std::move(lemma));
  }
  return result;
}

}  // namespace rung
