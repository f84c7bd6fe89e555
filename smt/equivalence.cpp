#include "smt/equivalence.h"

#include <algorithm>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include "analysis/simulator.h"
#include "smt/certificate.h"
#include "smt/correspondence.h"
#include "smt/equal_states.h"
#include "smt/lockstep.h"
#include "smt/portfolio.h"
#include "smt/product.h"

namespace rung {
namespace {

enum class Side : std::uint8_t { First, Second };

/// The name that an input has in this program, or in the other one when only
/// that has it.
std::string_view name_of(const SignalPair& pair, const Program& a,
                         const Program& b, Side side) {
  const bool first =
      pair.a.has_value() && (side == Side::First || !pair.b.has_value());
  return first ? a.cells[pair.a].name : b.cells[pair.b].name;
}

/// The inputs of a product as one of its programs calls them.
class InputNames : public NameResolver {
 public:
  InputNames(const Program& a, const Program& b, const SharedSignals& shared,
             const TransitionSystem& ts, Side side) {
    for (const VarId id : ids_of(ts.vars)) {
      const Variable& variable = ts.vars[id];
      if (variable.role != VarRole::Input) continue;
      const SignalPair& pair = shared.inputs[variable.cell.index()];
      terms_.emplace(name_of(pair, a, b, side), variable.expr);
    }
  }
  ExprId resolve(std::string_view name) override {
    const auto found = terms_.find(name);
    return found == terms_.end() ? ExprId() : found->second;
  }

 private:
  std::unordered_map<std::string_view, ExprId> terms_;
};

/// The states of both sides as a relation calls them.
class RelationNames : public NameResolver {
 public:
  RelationNames(const TransitionSystem& a, const TransitionSystem& b,
                const Product& product)
      : product_(product), of_a_(by_name(a)), of_b_(by_name(b)) {}

  /// Does every name stand for a state?
  bool know(const StateRelation& relation) {
    names_.clear();
    for (const StateRelation::Name& name : relation.names) {
      const auto& states = name.second ? of_b_ : of_a_;
      const auto found = states.find(name.state);
      if (found == states.end()) return false;
      const auto& place = name.second ? product_.state_b : product_.state_a;
      names_[name.name] = product_.ts.state_expr(place[found->second]);
    }
    return true;
  }
  ExprId resolve(std::string_view name) override {
    return names_.at(std::string(name));
  }

 private:
  using ByName = std::unordered_map<std::string_view, std::uint32_t>;
  static ByName by_name(const TransitionSystem& ts) {
    ByName states;
    for (std::uint32_t i = 0; i < ts.states.size(); ++i) {
      states.emplace(ts.vars[ts.states[i].var].name, i);
    }
    return states;
  }

  const Product& product_;
  ByName of_a_;
  ByName of_b_;
  std::unordered_map<std::string, ExprId> names_;
};

class EquivalenceCheck {
 public:
  EquivalenceCheck(const Program& a, const Program& b,
                   const EquivalenceOptions& options, std::uint32_t delay)
      : a_(a),
        b_(b),
        options_(options),
        comparison_{delay, options.settled},
        deadline_(options.budget.seconds, options.budget.stop),
        shared_(share_signals(a, b, options.map)) {}

  EquivalenceResult run() {
    result_.error = shared_.error;
    if (result_.error.empty()) select_rungs();
    for (const std::string& text : options_.assumptions) {
      if (result_.error.empty()) check_assumption(text, Side::First);
    }
    for (const std::string& text : options_.assumptions_b) {
      if (result_.error.empty()) check_assumption(text, Side::Second);
    }
    if (!result_.error.empty()) return std::move(result_);
    for (const SignalPair& pair : shared_.outputs) {
      result_.outputs.push_back(a_.cells[pair.a].name);
    }
    result_.not_compared = shared_.alone;
    const auto [a, b] = with_common_caps(a_, b_);
    ts_a_ = build_transition_system(a);
    ts_b_ = build_transition_system(b);
    by_name_ = states_by_name(a, b, ts_a_, ts_b_, shared_);
    if (!equal_by_structure(by_name_)) decide_product();
    return std::move(result_);
  }

 private:
  /// Leaves the outputs that are asked for.
  void select_rungs() {
    const auto is_wanted = [&](const SignalPair& pair) {
      const auto& wanted = options_.rungs;
      return std::find(wanted.begin(), wanted.end(), a_.cells[pair.a].name) !=
             wanted.end();
    };
    for (const std::string& name : options_.rungs) {
      const bool known =
          std::any_of(shared_.outputs.begin(), shared_.outputs.end(),
                      [&](const SignalPair& pair) {
                        return a_.cells[pair.a].name == name;
                      });
      if (!known)
        result_.error = "no output in common is called `" + name + "`";
    }
    if (!options_.rungs.empty()) {
      std::erase_if(shared_.outputs,
                    [&](const SignalPair& pair) { return !is_wanted(pair); });
      shared_.alone.clear();
    }
  }

  void equivalent(std::string engine) {
    result_.delay = comparison_.delay;
    result_.verdict = EquivalenceVerdict::Equivalent;
    result_.engine = std::move(engine);
  }
  void unknown(std::string reason) {
    result_.verdict = EquivalenceVerdict::Unknown;
    result_.reason = std::move(reason);
  }
  void fail(const std::string& what) {
    unknown("self-check failed: " + what);
    result_.certificate.reset();
    result_.failures.push_back({"equivalence", what});
  }

  std::string lemma(const StatePair& pair) const {
    return "a." + ts_a_.vars[ts_a_.states[pair.a].var].name + " == b." +
           ts_b_.vars[ts_b_.states[pair.b].var].name;
  }

  // --- without a solver ------------------------------------------------------

  /// Checks what a proof takes from the structure; false when it failed.
  bool structure_is_right() {
    if (!options_.self_check) return true;
    const std::string wrong =
        check_correspondence({ts_a_, ts_b_, shared_}, structure_);
    if (!wrong.empty()) fail(wrong);
    return wrong.empty();
  }

  /// States that are shown equal on the way stay in proved_.
  bool equal_by_structure(const std::vector<StatePair>& guesses) {
    const TwoSystems systems{ts_a_, ts_b_, shared_};
    structure_ = correspond(systems, guesses);
    proved_.states = structure_.states;
    proved_.choices = shared_choices(systems, structure_.states);
    // Where one program leaves the range of the encoding, so does the other, in
    // the same scan, from equal operands of the same operator.
    const bool decided = structure_.outputs_equal && structure_.faults_equal;
    if (!decided || comparison_.delay > 0) return false;
    if (!structure_is_right()) return true;
    Certificate certificate;
    if (options_.self_check) certificate.checked_by.emplace_back("structure");
    for (const StatePair& pair : structure_.states) {
      certificate.lemmas.push_back(lemma(pair));
    }
    equivalent("structure");
    result_.certificate = std::move(certificate);
    return true;
  }

  // --- with one --------------------------------------------------------------

  Product product(const Merged& merged) const {
    Product made = make_product(ts_a_, ts_b_, shared_, merged, comparison_);
    assume(made.ts, options_.assumptions, Side::First);
    assume(made.ts, options_.assumptions_b, Side::Second);
    return made;
  }

  void assume(TransitionSystem& ts, const std::vector<std::string>& texts,
              Side side) const {
    InputNames names(a_, b_, shared_, ts, side);
    for (const std::string& text : texts) {
      const Formula formula = parse_formula(text);
      const ExprId term = compile_formula(ts.exprs, formula, names);
      std::vector<ExprId>& all = ts.constraints;  // both may say the same
      const bool known = std::find(all.begin(), all.end(), term) != all.end();
      if (!known) all.push_back(term);
    }
  }

  /// A term for each relation; `true` for one that speaks of no state.
  std::vector<ExprId> relations(Product& product) const {
    RelationNames names(ts_a_, ts_b_, product);
    std::vector<ExprId> terms;
    for (const StateRelation& relation : options_.relations) {
      const Formula formula = parse_formula(relation.formula);
      const bool known = formula.has_value() && names.know(relation);
      terms.push_back(known ? compile_formula(product.ts.exprs, formula, names)
                            : product.ts.exprs.bit(true));
    }
    return terms;
  }

  void decide_product() {
    const EqualGuesses guesses =
        guess_equal_states(ts_a_, ts_b_, product({}), by_name_);
    if (equal_by_structure(guesses.likely)) return;
    // What is equal by structure is checked as that, and is one from here on.
    Product whole = product(proved_);
    std::vector<StatePair> open = guesses.likely;
    open.insert(open.end(), guesses.more.begin(), guesses.more.end());
    Product reduced = product(proved_);
    // Numbers that stay in their range are proved with the states.
    const std::vector<ExprId> in_range = never_faults(reduced);
    reduced.same.insert(reduced.same.end(), in_range.begin(), in_range.end());
    const EqualStates equal =
        find_equal_states(reduced, open, relations(reduced), deadline_);
    Merged merged = proved_;
    merged.states.insert(merged.states.end(), equal.pairs.begin(),
                         equal.pairs.end());
    Invariant invariant;
    for (const StatePair& pair : equal.pairs) {
      const ExprId same =
          whole.ts.exprs.equal(whole.ts.state_expr(whole.state_a[pair.a]),
                               whole.ts.state_expr(whole.state_b[pair.b]));
      invariant.lemmas.push_back({{.term = same}});
    }
    const std::vector<ExprId> related = relations(whole);
    for (std::size_t i = 0; i < related.size(); ++i) {
      if (equal.lemma_holds[i] && !whole.ts.exprs.is_true(related[i])) {
        invariant.lemmas.push_back({{.term = related[i]}});
      }
    }
    if (equal.all_outputs && whole.ts.constraints.empty()) {
      invariant.conditions = whole.same;
      const std::vector<ExprId> never = never_faults(whole);
      invariant.conditions.insert(invariant.conditions.end(), never.begin(),
                                  never.end());
      certify(whole, invariant, "register correspondence");
      return;
    }
    decide_rest(whole, merged, invariant);
  }

  void check_assumption(const std::string& text, Side side) {
    const Formula formula = parse_formula(text);
    if (!formula.has_value()) {
      result_.error = "the assumption `" + text + "` is no formula";
      return;
    }
    std::unordered_set<std::string_view> names;
    for (const SignalPair& pair : shared_.inputs) {
      names.insert(name_of(pair, a_, b_, side));
    }
    for (const FormulaNode& node : formula.nodes) {
      if (node.op == FormulaOp::Call ||
          (node.op == FormulaOp::Name && names.count(node.text) == 0)) {
        result_.error = "the assumption `" + text + "` speaks of `" +
                        std::string(node.text) +
                        "`, which is no input of the programs";
        return;
      }
    }
  }

  /// Negations of the faults that may touch what is compared.
  static std::vector<ExprId> never_faults(Product& product) {
    std::vector<ExprId> never;
    const std::vector<bool> in_cone =
        cone_of_influence(product.ts, product.same);
    for (const Fault& fault : product.ts.faults) {
      if (touches(product.ts, fault.condition, in_cone)) {
        never.push_back(product.ts.exprs.negation(fault.condition));
      }
    }
    return never;
  }

  static bool touches(const TransitionSystem& ts, ExprId root,
                      const std::vector<bool>& variables) {
    std::unordered_set<ExprId> seen;
    std::vector<ExprId> open = {root};
    while (!open.empty()) {
      const ExprId id = open.back();
      open.pop_back();
      if (!seen.insert(id).second) continue;
      const Expr& e = ts.exprs[id];
      if (e.op == ExprOp::Variable && variables[e.var.index()]) return true;
      for (const ExprId operand : {e.a, e.b, e.c}) {
        if (operand.has_value()) open.push_back(operand);
      }
    }
    return false;
  }

  /// The engines, on the product in which equal states are one.
  void decide_rest(Product& whole, const Merged& merged, Invariant& invariant) {
    Product reduced = product(merged);
    std::vector<Target> targets;
    targets.reserve(reduced.same.size() + reduced.ts.faults.size() + 1);
    for (const ExprId same : reduced.same) {
      targets.push_back({.term = reduced.ts.exprs.negation(same),
                         .never = same,
                         .purpose = Target::Purpose::Violation});
    }
    const std::size_t outputs = targets.size();
    for (const ExprId never : never_faults(reduced)) {
      targets.push_back({.term = reduced.ts.exprs.negation(never),
                         .never = never,
                         .purpose = Target::Purpose::Fault});
    }
    if (!reduced.ts.constraints.empty()) {
      // Some scan is allowed: else nothing was compared.
      targets.push_back({.term = reduced.ts.exprs.bit(true),
                         .never = reduced.ts.exprs.bit(false),
                         .purpose = Target::Purpose::Trigger});
    }
    const std::vector<ExprId> growth = growth_terms(reduced.ts);
    std::vector<Target*> all;
    all.reserve(targets.size());
    for (Target& target : targets) all.push_back(&target);
    Portfolio portfolio(reduced.ts, growth, std::move(all),
                        {{}, options_.budget.max_depth, &deadline_});
    portfolio.run();
    if (portfolio.cone().circuit().overflow()) {
      return unknown("a number in it has no bound that fits 62 bits");
    }
    const auto reached = std::find_if(
        targets.begin(), targets.begin() + static_cast<std::ptrdiff_t>(outputs),
        [](const Target& t) { return t.status == Target::Status::Reached; });
    if (reached != targets.begin() + static_cast<std::ptrdiff_t>(outputs)) {
      for (std::size_t i = 0; i < outputs; ++i) {
        if (targets[i].status != Target::Status::Reached) continue;
        result_.also_different.push_back(result_.outputs[i]);
      }
      return different(reduced, *reached);
    }
    conclude(whole, reduced, portfolio.invariant(), targets, outputs,
             invariant);
  }

  void conclude(Product& whole, const Product& reduced, const Invariant& found,
                const std::vector<Target>& targets, std::size_t outputs,
                Invariant& invariant) {
    std::string engine = "register correspondence";
    for (std::size_t i = 0; i < targets.size(); ++i) {
      const Target& target = targets[i];
      if (target.purpose == Target::Purpose::Trigger) {
        if (target.status == Target::Status::Unreachable) {
          return unknown("no inputs meet the assumptions");
        }
        continue;
      }
      if (target.status == Target::Status::Unreachable) {
        if (target.engine != "structural") engine = target.engine;
        continue;
      }
      if (i >= outputs) return unknown("a number may leave its range");
      return bounded(targets, outputs);
    }
    const Invariant rest = widen_invariant(reduced, found, whole);
    invariant.k = rest.k;
    invariant.lemmas.insert(invariant.lemmas.end(), rest.lemmas.begin(),
                            rest.lemmas.end());
    invariant.conditions = whole.same;
    const std::vector<ExprId> never = never_faults(whole);
    invariant.conditions.insert(invariant.conditions.end(), never.begin(),
                                never.end());
    certify(whole, invariant, engine);
  }

  void bounded(const std::vector<Target>& targets, std::size_t outputs) {
    std::uint32_t bound = ~std::uint32_t{0};
    for (std::size_t i = 0; i < outputs; ++i) {
      if (targets[i].status != Target::Status::Open) continue;
      bound = std::min(bound, targets[i].bound);
    }
    unknown("no difference within " + std::to_string(bound) +
            " steps, and no proof that there is none");
    result_.engine = "bmc";
    if (bound > 0) result_.verdict = EquivalenceVerdict::Bounded;
  }

  void certify(const Product& whole, const Invariant& invariant,
               std::string engine) {
    Certificate certificate;
    certificate.k = invariant.k;
    for (const StatePair& pair : proved_.states) {
      certificate.lemmas.push_back(lemma(pair));
    }
    for (const LemmaClause& clause : invariant.lemmas) {
      certificate.lemmas.push_back(to_string(whole.ts, clause));
    }
    if (!structure_is_right()) return;
    if (options_.self_check) {
      CertificateSession session;
      const CertificateReport report =
          session.check(whole.ts, invariant, whole.same,
                        {options_.budget.seconds, options_.recheck,
                         options_.smtlib_directory, "equivalence"});
      if (report.outcome == CertificateOutcome::Rejected) {
        return fail("certificate rejected: " + report.what);
      }
      if (report.outcome == CertificateOutcome::Undecided) {
        return unknown("the certificate could not be checked: " + report.what);
      }
      certificate.checked_by = report.checked_by;
      if (!proved_.states.empty()) {
        certificate.checked_by.insert(certificate.checked_by.begin(),
                                      "structure");
      }
      certificate.smtlib_path = report.smtlib_path;
    }
    equivalent(std::move(engine));
    result_.certificate = std::move(certificate);
  }

  void different(const Product& reduced, const Target& target) {
    const Stimulus stimulus = to_stimulus(reduced.ts, target.run);
    LockStep run = run_lockstep(a_, b_, shared_, stimulus, comparison_);
    if (!run.differs) {
      for (const Variable& variable : reduced.ts.vars) {
        if (variable.role != VarRole::Choice) continue;
        return unknown(
            "the only run found leaves the range in which a counter is exact");
      }
      return fail("engine " + std::string(target.engine) +
                  " found a difference; the simulators agree on that run");
    }
    result_.verdict = EquivalenceVerdict::Different;
    result_.engine = target.engine;
    result_.differs = std::move(run.output);
    std::erase(result_.also_different, result_.differs);
    split_where_cells_change(a_, b_, run);
    result_.trace_a = simulate(a_, run.stimulus_a);
    result_.trace_b = simulate(b_, run.stimulus_b);
    result_.stimulus_a = std::move(run.stimulus_a);
    result_.stimulus_b = std::move(run.stimulus_b);
  }

  const Program& a_;
  const Program& b_;
  const EquivalenceOptions& options_;
  const Comparison comparison_;
  Deadline deadline_;
  SharedSignals shared_;
  TransitionSystem ts_a_;
  TransitionSystem ts_b_;
  std::vector<StatePair> by_name_;
  Correspondence structure_;  // checked where a proof rests on it
  Merged proved_;             // its states and choices
  EquivalenceResult result_;
};

}  // namespace

EquivalenceResult check_equivalence(const Program& a, const Program& b,
                                    const EquivalenceOptions& options) {
  EquivalenceResult first = EquivalenceCheck(a, b, options, 0).run();
  bool undecided = false;
  for (std::uint32_t delay = 1; delay <= options.delay; ++delay) {
    if (first.verdict == EquivalenceVerdict::Equivalent) break;
    if (!first.error.empty() || !first.failures.empty()) break;
    EquivalenceResult later = EquivalenceCheck(a, b, options, delay).run();
    const bool equal = later.verdict == EquivalenceVerdict::Equivalent;
    if (equal || !later.failures.empty()) return later;
    undecided = undecided || later.verdict != EquivalenceVerdict::Different;
  }
  if (first.verdict == EquivalenceVerdict::Different && undecided) {
    first.verdict = EquivalenceVerdict::Unknown;
    first.reason = "different in the same scan, and undecided with a delay";
  }
  return first;
}

}  // namespace rung
