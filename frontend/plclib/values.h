#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "frontend/statements.h"

namespace rung::plclib {

/// The arithmetic types of sketches.
enum class CType : std::uint8_t {
  Void,
  Bool,
  Char,
  Byte,
  Int,
  Unsigned,
  Long,
  UnsignedLong,
};
std::string_view to_string(CType type);
inline bool is_unsigned(CType type) {
  return type == CType::Unsigned || type == CType::UnsignedLong;
}

struct Range {
  std::int64_t low = 0;
  std::int64_t high = 0;
  bool contains(Range other) const {
    return low <= other.low && other.high <= high;
  }
  void join(Range other) {
    low = std::min(low, other.low);
    high = std::max(high, other.high);
  }
  bool is_bit() const { return low >= 0 && high <= 1; }
};
/// `int_bits` is 16 on AVR boards and 32 on ARM boards.
Range range_of(CType type, int int_bits);

/// The value of an expression: a bit or a word of the program, and what C++
/// says of it.
struct Value {
  Expression nodes;
  bool word = false;
  Range range;
  CType type = CType::Int;
  SourceRange where;
  /// It may leave the range of its type: good for an assignment only.
  bool overflows = false;

  bool is_bit() const { return range.is_bit(); }
  std::optional<std::int64_t> constant() const {
    if (range.low != range.high) return std::nullopt;
    return range.low;
  }
};

/// A literal; no value when it is no integer or does not fit 32 bits.
struct Literal {
  std::int64_t value = 0;
  CType type = CType::Int;
};
std::optional<Literal> read_literal(std::string_view text, int int_bits);

/// Builds values. Where an operation is not exact there is no value, and
/// why() says what was wrong.
class Arithmetic {
 public:
  Arithmetic(StatementWriter& writer, int int_bits)
      : writer_(&writer), int_bits_(int_bits) {}

  int int_bits() const { return int_bits_; }

  Value number(std::int64_t value, CType type, SourceRange where);
  static Value cell(std::string_view name, bool word, Range range, CType type,
                    SourceRange where);
  static Value bit(Expression nodes, SourceRange where);

  /// The same value as a word, as the bit that it is, as `!= 0`, as `== 1`.
  Value word(Value value);
  Value as_bit(Value value);
  Value truth(Value value);
  Value is_one(Value value);

  static Value negation(Value a);
  static Value conjunction(Value a, const Value& b);
  static Value disjunction(Value a, const Value& b);

  /// An operator of C++ by its text, `?:` apart.
  std::optional<Value> unary(std::string_view op, Value a, SourceRange where);
  std::optional<Value> binary(std::string_view op, Value a, Value b,
                              SourceRange where);
  Value choose(Value condition, Value then, Value otherwise, SourceRange where);

  /// The value where it is an operand or is tested: inside its type.
  std::optional<Value> settled(Value value);

  /// What a variable of this type holds when it is given the value.
  std::optional<Value> converted(Value value, CType type);

  const std::string& why() const { return why_; }

  /// A cell that can stand in an expression twice.
  Value kept(Value value, std::string_view prefix);

 private:
  std::optional<Value> refuse(std::string why) {
    why_ = std::move(why);
    return std::nullopt;
  }
  CType common(CType a, CType b) const;
  std::optional<Value> arithmetic(std::string_view op, Value a, const Value& b,
                                  CType type, SourceRange where);
  std::optional<Value> divided(std::string_view op, Value a, const Value& b,
                               CType type, SourceRange where);
  Value quotient(Value a, std::int64_t divisor, CType type, SourceRange where);
  std::optional<Value> shifted(std::string_view op, Value a, const Value& b,
                               SourceRange where);
  std::optional<Value> compared(AstOp op, Value a, Value b, CType type,
                                SourceRange where);
  std::optional<Value> bitwise(std::string_view op, Value a, Value b,
                               CType type, SourceRange where);
  Value word_with_bit(std::string_view op, Value word, Value bit,
                      SourceRange where);
  Value odd(const Value& word);
  Value join(AstOp op, Value a, const Value& b, Range range, CType type,
             SourceRange where);
  Value wrapped(Value value, bool is_signed);

  StatementWriter* writer_;
  int int_bits_;
  std::string why_;
};

}  // namespace rung::plclib
