// ExpressionBuilder, the way up: what the values are.

#include <algorithm>
#include <array>
#include <numeric>
#include <string>
#include <utility>

#include "analysis/build_program_expression.h"

namespace rung::build {
namespace {

using enum Value::Precision;

constexpr std::int64_t kMinInt16 = -32'768;
constexpr std::int64_t kMaxInt16 = 32'767;

Value bit_value(bool calls) {
  Value value;
  value.calls = calls;
  return value;
}

Value constant_value(const Fraction& number) {
  Value value;
  value.type = Type::Word;
  value.constant = true;
  value.low = number.numerator;
  value.high = number.numerator;
  value.denominator = number.denominator;
  const bool small =
      number.numerator <= kMaxExact && number.numerator >= -kMaxExact;
  // Else one rounding away from a double: the literal's, or the quotient's.
  value.precision =
      small && is_power_of_two(number.denominator) ? Exact : Rounded;
  return value;
}

Fraction fraction_of(const Value& value) {
  return {value.low, value.denominator};
}

}  // namespace

void ExpressionBuilder::error(std::string_view code, std::uint32_t node,
                              std::string message) {
  failed_ = true;
  errors_->error(code, ast_node(node).where, std::move(message));
}

void ExpressionBuilder::find_values() {
  const std::size_t count = end_ - begin_;
  values_.assign(count, Value{});
  call_index_.assign(count, 0);
  calls_.clear();
  for (std::uint32_t node = begin_; node < end_; ++node) {
    value(node) = value_of(node);
  }
}

Value ExpressionBuilder::value_of(std::uint32_t node) {
  switch (ast_node(node).op) {
    case AstOp::Name:
      return name_value(node);
    case AstOp::Number:
      return number_value(node);
    case AstOp::Bool: {
      Value truth;
      truth.constant = true;
      truth.low = truth.high = ast_node(node).text == "true" ? 1 : 0;
      return truth;
    }
    case AstOp::String:
      return {};
    case AstOp::Not:
      return bit_value(value(node - 1).calls);
    case AstOp::Negate:
      return negated(node);
    case AstOp::And:
    case AstOp::Or:
    case AstOp::Xor:
      return bit_value(value(left_of(node)).calls ||
                       value(right_of(node)).calls);
    case AstOp::Equal:
    case AstOp::NotEqual:
    case AstOp::Less:
    case AstOp::LessEqual:
    case AstOp::Greater:
    case AstOp::GreaterEqual:
      return comparison(node);
    case AstOp::Add:
    case AstOp::Subtract:
    case AstOp::Multiply:
    case AstOp::Divide:
      return arithmetic(node);
    case AstOp::Call:
      return call_value(node);
  }
  return {};
}

Value ExpressionBuilder::name_value(std::uint32_t node) const {
  const Symbol& symbol = names_->of_node(node);
  Value value;
  if (!symbol.cell.has_value()) {  // in an initial value: not a constant
    value.type = symbol.is_word ? Type::Word : Type::Bit;
    return value;
  }
  const Cell& cell = program_->cells[symbol.cell];
  value.type = cell.type;
  value.low = cell.low;
  value.high = cell.high;
  return value;
}

Value ExpressionBuilder::number_value(std::uint32_t node) {
  const auto number = parse_number(ast_node(node).text);
  if (number) return constant_value(*number);
  error("RP031", node,
        "the number " + std::string(ast_node(node).text.substr(0, 40)) +
            " has too many digits");
  return constant_value({});
}

/// Keeps a word within what the dialect computes exactly, or with wrapping.
Value ExpressionBuilder::bounded(std::uint32_t node, Wide low, Wide high,
                                 Value value) {
  value.wraps = is_yun() && (low < kMinInt16 || high > kMaxInt16);
  if (value.wraps) {
    low = kMinInt16;
    high = kMaxInt16;
  } else if (low < -kMaxExact || high > kMaxExact) {
    error("RP038", node,
          "the value may leave the integers that a Javascript number holds "
          "exactly (2^53)");
    low = high = 0;
  }
  value.type = Type::Word;
  value.low = static_cast<std::int64_t>(low);
  value.high = static_cast<std::int64_t>(high);
  return value;
}

Value ExpressionBuilder::negated(std::uint32_t node) {
  const Value& operand = value(node - 1);
  if (operand.constant) {
    Value result = constant_value(negate(fraction_of(operand)));
    result.precision = operand.precision;
    return result;
  }
  return bounded(node, -Wide{operand.high}, -Wide{operand.low}, operand);
}

Value ExpressionBuilder::arithmetic(std::uint32_t node) {
  const AstOp op = ast_node(node).op;
  const Value& left = value(left_of(node));
  const Value& right = value(right_of(node));
  if (op == AstOp::Divide && right.constant && right.low == 0) {
    error("RP032", node, "division by zero");
    return constant_value({});
  }
  if (left.constant && right.constant) return folded(node, left, right);
  for (const std::uint32_t operand : {left_of(node), right_of(node)}) {
    const Value& part = value(operand);
    if (is_yun() ? part.denominator == 1 : part.precision == Exact) continue;
    error("RP030", operand,
          is_yun() ? "the controller computes with whole numbers only"
                   : "this fraction is rounded before it is used further: it "
                     "can only be compared");
    return constant_value({});
  }
  if (op == AstOp::Multiply) return product(node, left, right);
  if (op == AstOp::Divide) return quotient(node, left, right);
  return sum(node, left, right);
}

/// Two constants. In the yun dialect whole numbers divide as in C.
Value ExpressionBuilder::folded(std::uint32_t node, const Value& left,
                                const Value& right) {
  const AstOp op = ast_node(node).op;
  const Fraction a = fraction_of(left);
  const Fraction b = fraction_of(right);
  const bool whole = is_yun() && a.is_whole() && b.is_whole();
  std::optional<Fraction> result;
  if (op == AstOp::Add) {
    result = add(a, b);
  } else if (op == AstOp::Subtract) {
    result = add(a, negate(b));
  } else if (op == AstOp::Multiply) {
    result = multiply(a, b);
  } else {
    result = whole ? Fraction{a.numerator / b.numerator, 1} : divide(a, b);
  }
  const bool fits = result && (!whole || (result->numerator >= kMinInt16 &&
                                          result->numerator <= kMaxInt16));
  if (!fits) {
    error("RP031", node,
          is_yun() ? "the constant does not fit the controller's 16-bit words"
                   : "the constant is too large or has too many digits");
    return constant_value({});
  }
  Value value = constant_value(*result);
  const bool exact = left.precision == Exact && right.precision == Exact;
  if (!exact) value.precision = Inexact;
  return value;
}

Value ExpressionBuilder::sum(std::uint32_t node, Value left, Value right) {
  const std::int64_t common = std::lcm(left.denominator, right.denominator);
  const Wide left_factor = common / left.denominator;
  const Wide right_factor = common / right.denominator;
  const Wide right_low = right.low * right_factor;
  const Wide right_high = right.high * right_factor;
  const bool add = ast_node(node).op == AstOp::Add;
  Value result;
  result.denominator = common;
  result.calls = left.calls || right.calls;
  return bounded(node, left.low * left_factor + (add ? right_low : -right_high),
                 left.high * left_factor + (add ? right_high : -right_low),
                 result);
}

Value ExpressionBuilder::product(std::uint32_t node, const Value& left,
                                 const Value& right) {
  const std::array<Wide, 4> corners = {
      Wide{left.low} * right.low, Wide{left.low} * right.high,
      Wide{left.high} * right.low, Wide{left.high} * right.high};
  const Wide denominator = Wide{left.denominator} * right.denominator;
  if (denominator > kMaxExact) {
    error("RP030", node, "the fraction has too many digits");
    return constant_value({});
  }
  Value result;
  result.denominator = static_cast<std::int64_t>(denominator);
  result.calls = left.calls || right.calls;
  return bounded(node, *std::min_element(corners.begin(), corners.end()),
                 *std::max_element(corners.begin(), corners.end()), result);
}

/// yun: truncates towards zero. sim: a fraction, one rounding from a double;
/// a negative divisor turns the bounds round.
Value ExpressionBuilder::quotient(std::uint32_t node, const Value& left,
                                  const Value& right) {
  if (!right.constant) {
    error("RP032", right_of(node), "the divisor must be a constant");
    return constant_value({});
  }
  Value result;
  result.calls = left.calls;
  if (is_yun()) {
    const Wide a = Wide{left.low} / right.low;
    const Wide b = Wide{left.high} / right.low;
    return bounded(node, std::min(a, b), std::max(a, b), result);
  }
  // (left / dl) / (r / dr) = left * factor / denominator
  const auto scale = divide({1, left.denominator}, fraction_of(right));
  if (!scale || scale->denominator > kMaxExact) {
    error("RP030", node, "the fraction has too many digits");
    return constant_value({});
  }
  result.denominator = scale->denominator;
  result.precision = is_power_of_two(result.denominator) ? Exact : Rounded;
  const Wide a = Wide{left.low} * scale->numerator;
  const Wide b = Wide{left.high} * scale->numerator;
  return bounded(node, std::min(a, b), std::max(a, b), result);
}

Value ExpressionBuilder::comparison(std::uint32_t node) {
  const Value& left = value(left_of(node));
  const Value& right = value(right_of(node));
  const bool strict = ast_node(node).text.size() == 3;
  if (strict && !is_yun()) {
    if (left.type != right.type) {
      error("RP036", node,
            "a bit and a number are never equal for `===`: write `==`");
    }
    strict_.push_back(ast_node(node).where);
  }
  return bit_value(left.calls || right.calls);
}

Value ExpressionBuilder::call_value(std::uint32_t node) {
  call_index_[node - begin_] = static_cast<std::uint32_t>(calls_.size());
  calls_.push_back(resolve_call(*ast_, node, *errors_));
  ResolvedCall& call = calls_.back();
  if (call.kind == ResolvedCall::Kind::Wrong) failed_ = true;
  if (call.kind == ResolvedCall::Kind::Element) check_element_call(call);
  bool calls = call.kind == ResolvedCall::Kind::Element;
  for (const std::uint32_t argument : call.arguments) {
    calls = calls || value(argument).calls;
  }
  return bit_value(calls);
}

ConstantArgument ExpressionBuilder::constant_argument(
    std::uint32_t node) const {
  if (!folds(node)) return std::nullopt;
  return fraction_of(value(node));
}

void ExpressionBuilder::check_element_call(ResolvedCall& call) {
  const ElementOperation& operation = *call.found.operation;
  for (std::size_t i = 0; i < call.arguments.size(); ++i) {
    const AstNode& node = ast_node(call.arguments[i]);
    const ConstantArgument constant = constant_argument(call.arguments[i]);
    switch (operation.parameters[i].kind) {
      case ParameterKind::Index:
        call.index = check_index(*ast_, node, *errors_);
        break;
      case ParameterKind::Seconds:
        call.parameter =
            check_seconds(node, constant, operation.rounding, *errors_);
        break;
      case ParameterKind::Count:
        call.parameter = check_count(*ast_, node, constant, *errors_);
        break;
      case ParameterKind::Bit:
      case ParameterKind::Word:
        break;
    }
  }
}

std::optional<Fraction> ExpressionBuilder::constant(
    const AstExpression& expression) {
  begin_ = expression.begin;
  end_ = expression.end;
  failed_ = false;
  find_values();
  const Value& result = value(expression.root());
  if (failed_ || !result.constant) return std::nullopt;
  return fraction_of(result);
}

}  // namespace rung::build
