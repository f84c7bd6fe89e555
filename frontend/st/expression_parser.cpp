#include "frontend/st/expression_parser.h"

#include <array>
#include <utility>

namespace rung::st {
namespace {

using iec::Operator;
using iec::TokenKind;
using iec::Value;

constexpr std::size_t kMaxDepth = 200;
constexpr int kUnary = 9;

struct Binary {
  Operator op;
  int precedence;
};

std::optional<Binary> symbol_operator(TokenKind kind) {
  switch (kind) {
    case TokenKind::And:
      return Binary{Operator::And, 3};
    case TokenKind::Equal:
      return Binary{Operator::Equal, 4};
    case TokenKind::NotEqual:
      return Binary{Operator::NotEqual, 4};
    case TokenKind::Less:
      return Binary{Operator::Less, 5};
    case TokenKind::LessEqual:
      return Binary{Operator::LessEqual, 5};
    case TokenKind::Greater:
      return Binary{Operator::Greater, 5};
    case TokenKind::GreaterEqual:
      return Binary{Operator::GreaterEqual, 5};
    case TokenKind::Plus:
      return Binary{Operator::Add, 6};
    case TokenKind::Minus:
      return Binary{Operator::Subtract, 6};
    case TokenKind::Times:
      return Binary{Operator::Multiply, 7};
    case TokenKind::Divide:
      return Binary{Operator::Divide, 7};
    default:
      return std::nullopt;
  }
}

std::optional<Binary> word_operator(std::string_view word) {
  if (word == "OR") return Binary{Operator::Or, 1};
  if (word == "XOR") return Binary{Operator::Xor, 2};
  if (word == "AND") return Binary{Operator::And, 3};
  if (word == "MOD") return Binary{Operator::Modulo, 7};
  return std::nullopt;
}

}  // namespace

void ExpressionParser::start() {
  values_.clear();
  pending_.clear();
  depth_ = 0;
}

std::optional<Value> ExpressionParser::expression() {
  start();
  Next next = Next::Operand;
  while (next != Next::End && next != Next::Error) next = step(next);
  if (next == Next::Error || !reduce(0)) return std::nullopt;
  return std::move(values_.back());
}

bool ExpressionParser::call(iec::Symbol& instance, SourceRange where) {
  start();
  Next next = open_call(instance.name, &instance, where);
  while (next != Next::End && next != Next::Error) next = step(next);
  return next == Next::End;
}

ExpressionParser::Next ExpressionParser::step(Next next) {
  cursor_.skip_line_ends();
  return next == Next::Operand ? operand() : after_operand();
}

ExpressionParser::Next ExpressionParser::fail(std::string_view code,
                                              SourceRange where,
                                              std::string message) {
  scope_.fail(code, where, std::move(message));
  return Next::Error;
}

ExpressionParser::Next ExpressionParser::push_value(
    std::optional<Value> value) {
  if (!value) return Next::Error;
  values_.push_back(std::move(*value));
  return Next::Operator;
}

ExpressionParser::Next ExpressionParser::operand() {
  has_value_ = true;
  const SourceRange where = cursor_.here();
  const std::string_view text = cursor_.text(cursor_.peek());
  switch (cursor_.peek().kind) {
    case TokenKind::Open:
      if (++depth_ > kMaxDepth) {
        return fail("RP047", where, "parentheses nest more than 200 deep");
      }
      pending_.push_back({.kind = Kind::Open, .where = where});
      cursor_.take();
      return Next::Operand;
    case TokenKind::Minus:
      pending_.push_back(
          {.kind = Kind::Minus, .precedence = kUnary, .where = where});
      cursor_.take();
      return Next::Operand;
    case TokenKind::Plus:
      cursor_.take();
      return Next::Operand;
    case TokenKind::Number:
    case TokenKind::Time:
      cursor_.take();
      return push_value(scope_.literal(text, where));
    case TokenKind::Real:
    case TokenKind::String:
      return fail("RP041", where,
                  quoted_excerpt(text) + ": " +
                      (cursor_.at(TokenKind::Real) ? "REAL" : "STRING") +
                      " is not supported");
    case TokenKind::Word:
      return word();
    case TokenKind::Address: {
      SourceRange whole;
      iec::Symbol* const symbol = variable(whole);
      if (symbol == nullptr) return Next::Error;
      return push_value(scope_.read(*symbol, whole));
    }
    default:
      return fail("RP047", where,
                  "expected an operand and found " + cursor_.shown());
  }
}

ExpressionParser::Next ExpressionParser::word() {
  const SourceRange where = cursor_.here();
  const std::string_view text = cursor_.text(cursor_.peek());
  const std::string word = cursor_.word();
  if (word == "TRUE" || word == "FALSE") {
    cursor_.take();
    return push_value(scope_.bit(word == "TRUE", where));
  }
  const bool open = cursor_.at(TokenKind::Open, 1);
  // `NOT(EN := ...)` is the function, `NOT (a)` the operator.
  const bool formal = open && cursor_.at(TokenKind::Word, 2) &&
                      cursor_.at(TokenKind::Assign, 3);
  if (word == "NOT" && !formal) {
    cursor_.take();
    pending_.push_back(
        {.kind = Kind::Not, .precedence = kUnary, .where = where});
    return Next::Operand;
  }
  if (open && scope_.find(text) == nullptr) {
    if (!scope_.is_function(text)) {
      return fail("RP041", where,
                  "there is no function " + quoted_excerpt(text) +
                      ", or it is not supported");
    }
    cursor_.take();
    return open_call(text, nullptr, where);
  }
  SourceRange whole;
  iec::Symbol* const symbol = variable(whole);
  if (symbol == nullptr) return Next::Error;
  return push_value(scope_.read(*symbol, whole));
}

iec::Symbol* ExpressionParser::variable(SourceRange& where) {
  where = cursor_.here();
  const bool address = cursor_.at(TokenKind::Address);
  if (!address && !cursor_.at(TokenKind::Word)) {
    scope_.fail("RP047", where,
                "expected a variable and found " + cursor_.shown());
    return nullptr;
  }
  iec::Symbol* symbol = scope_.get(cursor_.text(cursor_.take()), where);
  while (symbol != nullptr && cursor_.at(TokenKind::Dot) &&
         cursor_.at(TokenKind::Word, 1)) {
    cursor_.take();
    where.end = cursor_.here().end;
    symbol = scope_.member(*symbol, cursor_.text(cursor_.take()), where);
  }
  return symbol;
}

// --- calls -------------------------------------------------------------------

ExpressionParser::Next ExpressionParser::open_call(std::string_view name,
                                                   iec::Symbol* instance,
                                                   SourceRange where) {
  cursor_.skip_line_ends();
  if (++depth_ > kMaxDepth) {
    return fail("RP047", where, "parentheses nest more than 200 deep");
  }
  Pending call{.kind = Kind::Call, .where = where, .name = name};
  call.instance = instance;
  call.values = values_.size();
  pending_.push_back(std::move(call));
  cursor_.take();  // (
  cursor_.skip_line_ends();
  if (cursor_.at(TokenKind::Close)) {
    cursor_.take();
    return finish_call();
  }
  return argument();
}

/// The begin of an argument: its name, and `=>` with a variable.
ExpressionParser::Next ExpressionParser::argument() {
  cursor_.skip_line_ends();
  iec::Argument argument;
  argument.where = cursor_.here();
  has_value_ = false;
  const bool negated = cursor_.word() == "NOT" &&
                       cursor_.at(TokenKind::Word, 1) &&
                       cursor_.at(TokenKind::Arrow, 2);
  std::size_t ahead = negated ? 2 : 1;
  while (cursor_.at(TokenKind::LineEnd, ahead)) ++ahead;
  const bool named = cursor_.at(TokenKind::Word);
  const bool input = named && cursor_.at(TokenKind::Assign, ahead);
  const bool output = named && cursor_.at(TokenKind::Arrow, ahead);
  if (input || output) {
    if (negated) cursor_.take();
    argument.name = cursor_.word();
    while (!cursor_.at(TokenKind::Assign) && !cursor_.at(TokenKind::Arrow)) {
      cursor_.take();
    }
    cursor_.take();
  }
  argument.output = output;
  argument.negated = negated;
  pending_.back().arguments.push_back(std::move(argument));
  return output ? output_argument(negated) : Next::Operand;
}

ExpressionParser::Next ExpressionParser::output_argument(bool /*negated*/) {
  cursor_.skip_line_ends();
  iec::Argument& argument = pending_.back().arguments.back();
  argument.variable = variable(argument.where);
  return argument.variable == nullptr ? Next::Error : Next::Operator;
}

/// The argument's value, when it has one.
bool ExpressionParser::finish_argument() {
  iec::Argument& argument = pending_.back().arguments.back();
  if (argument.output) return true;
  argument.value = std::move(values_.back());
  values_.pop_back();
  return true;
}

/// Does nothing else of this expression have a value yet? A function's outputs
/// could change what was read.
bool ExpressionParser::is_alone(const Pending& call) const {
  if (call.values != 0) return false;
  for (const Pending& outer : pending_) {
    if (outer.kind == Kind::Call && outer.arguments.size() > 1) return false;
  }
  return true;
}

ExpressionParser::Next ExpressionParser::finish_call() {
  Pending call = std::move(pending_.back());
  pending_.pop_back();
  --depth_;
  if (call.instance != nullptr) {
    const bool good =
        scope_.call(*call.instance, std::move(call.arguments), call.where);
    return good ? Next::End : Next::Error;
  }
  const bool alone = is_alone(call);
  return push_value(
      scope_.function(call.name, std::move(call.arguments), call.where, alone));
}

ExpressionParser::Next ExpressionParser::after_operand() {
  const TokenKind kind = cursor_.peek().kind;
  if (kind == TokenKind::Close) return close();
  if (kind == TokenKind::Comma) return comma();
  if (kind == TokenKind::Power) {
    return fail("RP041", cursor_.here(), "`**` is not supported");
  }
  const auto binary = kind == TokenKind::Word ? word_operator(cursor_.word())
                                              : symbol_operator(kind);
  if (!binary) {
    if (depth_ == 0) return Next::End;
    return fail("RP047", cursor_.here(),
                "expected `)` and found " + cursor_.shown());
  }
  const bool output = !pending_.empty() && pending_.back().kind == Kind::Call &&
                      pending_.back().arguments.back().output;
  if (output) {
    return fail("RP047", cursor_.here(),
                "expected `,` or `)` and found " + cursor_.shown());
  }
  if (!reduce(binary->precedence)) return Next::Error;
  pending_.push_back({.kind = Kind::Binary,
                      .op = binary->op,
                      .precedence = binary->precedence,
                      .where = cursor_.here()});
  cursor_.take();
  return Next::Operand;
}

ExpressionParser::Next ExpressionParser::close() {
  if (depth_ == 0) return Next::End;
  if (!reduce(0)) return Next::Error;
  cursor_.take();
  if (pending_.back().kind == Kind::Open) {
    pending_.pop_back();
    --depth_;
    return Next::Operator;
  }
  if (!finish_argument()) return Next::Error;
  return finish_call();
}

ExpressionParser::Next ExpressionParser::comma() {
  if (depth_ == 0) return Next::End;
  if (!reduce(0)) return Next::Error;
  if (pending_.back().kind != Kind::Call) {
    return fail("RP047", cursor_.here(),
                "expected `)` and found " + cursor_.shown());
  }
  cursor_.take();
  if (!finish_argument()) return Next::Error;
  return argument();
}

// --- operators ---------------------------------------------------------------

/// Applies what binds at least as strongly, up to the innermost parenthesis.
bool ExpressionParser::reduce(int precedence) {
  while (!pending_.empty()) {
    const Pending& top = pending_.back();
    const bool bracket = top.kind == Kind::Open || top.kind == Kind::Call;
    if (bracket || top.precedence < precedence) return true;
    const Pending operation = std::move(pending_.back());
    pending_.pop_back();
    if (!apply(operation)) return false;
  }
  return true;
}

bool ExpressionParser::apply(const Pending& top) {
  Value last = std::move(values_.back());
  values_.pop_back();
  std::optional<Value> result;
  if (top.kind == Kind::Not) {
    result = scope_.invert(std::move(last), top.where);
  } else if (top.kind == Kind::Minus) {
    result = scope_.negate(std::move(last), top.where);
  } else {
    Value first = std::move(values_.back());
    values_.pop_back();
    result =
        scope_.binary(top.op, std::move(first), std::move(last), top.where);
  }
  return push_value(std::move(result)) == Next::Operator;
}

}  // namespace rung::st
