#include <utility>

#include "frontend/plclib/values.h"

namespace rung::plclib {

/// The last bit of a word that is not negative; `word` is one name.
Value Arithmetic::odd(const Value& word) {
  const SourceRange where = word.where;
  const Value two = number(2, word.type, where);
  const Value half =
      join(AstOp::Divide, word, two, word.range, word.type, where);
  const Value even =
      join(AstOp::Multiply, half, two, word.range, word.type, where);
  Value result = join(AstOp::NotEqual, word, even, {0, 1}, CType::Bool, where);
  result.word = false;
  return result;
}

/// A word and a bit: only the last bit of the word is concerned.
Value Arithmetic::word_with_bit(std::string_view op, Value a, Value b,
                                SourceRange where) {
  const Value whole = kept(std::move(a), "value");
  const Value last = kept(odd(whole), "last");
  const Value bit = kept(truth(std::move(b)), "bit");
  const CType type = whole.type;
  if (op == "&") {
    Value both = conjunction(bit, last);
    both.type = type;
    return both;
  }
  const Value up = word(conjunction(bit, negation(last)));
  const Range range = {whole.range.low, whole.range.high | 1};
  if (op == "|") {
    return kept(join(AstOp::Add, whole, up, range, type, where), "value");
  }
  const Value down = word(conjunction(bit, last));
  const Range wide = {whole.range.low & ~std::int64_t{1}, whole.range.high | 1};
  if (op == "&~") {
    return kept(join(AstOp::Subtract, whole, down, {wide.low, whole.range.high},
                     type, where),
                "value");
  }
  return kept(
      join(AstOp::Subtract, join(AstOp::Add, whole, up, wide, type, where),
           down, wide, type, where),
      "value");
}

std::optional<Value> Arithmetic::bitwise(std::string_view op, Value a, Value b,
                                         CType type, SourceRange where) {
  if (a.is_bit() && b.is_bit()) {
    Value left = truth(std::move(a));
    Value right = truth(std::move(b));
    if (op == "&~") right = negation(std::move(right));
    Value result = op == "|"   ? disjunction(std::move(left), right)
                   : op == "^" ? join(AstOp::Xor, std::move(left), right,
                                      {0, 1}, type, where)
                               : conjunction(std::move(left), right);
    result.type = type;
    return result;
  }
  if (a.range.low < 0 || b.range.low < 0) {
    return refuse("a number that may be negative in `" + std::string(op) +
                  "` is not supported");
  }
  if (b.is_bit()) {
    return word_with_bit(op, word(std::move(a)), std::move(b), where);
  }
  if (a.is_bit() && op != "&~") {
    return word_with_bit(op, word(std::move(b)), std::move(a), where);
  }
  if (a.is_bit()) {
    const Value whole = kept(word(std::move(b)), "value");
    Value result = conjunction(truth(std::move(a)), negation(odd(whole)));
    result.type = type;
    return result;
  }
  return refuse("`" + std::string(op) +
                "` of two values of which neither is 0 or 1 is not supported");
}

}  // namespace rung::plclib
