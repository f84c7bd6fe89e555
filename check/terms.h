#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

namespace rung::check {

/// The checker's own terms. It has no code in common with the engines, so it
/// has none of their terms either: a list, in which operands stand before the
/// terms that use them, equal terms are one, and nothing is rewritten but
/// constants.
enum class Op : std::uint8_t {
  Bit,     // value: 0 or 1
  Number,  // value
  State,   // value: which one; before the scan
  Input,   // value: which one; of the scan
  Not,
  And,
  Or,
  Xor,
  Equal,  // of numbers, as the next two
  Less,
  LessEqual,
  Add,
  Subtract,
  Multiply,
  Divide,  // by the number `value`, towards zero
  Wrap,    // to `value` bits, signed where that is negative
  Choose,  // a ? b : c
};

struct Term {
  Op op = Op::Bit;
  bool word = false;
  std::uint32_t a = 0;
  std::uint32_t b = 0;
  std::uint32_t c = 0;
  std::int64_t value = 0;
  /// Of a word: it is never outside, as far as its leaves are not.
  std::int64_t low = 0;
  std::int64_t high = 1;
  /// Bounds follow from the rest.
  bool operator==(const Term& other) const {
    return op == other.op && word == other.word && a == other.a &&
           b == other.b && c == other.c && value == other.value;
  }
};

class Terms;

/// A term with its list, so that formulas of elements read like formulas.
struct Value {
  Terms* terms = nullptr;
  std::uint32_t id = 0;
};

class Terms {
 public:
  /// Numbers beyond this are not exact in every tool that we read programs of.
  static constexpr std::int64_t kExact = std::int64_t{1} << 53;

  const Term& operator[](std::uint32_t id) const { return list_[id]; }
  std::size_t size() const { return list_.size(); }

  Value bit(bool value);
  Value number(std::int64_t value);
  Value leaf(Op op, bool word, std::int64_t index, std::int64_t low,
             std::int64_t high);
  /// Only before other terms are made of the leaf.
  void set_leaf_bounds(std::uint32_t leaf, std::int64_t low, std::int64_t high);
  Value make(Op op, bool word, Value a, Value b = {}, Value c = {},
             std::int64_t value = 0);

  /// Some number may leave +-kExact.
  bool is_inexact() const { return inexact_; }

 private:
  struct Hash {
    std::size_t operator()(const Term& term) const;
  };
  Value add(Term term);
  void set_bounds(Term& term) const;

  std::vector<Term> list_;
  std::unordered_map<Term, std::uint32_t, Hash> known_;
  bool inexact_ = false;
};

/// Calls `visit` with each operand's id.
template <class Visit>
void for_operands(const Term& term, Visit visit) {
  if (term.op < Op::Not) return;
  visit(term.a);
  const bool one =
      term.op == Op::Not || term.op == Op::Divide || term.op == Op::Wrap;
  if (!one) visit(term.b);
  if (term.op == Op::Choose) visit(term.c);
}

Value operator~(Value a);
Value operator&(Value a, Value b);
Value operator|(Value a, Value b);
Value operator^(Value a, Value b);
Value operator==(Value a, Value b);  // numbers or bits
Value operator<(Value a, Value b);
Value operator<=(Value a, Value b);
Value operator>(Value a, Value b);
Value operator>=(Value a, Value b);
Value operator+(Value a, Value b);
Value operator-(Value a, Value b);
Value operator*(Value a, Value b);
Value operator+(Value a, std::int64_t b);
Value operator-(Value a, std::int64_t b);
Value operator==(Value a, std::int64_t b);
Value operator<(Value a, std::int64_t b);
Value operator<=(Value a, std::int64_t b);
Value operator>(Value a, std::int64_t b);
Value operator>=(Value a, std::int64_t b);
Value choose(Value condition, Value then, Value otherwise);
Value choose(Value condition, std::int64_t then, Value otherwise);
Value smaller(Value a, Value b);

}  // namespace rung::check
