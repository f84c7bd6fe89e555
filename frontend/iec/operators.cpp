// Scope: what operators mean, by the types of their operands.

#include <array>
#include <utility>

#include "frontend/iec/scope.h"

namespace rung::iec {
namespace {

struct Row {
  std::string_view name;
  AstOp op;
};
// By Operator. Modulo is none of the tree's.
constexpr std::array<Row, 14> kOperators = {{{"AND", AstOp::And},
                                             {"OR", AstOp::Or},
                                             {"XOR", AstOp::Xor},
                                             {"EQ", AstOp::Equal},
                                             {"NE", AstOp::NotEqual},
                                             {"LT", AstOp::Less},
                                             {"LE", AstOp::LessEqual},
                                             {"GT", AstOp::Greater},
                                             {"GE", AstOp::GreaterEqual},
                                             {"ADD", AstOp::Add},
                                             {"SUB", AstOp::Subtract},
                                             {"MUL", AstOp::Multiply},
                                             {"DIV", AstOp::Divide},
                                             {"MOD", AstOp::Divide}}};

AstOp ast_op(Operator op) {
  return kOperators[static_cast<std::size_t>(op)].op;
}

bool is_logic(Operator op) { return op <= Operator::Xor; }
bool is_equality(Operator op) {
  return op == Operator::Equal || op == Operator::NotEqual;
}
bool is_comparison(Operator op) {
  return op >= Operator::Equal && op <= Operator::GreaterEqual;
}
bool divides(Operator op) {
  return op == Operator::Divide || op == Operator::Modulo;
}

/// The result of two constants; divisors are not 0.
std::int64_t folded(Operator op, std::int64_t a, std::int64_t b) {
  switch (op) {
    case Operator::And:
      return a & b;
    case Operator::Or:
      return a | b;
    case Operator::Xor:
      return a ^ b;
    case Operator::Equal:
      return a == b ? 1 : 0;
    case Operator::NotEqual:
      return a != b ? 1 : 0;
    case Operator::Less:
      return a < b ? 1 : 0;
    case Operator::LessEqual:
      return a <= b ? 1 : 0;
    case Operator::Greater:
      return a > b ? 1 : 0;
    case Operator::GreaterEqual:
      return a >= b ? 1 : 0;
    case Operator::Add:
      return a + b;
    case Operator::Subtract:
      return a - b;
    case Operator::Multiply:
      return a * b;
    case Operator::Divide:
      return a / b;
    case Operator::Modulo:
      return a % b;
  }
  return 0;
}

void append(Value& a, const Value& b) { push_all(a.nodes, b.nodes); }

}  // namespace

std::string_view to_string(Operator op) {
  return kOperators[static_cast<std::size_t>(op)].name;
}

Value Scope::bit(bool value, SourceRange where) {
  return number(value ? 1 : 0, kBool, where);
}

Value Scope::number(std::int64_t value, const Type& type, SourceRange where) {
  Value result{{}, &type, value, where};
  if (type.kind == Kind::Bool) {
    push_leaf(result.nodes, AstOp::Bool, value != 0 ? "true" : "false", where);
  } else {
    push_leaf(result.nodes, AstOp::Number,
              writer().keep_text(std::to_string(value)), where);
  }
  return result;
}

std::optional<Value> Scope::invert(Value a, SourceRange where) {
  if (a.type->kind != Kind::Bool) {
    fail("RP049", where,
         "NOT of " + std::string(a.type->name) + " is not supported");
    return std::nullopt;
  }
  // A literal stays what is written: `NOT TRUE`.
  push_unary(a.nodes, AstOp::Not, where);
  a.constant.reset();
  a.symbol = nullptr;
  a.where = where;
  return a;
}

std::optional<Value> Scope::negate(Value a, SourceRange where) {
  if (a.type->kind != Kind::Integer) {
    fail("RP049", where,
         "the negation of " + std::string(a.type->name) + " is not supported");
    return std::nullopt;
  }
  if (a.constant && a.type == &kLiteral) {
    return number(-*a.constant, kLiteral, where);
  }
  Value zero = number(0, *a.type, where);
  return binary(Operator::Subtract, std::move(zero), std::move(a), where);
}

std::optional<Value> Scope::convert(Value value, const Type& type,
                                    SourceRange where) {
  if (value.type == &type) return value;
  if (value.type == &kLiteral && value.constant && type.kind != Kind::Time) {
    if (type.holds(*value.constant)) {
      return number(*value.constant, type, value.where);
    }
    fail("RP043", value.where,
         std::to_string(*value.constant) + " is not in the range of " +
             std::string(type.name) + ", " + std::to_string(type.low) + ".." +
             std::to_string(type.high));
    return std::nullopt;
  }
  const bool integers =
      value.type->kind == Kind::Integer && type.kind == Kind::Integer;
  if (integers && type.holds(value.type->low) && type.holds(value.type->high)) {
    value.type = &type;
    return value;
  }
  fail("RP049", where,
       "a " + std::string(type.name) + " is expected here, and this is " +
           (value.type == &kLiteral ? "" : "a ") +
           std::string(value.type->name));
  return std::nullopt;
}

bool Scope::unify(Value& a, Value& b, std::string_view what,
                  SourceRange where) {
  if (a.type == b.type) return true;
  const bool integers =
      a.type->kind == Kind::Integer && b.type->kind == Kind::Integer;
  const bool literal = a.type == &kLiteral || b.type == &kLiteral;
  Value* smaller = nullptr;
  if (literal) {
    smaller = a.type == &kLiteral ? &a : &b;
  } else if (integers && b.type->holds(a.type->low) &&
             b.type->holds(a.type->high)) {
    smaller = &a;
  } else if (integers && a.type->holds(b.type->low) &&
             a.type->holds(b.type->high)) {
    smaller = &b;
  }
  if (smaller == nullptr) {
    fail("RP049", where,
         std::string(what) + " takes two of one type, and is given a " +
             std::string(a.type->name) + " and a " + std::string(b.type->name));
    return false;
  }
  const Type& type = smaller == &a ? *b.type : *a.type;
  std::optional<Value> same = convert(std::move(*smaller), type, where);
  if (!same) return false;
  *smaller = std::move(*same);
  return true;
}

bool Scope::check_operands(Operator op, const Value& a, const Value& b,
                           SourceRange where) {
  const Kind kind = a.type->kind;
  const bool fits = kind == Kind::Bool ? is_logic(op) || is_equality(op)
                    : is_logic(op)     ? false
                                   : is_comparison(op) || kind == Kind::Integer;
  if (!fits) {
    fail("RP049", where,
         std::string(to_string(op)) + " of two " + std::string(a.type->name) +
             " is not supported");
    return false;
  }
  if (divides(op) && (!b.constant || *b.constant == 0)) {
    fail("RP049", where,
         std::string(to_string(op)) +
             " takes a constant divisor other than 0: no other is supported");
    return false;
  }
  return true;
}

std::optional<Value> Scope::binary(Operator op, Value a, Value b,
                                   SourceRange where) {
  if (!unify(a, b, to_string(op), where)) return std::nullopt;
  if (!check_operands(op, a, b, where)) return std::nullopt;
  const Type& type = *a.type;
  if (&type == &kLiteral) {
    const std::int64_t value = folded(op, *a.constant, *b.constant);
    if (is_comparison(op)) return bit(value != 0, where);
    if (kLiteral.holds(value)) return number(value, kLiteral, where);
    fail("RP043", where, "this number has more than 32 bits");
    return std::nullopt;
  }
  if (type.kind == Kind::Bool) return logic(op, std::move(a), b, where);
  if (op == Operator::Modulo) {
    // a - b * (a / b): that is what DIV leaves.
    a = once(std::move(a), where);
    Value product = a;
    append(product, b);
    push_binary(product.nodes, AstOp::Divide, where);
    append(product, b);
    push_binary(product.nodes, AstOp::Multiply, where);
    append(a, product);
    push_binary(a.nodes, AstOp::Subtract, where);
  } else {
    append(a, b);
    push_binary(a.nodes, ast_op(op), where);
  }
  a.constant.reset();
  a.symbol = nullptr;
  a.where = where;
  if (is_comparison(op)) {
    a.type = &kBool;
  } else {
    push_conversion(a.nodes, type.wrap, where);
  }
  return a;
}

Value Scope::logic(Operator op, Value a, const Value& b, SourceRange where) {
  append(a, b);
  const bool equality = is_equality(op);
  push_binary(a.nodes, equality ? AstOp::Xor : ast_op(op), where);
  if (op == Operator::Equal) push_unary(a.nodes, AstOp::Not, where);
  a.constant.reset();
  a.symbol = nullptr;
  a.where = where;
  return a;
}

Value Scope::once(Value value, SourceRange where, std::string_view prefix) {
  if (value.nodes.size() == 1) return value;
  Value result{{}, value.type, {}, where};
  const std::string_view cell =
      writer().keep(prefix, value.type->shape(), value.nodes, where);
  push_leaf(result.nodes, AstOp::Name, cell, where);
  return result;
}

Value Scope::choose(Value g, const Value& then, const Value& otherwise,
                    SourceRange where) {
  if (g.constant) return *g.constant != 0 ? then : otherwise;
  g = once(std::move(g), where);
  const bool word = then.type->kind != Kind::Bool;
  Value result{{}, then.type, {}, where};
  const AstOp times = word ? AstOp::Multiply : AstOp::And;
  const auto side = [&](bool on, const Value& value) {
    push_all(result.nodes, g.nodes);
    if (!on) push_unary(result.nodes, AstOp::Not, where);
    if (word) push_conversion(result.nodes, "to_word", where);
    push_all(result.nodes, value.nodes);
    push_binary(result.nodes, times, where);
  };
  side(true, then);
  side(false, otherwise);
  push_binary(result.nodes, word ? AstOp::Add : AstOp::Or, where);
  return result;
}

}  // namespace rung::iec
