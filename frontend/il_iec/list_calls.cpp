// ListParser: operands, and calls of function blocks and functions.

#include <utility>

#include "base/text.h"
#include "frontend/il_iec/list_parser.h"

namespace rung::il_iec {

std::optional<Value> ListParser::operand() {
  const SourceRange where = cursor_.here();
  const std::string_view text = cursor_.text(cursor_.peek());
  switch (cursor_.peek().kind) {
    case TokenKind::Word:
    case TokenKind::Address:
      return variable_operand();
    case TokenKind::Number:
    case TokenKind::Time:
      cursor_.take();
      return scope_.literal(text, where);
    case TokenKind::Minus: {
      cursor_.take();
      if (!cursor_.at(TokenKind::Number)) break;
      const SourceRange digits = cursor_.here();
      std::optional<Value> value =
          scope_.literal(cursor_.text(cursor_.take()), digits);
      if (!value) return std::nullopt;
      return scope_.negate(std::move(*value), cover(where, digits));
    }
    case TokenKind::Real:
    case TokenKind::String:
      scope_.fail("RP043", where,
                  quoted_excerpt(text) + ": " +
                      (cursor_.at(TokenKind::Real) ? "REAL" : "STRING") +
                      " is not supported");
      return std::nullopt;
    default:
      break;
  }
  scope_.fail("RP047", where,
              "expected an operand and found " + cursor_.shown());
  return std::nullopt;
}

std::optional<Value> ListParser::variable_operand() {
  const std::string word = cursor_.word();
  if (word == "TRUE" || word == "FALSE") {
    const SourceRange where = cursor_.range(cursor_.take());
    return scope_.bit(word == "TRUE", where);
  }
  SourceRange where;
  Symbol* const symbol = variable(where);
  if (symbol == nullptr) return std::nullopt;
  return scope_.read(*symbol, where);
}

Symbol* ListParser::variable(SourceRange& where) {
  where = cursor_.here();
  if (!cursor_.at(TokenKind::Word) && !cursor_.at(TokenKind::Address)) {
    scope_.fail("RP047", where,
                "expected a variable and found " + cursor_.shown());
    return nullptr;
  }
  const std::string word = cursor_.word();
  const std::string_view text = cursor_.text(cursor_.take());
  if (word == "TRUE" || word == "FALSE") {
    scope_.fail("RP047", where, "a literal cannot be written");
    return nullptr;
  }
  const bool member =
      cursor_.at(TokenKind::Dot) && cursor_.at(TokenKind::Word, 1);
  if (member && scope_.find(text) == nullptr && scope_.frame().pou->by_use) {
    scope_.fail("RP041", where,
                quoted_excerpt(text) +
                    " is not declared: a function block needs a declaration, "
                    "VAR " +
                    std::string(text.substr(0, 40)) + " : TON; END_VAR");
    return nullptr;
  }
  Symbol* symbol = scope_.get(text, where);
  while (symbol != nullptr && cursor_.at(TokenKind::Dot) &&
         cursor_.at(TokenKind::Word, 1)) {
    cursor_.take();
    where.end = cursor_.here().end;
    symbol = scope_.member(*symbol, cursor_.text(cursor_.take()), where);
  }
  return symbol;
}

Symbol* ListParser::instance_here() {
  const SourceRange where = cursor_.here();
  const bool word = cursor_.at(TokenKind::Word);
  const std::string_view text = cursor_.text(cursor_.peek());
  Symbol* const instance = word ? scope_.find(text) : nullptr;
  if (instance == nullptr) {
    fail("RP041", where,
         word ? quoted_excerpt(text) + " is not declared as a function block" +
                    scope_.suggestion(text)
              : "expected a function block and found " + cursor_.shown());
    return nullptr;
  }
  cursor_.take();
  return instance;
}

/// `S1 latch`: the operator is the name of the input.
void ListParser::pin_operator(const Operator& op, Symbol& instance,
                              SourceRange where) {
  if (!plain(op.name, where) || !known(where)) return;
  std::vector<iec::Argument> list(1);
  list[0].name = op.name;
  list[0].value = value_;
  list[0].where = where;
  if (!scope_.call(instance, std::move(list), where)) failed_ = true;
  if (!failed_) forget();
}

void ListParser::call(const Operator& op, SourceRange where) {
  if (!plain(op.name, where)) return;
  const Context outer = scope_.here();
  if (op.condition) {
    if (!known(where, iec::kBool, op.name)) return;
    std::optional<Value> condition = value_;
    if (op.negate) condition = scope_.invert(std::move(*condition), where);
    if (condition) scope_.enter(*condition, where);
  }
  Symbol* const instance = instance_here();
  std::vector<iec::Argument> list;
  if (instance != nullptr && arguments(list)) {
    if (!scope_.call(*instance, std::move(list), where)) failed_ = true;
  }
  scope_.expansion().restore(outer);
  forget();
}

/// `LIMIT 1, 5` with the current result as the first input, or `LIMIT(` with
/// named ones, which do not use it.
void ListParser::function(SourceRange where) {
  const std::string_view name = cursor_.text(cursor_.take());
  std::vector<iec::Argument> list;
  if (cursor_.at(TokenKind::Open)) {
    if (!arguments(list)) return;
  } else {
    if (!known(where)) return;
    list.resize(1);
    list[0].value = value_;
    list[0].where = where;
    const bool bare =
        cursor_.at(TokenKind::LineEnd) || cursor_.at(TokenKind::End) ||
        cursor_.at(TokenKind::Semicolon) || cursor_.at(TokenKind::Close);
    bool more = !bare;
    while (more) {
      if (!argument(list)) return;
      more = cursor_.accept(TokenKind::Comma);
    }
  }
  set_value(scope_.function(name, std::move(list), where, frames_.empty()));
}

/// `(IN := a, Q => b)`, or nothing.
bool ListParser::arguments(std::vector<iec::Argument>& list) {
  if (!cursor_.accept(TokenKind::Open)) return true;
  cursor_.skip_line_ends();
  while (!cursor_.at(TokenKind::Close)) {
    if (!argument(list)) return false;
    cursor_.skip_line_ends();
    if (cursor_.accept(TokenKind::Comma)) {
      cursor_.skip_line_ends();
    } else if (!cursor_.at(TokenKind::Close)) {
      fail("RP047", cursor_.here(),
           "expected `,` or `)` and found " + cursor_.shown());
      return false;
    }
  }
  cursor_.take();
  return true;
}

bool ListParser::argument(std::vector<iec::Argument>& list) {
  iec::Argument argument;
  argument.where = cursor_.here();
  argument.negated = cursor_.word() == "NOT" && cursor_.at(TokenKind::Word, 1);
  if (argument.negated) cursor_.take();
  // `Q` and `=>` may stand on two lines.
  std::size_t ahead = 1;
  while (cursor_.at(TokenKind::LineEnd, ahead)) ++ahead;
  const bool named = cursor_.at(TokenKind::Word);
  const bool input = named && cursor_.at(TokenKind::Assign, ahead);
  argument.output = named && cursor_.at(TokenKind::Arrow, ahead);
  if (argument.negated && !argument.output) {
    fail("RP047", argument.where, "NOT stands before an output only");
    return false;
  }
  if (input || argument.output) {
    argument.name = cursor_.word();
    for (std::size_t i = 0; i <= ahead; ++i) cursor_.take();
    cursor_.skip_line_ends();
  }
  if (argument.output) {
    SourceRange where;
    argument.variable = variable(where);
    if (argument.variable == nullptr) failed_ = true;
  } else {
    std::optional<Value> value = operand();
    if (value) {
      argument.value = std::move(*value);
    } else {
      failed_ = true;
    }
  }
  list.push_back(std::move(argument));
  return !failed_;
}

}  // namespace rung::il_iec
