#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

#include "analysis/transition_system.h"
#include "smt/aig.h"
#include "smt/words.h"

namespace rung {

/// One scan of a transition system as a graph of gates: leaves are the bits of
/// the state before the scan, of its inputs and of dt. Every term is encoded
/// when first asked for, so only cones are paid for.
///
/// Widths: a word has the bits that its term's [low, high] needs and no more;
/// with all variables in their ranges nothing overflows. So whoever uses the
/// circuit must keep the leaves in range: see in_range().
class StepCircuit {
 public:
  explicit StepCircuit(const TransitionSystem& ts);

  const TransitionSystem& ts() const { return *ts_; }
  Aig& aig() { return aig_; }
  const Aig& aig() const { return aig_; }

  bool has(ExprId term) const { return is_done(term); }
  AigLit bit(ExprId term);
  const Word& word(ExprId term);  // of a bit term: one bit, no sign
  /// The leaves of a variable; a word's known sign is a constant.
  const Word& leaves(VarId var);
  /// The same, of a variable that was met.
  const Word& known(VarId var) const { return done(ts_->of(var)); }
  /// The state's value after the scan, as wide as leaves() of its variable.
  Word next(std::uint32_t state);
  /// The variables met so far, in the order of their first use.
  const std::vector<VarId>& variables() const { return variables_; }
  /// low <= x <= high, over the leaves of `var`.
  AigLit in_range(VarId var);

  /// Every term encoded so far, operands first.
  const std::vector<ExprId>& terms() const { return terms_; }

  struct Leaf {
    VarId var;  // no value: a gate or a constant
    std::uint32_t bit = 0;
  };
  Leaf leaf(std::uint32_t node) const {
    return node < leaf_.size() ? leaf_[node] : Leaf{};
  }

  /// A term was met whose bounds are saturated: no width is enough, and
  /// nothing that the circuit says may be used.
  bool overflow() const { return overflow_; }

 private:
  void encode(ExprId root);
  Word encode_one(const Expr& e);
  Word encode_word(const Expr& e);
  Word encode_variable(VarId var);
  bool is_done(ExprId id) const { return words_.count(id) != 0; }
  const Word& done(ExprId id) const { return words_.find(id)->second; }

  const TransitionSystem* ts_;
  Aig aig_;
  // By term. A map, because a circuit holds the cone of some properties of a
  // plant that may have a million terms.
  std::unordered_map<ExprId, Word> words_;
  std::vector<Leaf> leaf_;  // by node
  std::vector<VarId> variables_;
  std::vector<ExprId> terms_;
  std::vector<ExprId> stack_;
  bool overflow_ = false;
};

/// The operands of a term, in an array and their number: Ite has three.
struct Operands {
  ExprId ids[3];
  std::uint32_t count = 0;
};
Operands operands(const Expr& e);

}  // namespace rung
