#include "smt/smtlib_text.h"

#include <cassert>

namespace rung::smtlib {

std::string number(std::int64_t value) {
  if (value >= 0) return std::to_string(value);
  // Not -value: that has no value for the smallest number.
  return "(- " + std::to_string(0 - static_cast<std::uint64_t>(value)) + ")";
}

std::string call(std::string_view op, std::string_view a, std::string_view b,
                 std::string_view c) {
  std::string text = "(";
  text += op;
  for (const std::string_view operand : {a, b, c}) {
    if (operand.empty()) continue;
    text += ' ';
    text += operand;
  }
  text += ')';
  return text;
}

std::string chain(std::string_view op, std::string_view neutral,
                  const std::vector<std::string>& operands) {
  if (operands.empty()) return std::string(neutral);
  if (operands.size() == 1) return operands.front();
  std::string text = "(" + std::string(op);
  for (const std::string& operand : operands) text += "\n  " + operand;
  return text + ")";
}

std::string divided(const std::string& a, std::int64_t divisor) {
  assert(divisor != 0);
  const std::string by = number(divisor);
  const std::string up = call("-", call("div", call("-", a), by));
  return call("ite", call(">=", a, "0"), call("div", a, by), up);
}

std::string wrapped16(const std::string& a) {
  return "(- (mod (+ " + a + " 32768) 65536) 32768)";
}

std::string term(const ExprArena& exprs, const Expr& e, const std::string& a,
                 const std::string& b, const std::string& c) {
  switch (e.op) {
    case ExprOp::Constant:
      if (e.type == Type::Word) return number(e.value);
      return e.value != 0 ? "true" : "false";
    case ExprOp::Not:
      return call("not", a);
    case ExprOp::And:
      return call("and", a, b);
    case ExprOp::Xor:
      return call("xor", a, b);
    case ExprOp::Equal:
      return call("=", a, b);
    case ExprOp::Less:
      return call("<", a, b);
    case ExprOp::Add:
      return call("+", a, b);
    case ExprOp::Multiply:
      return call("*", a, b);
    case ExprOp::Divide:
      return divided(a, exprs[e.b].value);
    case ExprOp::Wrap16:
      return wrapped16(a);
    case ExprOp::Ite:
      return call("ite", a, b, c);
    case ExprOp::Variable:
      break;
  }
  assert(false);
  return {};
}

std::string printable(std::string text) {
  for (char& c : text) {
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = '?';
  }
  return text;
}

}  // namespace rung::smtlib
