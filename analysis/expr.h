#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "analysis/program.h"
#include "base/id.h"

namespace rung {

using ExprId = Id<struct ExprTag>;
using VarId = Id<struct VarTag>;

/// Operators of the transition system's terms. Words are mathematical
/// integers; each term carries bounds of its value, so an encoding can choose
/// widths in which nothing overflows.
enum class ExprOp : std::uint8_t {
  Constant,  // value; bits are 0 and 1
  Variable,  // var
  Not,       // bit
  And,       // bits
  Xor,       // bits
  Equal,     // words
  Less,      // words, a < b
  Add,       // words
  Multiply,  // words
  Divide,    // word by a constant, truncating towards zero
  Wrap16,    // word to 16-bit signed
  Ite,       // bit ? b : c, both of one type
};
// Or, Implies, subtraction, >=, bit-to-word and so on are built from these.

struct Expr {
  ExprOp op = ExprOp::Constant;
  Type type = Type::Bit;
  ExprId a;
  ExprId b;
  ExprId c;
  VarId var;
  std::int64_t value = 0;
  std::int64_t low = 0;  // bounds of the value, from intervals
  std::int64_t high = 1;
};

/// Hash-consed terms: equal terms have equal ids, and operands have smaller
/// ids than the terms that use them, so every pass is a loop from 0 upwards.
///
/// Bounds that would leave 62 bits saturate at +-kUnbounded; `Wrap16` and
/// comparisons bring them back. A term with a saturated bound cannot be
/// encoded in fixed width: the transition system builder never makes one
/// (see TransitionSystem::faults).
class ExprArena {
 public:
  static constexpr std::int64_t kUnbounded = std::int64_t{1} << 61;

  ExprArena();

  const Expr& operator[](ExprId id) const { return exprs_[id.index()]; }
  std::size_t size() const { return exprs_.size(); }

  ExprId bit(bool value) const { return value ? true_ : false_; }
  ExprId word(std::int64_t value);
  ExprId variable(VarId var, Type type, std::int64_t low, std::int64_t high);

  ExprId negation(ExprId a);
  ExprId conjunction(ExprId a, ExprId b);
  ExprId disjunction(ExprId a, ExprId b);
  ExprId implication(ExprId a, ExprId b);
  ExprId exclusive_or(ExprId a, ExprId b);
  ExprId equivalence(ExprId a, ExprId b);
  ExprId conjunction(const std::vector<ExprId>& terms);
  ExprId disjunction(const std::vector<ExprId>& terms);

  ExprId equal(ExprId a, ExprId b);  // words or bits
  ExprId less(ExprId a, ExprId b);
  ExprId less_equal(ExprId a, ExprId b);
  ExprId add(ExprId a, ExprId b);
  ExprId subtract(ExprId a, ExprId b);
  ExprId negate(ExprId a);
  ExprId multiply(ExprId a, ExprId b);
  ExprId divide(ExprId a, std::int64_t divisor);  // divisor is not 0
  ExprId wrap16(ExprId a);
  /// To an integer of 8, 16 or 32 bits, two's complement; made of wrap16().
  ExprId wrap(ExprId a, std::int64_t bits, bool has_sign);
  ExprId to_word(ExprId bit);
  ExprId to_bit(ExprId word);
  ExprId minimum(ExprId a, ExprId b);
  ExprId ite(ExprId condition, ExprId then, ExprId otherwise);

  bool is_true(ExprId id) const { return id == true_; }
  bool is_false(ExprId id) const { return id == false_; }
  bool is_constant(ExprId id) const {
    return exprs_[id.index()].op == ExprOp::Constant;
  }

 private:
  ExprId intern(Expr expr);
  ExprId bit_ite(ExprId condition, ExprId then, ExprId otherwise);
  ExprId compare(ExprOp op, ExprId a, ExprId b);
  ExprId compare_whole(ExprOp op, ExprId a, ExprId b);
  bool is_minimum(const Expr& choice) const;
  bool is_number(ExprId id, std::int64_t value) const;
  ExprId wrap_signed(ExprId a, std::int64_t bits);
  ExprId chosen_sum(ExprId a, ExprId b);
  ExprId chosen_product(ExprId choice, ExprId other);
  void grow();

  std::vector<Expr> exprs_;
  std::vector<std::uint32_t> table_;  // open addressing; index + 1, 0 is empty
  ExprId true_;
  ExprId false_;
};

}  // namespace rung
