#include "frontend/plclib/values.h"

#include <array>
#include <charconv>
#include <utility>

namespace rung::plclib {
namespace {

constexpr std::int64_t kWordMax = 2'147'483'647;
constexpr std::int64_t kWordMin = -kWordMax - 1;

struct Suffix {
  bool is_unsigned = false;
  bool is_long = false;
};

/// Cuts the suffix off; no value when it is none.
std::optional<Suffix> take_suffix(std::string_view& text) {
  Suffix suffix;
  while (!text.empty()) {
    const char c = text.back();
    if (c == 'u' || c == 'U') {
      if (suffix.is_unsigned) return std::nullopt;
      suffix.is_unsigned = true;
    } else if (c == 'l' || c == 'L') {
      suffix.is_long = true;
    } else {
      break;
    }
    text.remove_suffix(1);
  }
  return suffix;
}

int take_base(std::string_view& text) {
  if (text.starts_with("0x") || text.starts_with("0X")) {
    text.remove_prefix(2);
    return 16;
  }
  if (text.starts_with("0b") || text.starts_with("0B")) {
    text.remove_prefix(2);
    return 2;
  }
  return text.size() > 1 && text[0] == '0' ? 8 : 10;
}

}  // namespace

std::string_view to_string(CType type) {
  switch (type) {
    case CType::Void:
      return "void";
    case CType::Bool:
      return "bool";
    case CType::Char:
      return "char";
    case CType::Byte:
      return "byte";
    case CType::Int:
      return "int";
    case CType::Unsigned:
      return "unsigned int";
    case CType::Long:
      return "long";
    case CType::UnsignedLong:
      return "unsigned long";
  }
  return {};
}

Range range_of(CType type, int int_bits) {
  switch (type) {
    case CType::Void:
      return {0, 0};
    case CType::Bool:
      return {0, 1};
    case CType::Char:
      return {-128, 127};
    case CType::Byte:
      return {0, 255};
    case CType::Int:
      if (int_bits == 16) return {-32'768, 32'767};
      return {kWordMin, kWordMax};
    case CType::Unsigned:
      if (int_bits == 16) return {0, 65'535};
      return {0, kWordMax};
    case CType::Long:
      return {kWordMin, kWordMax};
    case CType::UnsignedLong:
      return {0, kWordMax};
  }
  return {};
}

std::optional<Literal> read_literal(std::string_view text, int int_bits) {
  const std::optional<Suffix> suffix = take_suffix(text);
  if (!suffix) return std::nullopt;
  const int base = take_base(text);
  std::int64_t value = 0;
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value, base);
  if (text.empty() || stop != end || error != std::errc() || value < 0 ||
      value > kWordMax) {
    return std::nullopt;
  }
  // The first type that holds it; `unsigned` ones only where the text is no
  // decimal number.
  const auto fits = [&](CType type) {
    return range_of(type, int_bits).contains({value, value});
  };
  CType type = suffix->is_unsigned ? CType::UnsignedLong : CType::Long;
  if (!suffix->is_long) {
    if (!suffix->is_unsigned && fits(CType::Int)) {
      type = CType::Int;
    } else if ((suffix->is_unsigned || base != 10) && fits(CType::Unsigned)) {
      type = CType::Unsigned;
    }
  }
  return Literal{value, type};
}

Value Arithmetic::number(std::int64_t value, CType type, SourceRange where) {
  Value result;
  push_leaf(result.nodes, AstOp::Number,
            writer_->keep_text(std::to_string(value)), where);
  result.word = true;
  result.range = {value, value};
  result.type = type;
  result.where = where;
  return result;
}

Value Arithmetic::cell(std::string_view name, bool word, Range range,
                       CType type, SourceRange where) {
  Value result;
  push_leaf(result.nodes, AstOp::Name, name, where);
  result.word = word;
  result.range = range;
  result.type = type;
  result.where = where;
  return result;
}

Value Arithmetic::bit(Expression nodes, SourceRange where) {
  Value result;
  result.nodes = std::move(nodes);
  result.range = {0, 1};
  result.where = where;
  return result;
}

Value Arithmetic::word(Value value) {
  if (value.word) return value;
  push_conversion(value.nodes, "to_word", value.where);
  value.word = true;
  return value;
}

Value Arithmetic::as_bit(Value value) { return truth(std::move(value)); }

Value Arithmetic::truth(Value value) {
  if (!value.word) return value;
  if (const auto constant = value.constant()) {
    value.nodes.clear();
    push_leaf(value.nodes, AstOp::Bool, *constant != 0 ? "true" : "false",
              value.where);
    value.range = {*constant != 0 ? 1 : 0, *constant != 0 ? 1 : 0};
  } else {
    push_conversion(value.nodes, "to_bit", value.where);
    value.range = {0, 1};
  }
  value.word = false;
  value.type = CType::Bool;
  return value;
}

Value Arithmetic::is_one(Value value) {
  if (value.is_bit()) return truth(std::move(value));
  const SourceRange where = value.where;
  push_all(value.nodes, number(1, CType::Int, where).nodes);
  push_binary(value.nodes, AstOp::Equal, where);
  return bit(std::move(value.nodes), where);
}

Value Arithmetic::negation(Value a) {
  push_unary(a.nodes, AstOp::Not, a.where);
  a.range = {1 - a.range.high, 1 - a.range.low};
  return a;
}

Value Arithmetic::conjunction(Value a, const Value& b) {
  push_all(a.nodes, b.nodes);
  push_binary(a.nodes, AstOp::And, a.where);
  a.range = {std::min(a.range.low, b.range.low),
             std::min(a.range.high, b.range.high)};
  return a;
}

Value Arithmetic::disjunction(Value a, const Value& b) {
  push_all(a.nodes, b.nodes);
  push_binary(a.nodes, AstOp::Or, a.where);
  a.range = {std::max(a.range.low, b.range.low),
             std::max(a.range.high, b.range.high)};
  return a;
}

Value Arithmetic::kept(Value value, std::string_view prefix) {
  if (value.nodes.size() == 1) return value;
  const CellShape shape = {value.word, value.word ? value.range.low : 0,
                           value.word ? value.range.high : 1};
  const std::string_view name =
      writer_->keep(prefix, shape, value.nodes, value.where);
  return cell(name, value.word, value.range, value.type, value.where);
}

Value Arithmetic::join(AstOp op, Value a, const Value& b, Range range,
                       CType type, SourceRange where) {
  push_all(a.nodes, b.nodes);
  push_binary(a.nodes, op, where);
  a.range = range;
  a.type = type;
  a.where = where;
  return a;
}

CType Arithmetic::common(CType a, CType b) const {
  using enum CType;
  if (a == UnsignedLong || b == UnsignedLong) return UnsignedLong;
  const bool some_unsigned = a == Unsigned || b == Unsigned;
  if (a == Long || b == Long) {
    // A long of 32 bits holds every unsigned int of 16, but not one of 32.
    return some_unsigned && int_bits_ == 32 ? UnsignedLong : Long;
  }
  return some_unsigned ? Unsigned : Int;
}

Value Arithmetic::wrapped(Value value, bool is_signed) {
  const SourceRange where = value.where;
  push_conversion(value.nodes, "wrap16", where);
  value.range = range_of(CType::Int, 16);
  value.type = CType::Int;
  value.overflows = false;
  if (is_signed) return value;
  // The same low 16 bits: 65536 more where they are negative.
  const Value low = kept(std::move(value), "wrapped");
  Value less = join(AstOp::Less, low, number(0, CType::Int, where), {0, 1},
                    CType::Bool, where);
  less.word = false;
  const Value more =
      join(AstOp::Multiply, word(std::move(less)),
           number(65'536, CType::Long, where), {0, 65'536}, CType::Long, where);
  Value sum = join(AstOp::Add, low, more, range_of(CType::Unsigned, 16),
                   CType::Unsigned, where);
  // The sum's own bounds are wider; a kept cell has those that are true.
  return kept(std::move(sum), "wrapped");
}

std::optional<Value> Arithmetic::settled(Value value) {
  if (!value.overflows) return value;
  if (value.type == CType::Unsigned && int_bits_ == 16) {
    return wrapped(std::move(value), false);
  }
  return refuse("this may leave the range of " +
                std::string(to_string(value.type)) +
                ": that is supported only where the result is assigned");
}

std::optional<Value> Arithmetic::unary(std::string_view op, Value a,
                                       SourceRange where) {
  std::optional<Value> operand = settled(std::move(a));
  if (!operand) return std::nullopt;
  if (op == "!") return negation(truth(std::move(*operand)));
  if (op == "+") return word(std::move(*operand));
  if (op != "-") return refuse("`" + std::string(op) + "` is not supported");
  const CType type = common(operand->type, CType::Int);
  if (const auto constant = operand->constant();
      constant && !is_unsigned(type)) {
    return number(-*constant, type, where);
  }
  return arithmetic("-", number(0, type, where), word(std::move(*operand)),
                    type, where);
}

std::optional<Value> Arithmetic::binary(std::string_view op, Value a, Value b,
                                        SourceRange where) {
  std::optional<Value> left = settled(std::move(a));
  std::optional<Value> right = settled(std::move(b));
  if (!left || !right) return std::nullopt;
  if (op == "&&") {
    return conjunction(truth(std::move(*left)), truth(std::move(*right)));
  }
  if (op == "||") {
    return disjunction(truth(std::move(*left)), truth(std::move(*right)));
  }
  const CType type = common(left->type, right->type);
  if (op == "<<" || op == ">>") {
    return shifted(op, word(std::move(*left)), *right, where);
  }
  if (op == "&" || op == "|" || op == "^" || op == "&~") {
    return bitwise(op, std::move(*left), std::move(*right), type, where);
  }
  struct Comparison {
    std::string_view text;
    AstOp op;
  };
  constexpr std::array<Comparison, 6> kComparisons = {
      {{"==", AstOp::Equal},
       {"!=", AstOp::NotEqual},
       {"<", AstOp::Less},
       {"<=", AstOp::LessEqual},
       {">", AstOp::Greater},
       {">=", AstOp::GreaterEqual}}};
  for (const Comparison& comparison : kComparisons) {
    if (comparison.text != op) continue;
    return compared(comparison.op, std::move(*left), std::move(*right), type,
                    where);
  }
  if (op == "/" || op == "%") {
    return divided(op, word(std::move(*left)), *right, type, where);
  }
  return arithmetic(op, word(std::move(*left)), word(std::move(*right)), type,
                    where);
}

std::optional<Value> Arithmetic::arithmetic(std::string_view op, Value a,
                                            const Value& b, CType type,
                                            SourceRange where) {
  if (is_unsigned(type) && (a.range.low < 0 || b.range.low < 0)) {
    return refuse("this mixes negative numbers with " +
                  std::string(to_string(type)));
  }
  AstOp kind = AstOp::Add;
  Range range = {a.range.low + b.range.low, a.range.high + b.range.high};
  if (op == "-") {
    kind = AstOp::Subtract;
    range = {a.range.low - b.range.high, a.range.high - b.range.low};
  } else if (op == "*") {
    kind = AstOp::Multiply;
    const std::array<std::int64_t, 4> corners = {
        a.range.low * b.range.low, a.range.low * b.range.high,
        a.range.high * b.range.low, a.range.high * b.range.high};
    range = {*std::min_element(corners.begin(), corners.end()),
             *std::max_element(corners.begin(), corners.end())};
  }
  const bool fits = range_of(type, int_bits_).contains(range);
  if (a.constant() && b.constant()) {
    if (fits) return number(range.low, type, where);
    if (int_bits_ == 16 && type == CType::Unsigned) {
      return number(range.low & 0xffff, type, where);
    }
    return refuse("this number is too large");
  }
  Value result = join(kind, std::move(a), b, range, type, where);
  result.overflows = !fits;
  return result;
}

std::optional<Value> Arithmetic::divided(std::string_view op, Value a,
                                         const Value& b, CType type,
                                         SourceRange where) {
  const auto divisor = b.constant();
  if (!divisor || *divisor <= 0) {
    return refuse("the divisor must be a constant greater than 0");
  }
  if (is_unsigned(type) && a.range.low < 0) {
    return refuse("this mixes negative numbers with " +
                  std::string(to_string(type)));
  }
  if (const auto constant = a.constant()) {
    return number(op == "/" ? *constant / *divisor : *constant % *divisor, type,
                  where);
  }
  if (op == "/") return quotient(std::move(a), *divisor, type, where);
  const Value whole = kept(std::move(a), "value");
  const Range multiples = {whole.range.low / *divisor * *divisor,
                           whole.range.high / *divisor * *divisor};
  const Value part =
      join(AstOp::Multiply, quotient(whole, *divisor, type, where),
           number(*divisor, type, where), multiples, type, where);
  const Range range = {whole.range.low < 0 ? 1 - *divisor : 0,
                       whole.range.high > 0 ? *divisor - 1 : 0};
  return kept(join(AstOp::Subtract, whole, part, range, type, where), "value");
}

Value Arithmetic::quotient(Value a, std::int64_t divisor, CType type,
                           SourceRange where) {
  const Range range = {a.range.low / divisor, a.range.high / divisor};
  return join(AstOp::Divide, std::move(a), number(divisor, type, where), range,
              type, where);
}

std::optional<Value> Arithmetic::shifted(std::string_view op, Value a,
                                         const Value& b, SourceRange where) {
  const auto count = b.constant();
  if (!count || *count < 0 || *count >= int_bits_ - 1) {
    return refuse("the width of a shift must be a small constant");
  }
  if (a.range.low < 0) return refuse("a negative number is shifted");
  const CType type = common(a.type, CType::Int);
  const Value factor = number(std::int64_t{1} << *count, type, where);
  if (op == ">>") return divided("/", std::move(a), factor, type, where);
  return arithmetic("*", std::move(a), factor, type, where);
}

std::optional<Value> Arithmetic::compared(AstOp op, Value a, Value b,
                                          CType type, SourceRange where) {
  if (is_unsigned(type) && (a.range.low < 0 || b.range.low < 0)) {
    return refuse(
        "this compares a number that may be negative with one that "
        "is " +
        std::string(to_string(type)));
  }
  const bool equality = op == AstOp::Equal || op == AstOp::NotEqual;
  if (equality && b.constant() && a.is_bit() && b.is_bit()) {
    Value bit = truth(std::move(a));
    const bool same = (op == AstOp::Equal) == (*b.constant() == 1);
    return same ? bit : negation(std::move(bit));
  }
  Value result = join(op, word(std::move(a)), word(std::move(b)), {0, 1},
                      CType::Bool, where);
  result.word = false;
  return result;
}

Value Arithmetic::choose(Value condition, Value then, Value otherwise,
                         SourceRange where) {
  const Value choice = kept(truth(std::move(condition)), "choice");
  const CType type = common(then.type, otherwise.type);
  if (!then.word && !otherwise.word) {
    Value result = disjunction(conjunction(choice, then),
                               conjunction(negation(choice), otherwise));
    result.range = {0, 1};
    result.type = type;
    return result;
  }
  Range range = then.range;
  range.join(otherwise.range);
  const auto part = [&](Value which, Value value) {
    Range with_zero = value.range;
    with_zero.join({0, 0});
    return join(AstOp::Multiply, word(std::move(which)), word(std::move(value)),
                with_zero, type, where);
  };
  Value sum = part(choice, std::move(then));
  return kept(
      join(AstOp::Add, std::move(sum),
           part(negation(choice), std::move(otherwise)), range, type, where),
      "chosen");
}

std::optional<Value> Arithmetic::converted(Value value, CType type) {
  if (type == CType::Bool) {
    std::optional<Value> settled_value = settled(std::move(value));
    if (!settled_value) return std::nullopt;
    return truth(std::move(*settled_value));
  }
  const Range whole = range_of(type, int_bits_);
  const bool fits = whole.contains(value.range);
  if (fits && !value.overflows) {
    value.type = type;
    return value;
  }
  if (int_bits_ == 16 && type == CType::Unsigned) {
    return wrapped(word(std::move(value)), false);
  }
  if (int_bits_ == 16 && type == CType::Int &&
      !(value.overflows && value.type == CType::Int)) {
    return wrapped(word(std::move(value)), true);
  }
  // The overflow of a signed sum is an error of the program: the cell's range
  // says so.
  const bool same = common(value.type, CType::Int) == type;
  if (!value.overflows || !same) {
    return refuse("this may leave the range of " +
                  std::string(to_string(type)));
  }
  value.range = whole;
  value.type = type;
  return value;
}

}  // namespace rung::plclib
