#include "smt/smtlib.h"

#include <algorithm>
#include <cassert>
#include <map>
#include <unordered_map>
#include <utility>

#include "smt/smtlib_text.h"
#include "smt/term_order.h"

namespace rung {
namespace {

using smtlib::call;
using smtlib::chain;
using smtlib::number;

/// Deeper terms get a name of their own: the solvers' parsers recurse.
constexpr std::uint32_t kMaxNesting = 16;

class ScriptWriter {
 public:
  ScriptWriter(const TransitionSystem& ts, const Invariant& invariant)
      : ts_(ts), invariant_(invariant) {}

  CertificateScript write() {
    find_roots();
    find_cone();
    choose_names();
    name_claims();
    script_.k = invariant_.k;
    script_.constrained = !ts_.constraints.empty();
    script_.text = "(set-logic ";
    script_.text += nonlinear_ ? "QF_NIA)\n" : "QF_LIA)\n";
    declare("initial", "Bool");
    declare("hypothesis", "Bool");
    for (frame_ = 0; frame_ <= invariant_.k + 1; ++frame_) write_frame();
    write_queries();
    return std::move(script_);
  }

 private:
  /// A term of the cone. Operands stand before the terms that use them.
  struct Term {
    ExprId id;
    std::string symbol;         // of a variable and of a named term
    std::uint32_t uses = 0;     // places where its text would stand
    std::uint32_t nesting = 0;  // of its text
    bool named = false;         // a constant with an equation, not in place
    bool of_state = false;      // in a lemma: written in the last frame too
    std::string text;           // in the frame being written
  };

  const Expr& expr(ExprId id) const { return ts_.exprs[id]; }
  Term& term(ExprId id) { return terms_[index_.at(id.index())]; }
  const std::string& text(ExprId id) { return term(id).text; }
  std::string suffix() const { return "@" + std::to_string(frame_); }
  bool last() const { return frame_ == invariant_.k + 1; }

  void declare(const std::string& symbol, std::string_view sort) {
    script_.text += call("declare-const", symbol, sort) + "\n";
  }
  void require(const std::string& condition) {
    script_.text += call("assert", condition) + "\n";
  }
  void define(const std::string& symbol, std::string_view sort,
              const std::string& value) {
    declare(symbol, sort);
    require(call("=", symbol, value));
  }
  static std::string_view sort_of(Type type) {
    return type == Type::Bit ? "Bool" : "Int";
  }

  // --- what the certificate depends on ---------------------------------------

  void find_cone() {
    for (const ExprId id : terms_in_order(ts_, roots_)) {
      index_.emplace(id.index(), static_cast<std::uint32_t>(terms_.size()));
      terms_.push_back({.id = id});
      if (expr(id).op == ExprOp::Variable) add_variable(expr(id).var);
    }
  }

  void add_variable(VarId var) {
    const Variable& variable = ts_.vars[var];
    terms_.back().symbol = "v" + std::to_string(variables_.size());
    variables_.push_back(var);
    script_.names.push_back(variable.name);
    if (variable.role == VarRole::State) states_.push_back(variable.state);
  }

  void find_roots() {
    roots_ = invariant_.conditions;
    roots_.insert(roots_.end(), invariant_.consequences.begin(),
                  invariant_.consequences.end());
    roots_.insert(roots_.end(), ts_.constraints.begin(), ts_.constraints.end());
    for (const LemmaClause& lemma : invariant_.lemmas) {
      for (const LemmaAtom& atom : lemma) {
        roots_.push_back(term_of(atom));
        if (atom.term.has_value()) continue;
        std::uint32_t& bits = bits_[atom.var];
        bits = std::max(bits, atom.bit + 1);
      }
    }
  }

  ExprId term_of(const LemmaAtom& atom) const {
    return atom.term.has_value() ? atom.term : ts_.of(atom.var);
  }

  void choose_names() {
    for (const ExprId id : roots_) ++term(id).uses;
    for (const std::uint32_t state : states_) {
      ++term(ts_.states[state].next).uses;
    }
    for (const LemmaClause& lemma : invariant_.lemmas) {
      for (const LemmaAtom& atom : lemma) term(term_of(atom)).of_state = true;
    }
    for (std::size_t i = terms_.size(); i-- > 0;) count_uses(terms_[i]);
    for (Term& t : terms_) choose_name(t);
  }

  void count_uses(const Term& user) {
    const Expr& e = expr(user.id);
    if (user.of_state && e.op == ExprOp::Variable &&
        ts_.vars[e.var].role != VarRole::State) {
      // In the last frame it would have no value.
      script_.error =
          "a lemma names `" + ts_.vars[e.var].name + "`, which is no state";
    }
    nonlinear_ = nonlinear_ ||
                 (e.op == ExprOp::Multiply && !ts_.exprs.is_constant(e.a) &&
                  !ts_.exprs.is_constant(e.b));
    for (const ExprId id : {e.a, e.b, e.c}) {
      if (!id.has_value()) continue;
      Term& operand = term(id);
      operand.of_state = operand.of_state || user.of_state;
      // A negation is written in place, wherever it stands, and a quotient
      // has its operand three times.
      if (e.op == ExprOp::Not) {
        operand.uses += user.uses;
      } else {
        operand.uses += e.op == ExprOp::Divide ? 3 : 1;
      }
    }
  }

  void choose_name(Term& t) {
    const Expr& e = expr(t.id);
    for (const ExprId id : {e.a, e.b, e.c}) {
      if (!id.has_value() || term(id).named) continue;
      t.nesting = std::max(t.nesting, term(id).nesting + 1);
    }
    const bool compound = e.op != ExprOp::Constant &&
                          e.op != ExprOp::Variable && e.op != ExprOp::Not;
    t.named = compound && (t.uses > 1 || t.nesting >= kMaxNesting);
    if (t.named) t.symbol = "t" + std::to_string(named_++);
  }

  void name_claims() {
    const auto add = [this](ScriptClaim::Kind kind, std::size_t index,
                            std::string_view stem, std::size_t number) {
      script_.claims.push_back({kind, static_cast<std::uint32_t>(index),
                                std::string(stem) + std::to_string(number)});
    };
    for (const std::uint32_t state : states_) {
      if (ts_.vars[ts_.states[state].var].type != Type::Word) continue;
      add(ScriptClaim::Kind::Range, state, "range", script_.claims.size());
    }
    for (std::size_t i = 0; i < invariant_.lemmas.size(); ++i) {
      add(ScriptClaim::Kind::Lemma, i, "lemma", i);
    }
    for (std::size_t i = 0; i < invariant_.conditions.size(); ++i) {
      add(ScriptClaim::Kind::Condition, i, "condition", i);
    }
    for (std::size_t i = 0; i < invariant_.consequences.size(); ++i) {
      add(ScriptClaim::Kind::Consequence, i, "consequence", i);
    }
  }

  // --- one frame -------------------------------------------------------------

  /// A state and what is claimed of it; then, but for the last frame, the
  /// scan that starts there.
  void write_frame() {
    script_.text += last() ? "; the last state\n"
                           : "; scan " + std::to_string(frame_) + "\n";
    for (const VarId var : variables_) write_variable(var);
    write_terms();
    for (const ScriptClaim& claim : script_.claims) write_claim(claim);
    if (frame_ == 0) write_initial();
    if (last()) return;
    write_constraints();
  }

  void write_variable(VarId var) {
    const Variable& variable = ts_.vars[var];
    const bool state = variable.role == VarRole::State;
    if (last() && !state) return;
    Term& leaf = term(variable.expr);
    const std::string symbol = leaf.symbol + suffix();
    declare(symbol, sort_of(variable.type));
    if (state && frame_ > 0) {
      require(call("=", symbol, next_text_.at(variable.state)));
    }
    // A state's range is a claim; what comes from outside is assumed.
    if (!state && variable.type == Type::Word) {
      require(in_range(variable, symbol));
    }
    leaf.text = symbol;
    const auto bits = bits_.find(var);
    if (bits == bits_.end() || variable.type == Type::Bit) return;
    write_bits(var, symbol, bits->second);
  }

  static std::string in_range(const Variable& variable,
                              const std::string& symbol) {
    return call("<=", number(variable.low), symbol, number(variable.high));
  }

  std::string bit_symbol(VarId var, std::uint32_t bit) {
    if (ts_.vars[var].type == Type::Bit) return text(ts_.of(var));
    return "bit-" + term(ts_.of(var)).symbol + "." + std::to_string(bit) +
           suffix();
  }

  /// Bit i: floor(x / 2^i) is odd, which is how two's complement reads.
  void write_bits(VarId var, const std::string& symbol, std::uint32_t count) {
    std::string quotient = symbol;
    for (std::uint32_t i = 0; i < count; ++i) {
      const std::string bit = bit_symbol(var, i);
      const std::string half = "half-" + bit;
      define(half, "Int", call("div", quotient, "2"));
      define(bit, "Bool",
             call("not", call("=", quotient, call("*", "2", half))));
      quotient = half;
    }
  }

  void write_terms() {
    for (Term& t : terms_) {
      if (last() && !t.of_state) continue;
      if (expr(t.id).op == ExprOp::Variable) continue;
      t.text = written(expr(t.id));
      if (!t.named) continue;
      const std::string symbol = t.symbol + suffix();
      define(symbol, sort_of(expr(t.id).type), t.text);
      t.text = symbol;
    }
    if (last()) return;
    for (const std::uint32_t state : states_) {
      next_text_[state] = text(ts_.states[state].next);
    }
  }

  std::string written(const Expr& e) {
    static const std::string none;
    const auto operand = [&](ExprId id) -> const std::string& {
      return id.has_value() ? text(id) : none;
    };
    return smtlib::term(ts_.exprs, e, operand(e.a), operand(e.b), operand(e.c));
  }

  // --- claims ----------------------------------------------------------------

  void write_claim(const ScriptClaim& claim) {
    const bool condition = claim.kind == ScriptClaim::Kind::Condition;
    const bool consequence = claim.kind == ScriptClaim::Kind::Consequence;
    if (last() && (condition || consequence)) return;
    const std::string symbol = claim.symbol + suffix();
    define(symbol, "Bool", claim_text(claim));
    // Assumed in the states 0 .. k and the scans 0 .. k - 1.
    if (!consequence && frame_ < invariant_.k + (condition ? 0U : 1U)) {
      require(call("=>", "hypothesis", symbol));
    }
  }

  std::string claim_text(const ScriptClaim& claim) {
    switch (claim.kind) {
      case ScriptClaim::Kind::Lemma:
        return lemma_text(invariant_.lemmas[claim.index]);
      case ScriptClaim::Kind::Condition:
        return text(invariant_.conditions[claim.index]);
      case ScriptClaim::Kind::Consequence:
        return text(invariant_.consequences[claim.index]);
      case ScriptClaim::Kind::Range: {
        const VarId var = ts_.states[claim.index].var;
        return in_range(ts_.vars[var], text(ts_.of(var)));
      }
    }
    assert(false);
    return {};
  }

  std::string lemma_text(const LemmaClause& lemma) {
    std::vector<std::string> atoms;
    for (const LemmaAtom& atom : lemma) {
      std::string value = atom.term.has_value()
                              ? text(atom.term)
                              : bit_symbol(atom.var, atom.bit);
      atoms.push_back(atom.negated ? call("not", value) : std::move(value));
    }
    return chain("or", "false", atoms);
  }

  void write_initial() {
    for (const std::uint32_t index : states_) {
      const State& state = ts_.states[index];
      const std::string& symbol = text(ts_.of(state.var));
      if (ts_.vars[state.var].type == Type::Word) {
        require(call("=>", "initial", call("=", symbol, number(state.init))));
      } else {
        require(call("=>", "initial",
                     state.init != 0 ? symbol : call("not", symbol)));
      }
    }
  }

  void write_constraints() {
    if (ts_.constraints.empty()) return;
    declare("assumed" + suffix(), "Bool");
    for (const ExprId constraint : ts_.constraints) {
      require(call("=>", "assumed" + suffix(), text(constraint)));
    }
  }

  // --- queries ---------------------------------------------------------------

  /// Of the claims about states, or those about scans.
  void add_queries(ScriptQuery::Part part, std::uint32_t frame, bool scans) {
    for (std::uint32_t i = 0; i < script_.claims.size(); ++i) {
      const ScriptClaim& claim = script_.claims[i];
      const bool of_scan = claim.kind == ScriptClaim::Kind::Condition ||
                           claim.kind == ScriptClaim::Kind::Consequence;
      if (of_scan != scans) continue;
      script_.queries.push_back(
          {part, frame, i, claim.symbol + "@" + std::to_string(frame)});
    }
  }

  void write_queries() {
    using Part = ScriptQuery::Part;
    const std::uint32_t k = invariant_.k;
    for (std::uint32_t i = 0; i <= k; ++i) {
      add_queries(Part::Initiation, i, false);
      if (i < k) add_queries(Part::Initiation, i, true);
    }
    add_queries(Part::Consecution, k + 1, false);
    add_queries(Part::Safety, k, true);
  }

  const TransitionSystem& ts_;
  const Invariant& invariant_;
  CertificateScript script_;
  std::vector<ExprId> roots_;
  std::vector<Term> terms_;
  std::unordered_map<std::uint32_t, std::uint32_t> index_;  // in terms_
  std::vector<VarId> variables_;
  std::vector<std::uint32_t> states_;
  std::map<VarId, std::uint32_t> bits_;  // how many of a word's bits have names
  std::unordered_map<std::uint32_t, std::string> next_text_;  // by state
  std::uint32_t frame_ = 0;
  std::uint32_t named_ = 0;  // terms with a name
  bool nonlinear_ = false;
};

}  // namespace

std::string_view to_string(ScriptQuery::Part part) {
  switch (part) {
    case ScriptQuery::Part::Initiation:
      return "initiation";
    case ScriptQuery::Part::Consecution:
      return "consecution";
    case ScriptQuery::Part::Safety:
      return "safety";
  }
  return {};
}

CertificateScript make_certificate_script(const TransitionSystem& ts,
                                          const Invariant& invariant) {
  return ScriptWriter(ts, invariant).write();
}

std::vector<std::string> CertificateScript::assumptions(
    const ScriptQuery& query) const {
  std::vector<std::string> symbols;
  symbols.emplace_back(
      query.part == ScriptQuery::Part::Initiation ? "initial" : "hypothesis");
  if (!constrained) return symbols;
  // A run may end where no further scan keeps the constraints: a claim about a
  // state assumes them in the scans before it only.
  const bool condition =
      claims[query.claim].kind == ScriptClaim::Kind::Condition;
  const std::uint32_t scans = query.frame + (condition ? 1 : 0);
  for (std::uint32_t i = 0; i < scans; ++i) {
    symbols.push_back("assumed@" + std::to_string(i));
  }
  return symbols;
}

std::string CertificateScript::body() const {
  std::string result = text;
  const ScriptQuery* last = nullptr;
  for (const ScriptQuery& query : queries) {
    if (last == nullptr || last->part != query.part ||
        last->frame != query.frame) {
      result += "; " + std::string(to_string(query.part)) + ", frame " +
                std::to_string(query.frame) + "\n";
    }
    result += "(check-sat-assuming (";
    for (const std::string& symbol : assumptions(query)) result += symbol + " ";
    result += call("not", query.broken) + "))\n";
    last = &query;
  }
  return result;
}

std::string CertificateScript::file(const std::string& title) const {
  std::string result = "; " + smtlib::printable(title) +
                       "\n; k = " + std::to_string(k) +
                       "; every answer must be unsat\n";
  for (std::size_t i = 0; i < names.size(); ++i) {
    result += "; v" + std::to_string(i) + ": " + smtlib::printable(names[i]);
    result += '\n';
  }
  return result + body();
}

}  // namespace rung
