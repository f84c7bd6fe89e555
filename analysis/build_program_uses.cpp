// ExpressionBuilder, the way down: how each value is used.

#include <array>
#include <numeric>
#include <string>

#include "analysis/build_program_expression.h"

namespace rung::build {
namespace {

using enum Value::Precision;

constexpr std::int64_t kMinInt16 = -32'768;
constexpr std::int64_t kMaxInt16 = 32'767;

// Two different fractions a/b and c/d whose cross products are below this
// differ by more than their rounding to doubles, so that rounded values compare
// as the fractions do. Exact ones only have to fit the integers of a Program.
constexpr std::int64_t kMaxRoundedProduct = std::int64_t{1} << 50;
constexpr std::int64_t kMaxExactProduct = std::int64_t{1} << 58;

bool product_within(const Value& value, std::int64_t factor,
                    std::int64_t limit) {
  return Wide{value.low} * factor >= -Wide{limit} &&
         Wide{value.high} * factor <= Wide{limit};
}

}  // namespace

void ExpressionBuilder::find_uses(Type type) {
  uses_.assign(end_ - begin_, Use{});
  const std::uint32_t root = end_ - 1;
  use(root).as = type == Type::Bit ? Use::As::Bit : Use::As::Word;
  const Value& result = value(root);
  if (result.type != type) note_mixed(ast_node(root).where);
  if (type == Type::Word && !is_yun() &&
      (result.denominator != 1 || result.precision != Exact)) {
    error("RP030", root,
          "this may be a fraction, and cells hold whole numbers");
  }
  for (std::uint32_t node = end_; node-- > begin_;) {
    if (!use(node).skip) check_use(node);
    use_operands(node);
  }
}

void ExpressionBuilder::use_operands(std::uint32_t node) {
  const AstNode& ast = ast_node(node);
  if (use(node).skip || folds(node)) {
    for (std::uint32_t i = 0, at = node - 1; i < ast.arguments; ++i) {
      use(at).skip = true;
      at -= ast_node(at).size;
    }
    return;
  }
  switch (ast.op) {
    case AstOp::Name:
    case AstOp::Number:
    case AstOp::Bool:
    case AstOp::String:
      break;
    case AstOp::Not:
      use(node - 1).as = Use::As::Bit;
      use(node - 1).truth_only = true;
      break;
    case AstOp::And:
    case AstOp::Or:
    case AstOp::Xor:
      for (const std::uint32_t operand : {left_of(node), right_of(node)}) {
        use(operand).as = Use::As::Bit;
        use(operand).truth_only = use(node).truth_only;
      }
      if (program_->evaluation == Evaluation::ShortCircuit &&
          ast.op != AstOp::Xor && value(right_of(node)).calls) {
        use(left_of(node)).branch = node;
      }
      break;
    case AstOp::Equal:
    case AstOp::NotEqual:
    case AstOp::Less:
    case AstOp::LessEqual:
    case AstOp::Greater:
    case AstOp::GreaterEqual:
      use_comparison(node);
      break;
    case AstOp::Negate:
      use(node - 1).as = Use::As::Word;
      break;
    case AstOp::Add:
    case AstOp::Subtract:
    case AstOp::Multiply:
    case AstOp::Divide:
      use_arithmetic(node);
      break;
    case AstOp::Call:
      use_call(node);
      break;
  }
}

/// Words are brought to one denominator: a/b < c/d is a*d < c*b.
void ExpressionBuilder::use_comparison(std::uint32_t node) {
  const std::uint32_t left = left_of(node);
  const std::uint32_t right = right_of(node);
  const AstOp op = ast_node(node).op;
  const bool bits =
      value(left).type == Type::Bit && value(right).type == Type::Bit;
  if (bits && (op == AstOp::Equal || op == AstOp::NotEqual)) {
    use(left).as = use(right).as = Use::As::Bit;
    return;
  }
  use(left).as = use(right).as = Use::As::Word;
  if (is_yun()) return;
  const std::int64_t common =
      std::gcd(value(left).denominator, value(right).denominator);
  use(left).factor = value(right).denominator / common;
  use(right).factor = value(left).denominator / common;
  for (const std::uint32_t operand : {left, right}) {
    if (value(operand).precision != Inexact) continue;
    error("RP030", operand,
          "this fraction is rounded more than once, so comparing it is not "
          "exact");
    return;
  }
  const bool exact =
      value(left).precision == Exact && value(right).precision == Exact;
  const std::int64_t limit = exact ? kMaxExactProduct : kMaxRoundedProduct;
  if (product_within(value(left), use(left).factor, limit) &&
      product_within(value(right), use(right).factor, limit)) {
    return;
  }
  error("RP030", node,
        "the fractions have too many digits to be compared exactly");
}

void ExpressionBuilder::use_arithmetic(std::uint32_t node) {
  const std::uint32_t left = left_of(node);
  const std::uint32_t right = right_of(node);
  use(left).as = use(right).as = Use::As::Word;
  if (is_yun() || ast_node(node).op == AstOp::Multiply) return;
  if (ast_node(node).op == AstOp::Divide) {
    // The division is in the denominator; what is left of it is a factor.
    const Fraction divisor = {value(right).low, value(right).denominator};
    const auto scale = divide({1, value(left).denominator}, divisor);
    use(left).factor = scale ? scale->numerator : 1;
    use(right).skip = true;
    return;
  }
  const std::int64_t common = value(node).denominator;
  use(left).factor = common / value(left).denominator;
  use(right).factor = common / value(right).denominator;
}

void ExpressionBuilder::use_call(std::uint32_t node) {
  const ResolvedCall& call = call_of(node);
  const auto& arguments = call.arguments;
  switch (call.kind) {
    case ResolvedCall::Kind::Wrong:
      for (const std::uint32_t argument : arguments) use(argument).skip = true;
      break;
    case ResolvedCall::Kind::Orn:
      for (const std::uint32_t argument : arguments) {
        use(argument).as = Use::As::Bit;
      }
      use(arguments[1]).suffix = Use::Suffix::OrnOr;
      use(arguments[2]).suffix = Use::Suffix::OrnNot;
      break;
    case ResolvedCall::Kind::Cmp:
      use(arguments[0]).as = use(arguments[2]).as = Use::As::Word;
      use(arguments[1]).skip = true;
      check_cmp_operator(arguments[1]);
      break;
    case ResolvedCall::Kind::Element:
      for (std::size_t i = 0; i < arguments.size(); ++i) {
        const bool bit =
            call.found.operation->parameters[i].kind == ParameterKind::Bit;
        use(arguments[i]).as = Use::As::Bit;
        use(arguments[i]).skip = !bit;
      }
      break;
  }
}

void ExpressionBuilder::check_cmp_operator(std::uint32_t node) {
  const AstNode& text = ast_node(node);
  if (text.op != AstOp::String) {
    error("RP034", node,
          "the operator of `Cmp` must be a text: \"=\", \"<\" or \">\"");
    return;
  }
  if (text.text == "=" || text.text == "<" || text.text == ">") return;
  errors_->report({.code = "RP033",
                   .severity = Severity::Warning,
                   .where = text.where,
                   .message = "`" + std::string(text.text.substr(0, 40)) +
                              "` is no operator of `Cmp`, which has \"=\", "
                              "\"<\" and \">\": the result is always false",
                   .labels = {}});
}

void ExpressionBuilder::check_use(std::uint32_t node) {
  if (ast_node(node).op == AstOp::String) {
    error("RP034", node, "a text has no value here: only `Cmp` takes one");
    return;
  }
  if (value(node).type == Type::Bit) return;
  if (use(node).as == Use::As::Bit) check_as_bit(node);
  if (is_yun()) check_controller_word(node);
}

/// In Javascript `a && b` and `a || b` have the value of an operand. Where a
/// number other than 0 or 1 would come out, `v == true` in a timer, and sums,
/// no longer see a bit.
void ExpressionBuilder::check_as_bit(std::uint32_t node) {
  const Value& number = value(node);
  if (is_yun()) return;
  const bool truth = use(node).truth_only && number.precision != Inexact;
  const bool is_bit =
      number.denominator == 1 && number.low >= 0 && number.high <= 1;
  if (truth) return;
  if (is_bit) {
    note_mixed(ast_node(node).where);
    return;
  }
  error("RP029", node,
        "a number stands where a bit is needed, and would be passed on as a "
        "number: compare it, as in `name != 0`");
}

void ExpressionBuilder::check_controller_word(std::uint32_t node) {
  const Value& word = value(node);
  if (word.denominator != 1) {
    error("RP030", node, "the controller computes with whole numbers only");
  } else if (word.low < kMinInt16 || word.high > kMaxInt16) {
    error("RP031", node,
          "the constant does not fit the controller's 16-bit words");
  }
}

void ExpressionBuilder::note_mixed(const SourceRange& where) {
  if (!mixed_.has_value()) mixed_ = where;
}

void ExpressionBuilder::finish() {
  if (!mixed_.has_value()) return;
  for (const SourceRange& where : strict_) {
    errors_->error("RP036", where,
                   "`===` tells 1 from `true`, and this program uses one for "
                   "the other: write `==`",
                   {{mixed_, "a number for a bit, or a bit for a number"}});
  }
}

}  // namespace rung::build
