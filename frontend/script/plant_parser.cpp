#include <string>
#include <utility>

#include "frontend/script/parser.h"

namespace rung::script {

using enum TokenKind;
using Statement = AstPlantStatement::Kind;

namespace {

/// The operator that an updating assignment stands for.
AstOp operator_of(TokenKind kind) {
  if (kind == PlusAssign || kind == Increment) return AstOp::Add;
  if (kind == MinusAssign || kind == Decrement) return AstOp::Subtract;
  return kind == StarAssign ? AstOp::Multiply : AstOp::Divide;
}

bool is_element(std::string_view name) {
  return name == "T" || name == "TOF" || name == "C";
}

}  // namespace

void PlantParser::run() {
  while (!at_section_end()) statement();
  for (; !open_.empty(); open_.pop_back()) {
    const Open& open = open_.back();
    const bool block = open.kind == Open::Kind::Block;
    if (!open.broken)
      errors().error("RP016", cursor().range(open.token),
                     block ? "this `{` is not closed"
                           : "this `" + std::string(cursor().text(open.token)) +
                                 "` has no statement");
    if (!block) bracket(Statement::End, open.token);
  }
}

void PlantParser::statement() {
  const Token& token = cursor().peek();
  bool good = true;
  switch (token.kind) {
    case Semicolon:
      cursor().take();
      break;
    case OpenBrace:
      cursor().take();
      open_.push_back({Open::Kind::Block, token});
      return;
    case CloseBrace:
      close_block();
      return;
    case Name:
      if (cursor().text(token) == "if") {
        if (!if_head(cursor().take())) recover();
        return;
      }
      good = named_statement();
      break;
    case Increment:
    case Decrement:
      good = prefix_update();
      break;
    default:
      report_unexpected(cursor(), token, "a statement", errors());
      cursor().take();
      good = false;
      break;
  }
  if (!good) recover();
  finish_statement();
}

void PlantParser::close_block() {
  const Token& token = cursor().take();
  if (open_.empty() || open_.back().kind != Open::Kind::Block) {
    errors().error("RP016", cursor().range(token), "this `}` closes nothing");
    return;
  }
  open_.pop_back();
  finish_statement();
}

/// A whole statement has been read: so have the `if`s whose body it is.
void PlantParser::finish_statement() {
  while (!open_.empty() && open_.back().kind != Open::Kind::Block) {
    const bool is_else =
        cursor().at(Name) && cursor().text(cursor().peek()) == "else";
    if (open_.back().kind == Open::Kind::If && is_else) {
      const Token& token = cursor().take();
      bracket(Statement::Else, token);
      open_.back() = {Open::Kind::Else, token};
      return;
    }
    bracket(Statement::End, open_.back().token);
    open_.pop_back();
  }
}

bool PlantParser::if_head(const Token& word) {
  if (section_ == Section::Var) {
    errors().error("RP014", cursor().range(word),
                   "`if` is not supported after `//Var`");
    return false;
  }
  // Also after an error: its body and its `else` are still to be read.
  open_.push_back({Open::Kind::If, word, true});
  bracket(Statement::If, word);
  const std::size_t statement = ast().plant.size() - 1;
  if (!cursor().at(TokenKind::Open)) {
    report_unexpected(cursor(), cursor().peek(), "`(` after `if`", errors());
    return false;
  }
  cursor().take();
  const auto value = expressions().parse();
  if (!value || !check_expression(value->nodes)) return false;
  if (!cursor().at(Close)) {
    report_unexpected(cursor(), cursor().peek(), "an operator or `)`",
                      errors());
    return false;
  }
  const Token& close = cursor().take();
  ast().plant[statement].value = value->nodes;
  ast().plant[statement].where = from(word, close.end);
  open_.back().broken = false;
  return true;
}

/// A statement that begins with a name or a word of the language.
bool PlantParser::named_statement() {
  const Token& token = cursor().take();
  const std::string_view word = cursor().text(token);
  if (word == "var" || word == "let" || word == "const") return declarations();
  if (word == "else") {
    errors().error("RP016", cursor().range(token), "this `else` has no `if`");
    return false;
  }
  const Token* last = &token;
  while (cursor().at(Dot) && cursor().peek(1).kind == Name) {
    cursor().take();
    last = &cursor().take();
  }
  const bool member = last != &token;
  if (cursor().at(TokenKind::Open) && !is_reserved(word)) {
    return call(token, *last);
  }
  if (member) {
    errors().error("RP014", from(token, last->end),
                   "members of objects such as " + quoted_excerpt(word) +
                       " are not supported");
    return false;
  }
  if (is_reserved(word) || word == "true" || word == "false") {
    errors().error("RP014", cursor().range(token),
                   quoted_excerpt(word) +
                       " is not supported: a plant has assignments and `if`");
    if (cursor().at(TokenKind::Open)) skip_parentheses();
    return false;
  }
  if (cursor().at(Assign)) {
    return assignment(token) && end_statement();
  }
  if (is_update(cursor().peek().kind)) return update(token);
  report_unexpected(cursor(), cursor().peek(),
                    "`=` after " + quoted_excerpt(word), errors());
  return false;
}

/// `var a = 1, b;`: what has no value keeps the one it has.
bool PlantParser::declarations() {
  for (;;) {
    const Token& target = cursor().peek();
    const std::string_view name = cursor().text(target);
    if (target.kind != Name || is_reserved(name) || name == "true" ||
        name == "false") {
      report_unexpected(cursor(), target, "the name of a variable", errors());
      return false;
    }
    cursor().take();
    if (cursor().at(Assign) && !assignment(target)) return false;
    if (!cursor().at(Comma)) return end_statement();
    cursor().take();
  }
}

bool PlantParser::assignment(const Token& target) {
  cursor().take();
  const auto value = expressions().parse();
  if (!value || !check_expression(value->nodes)) return false;
  emit(target, value->nodes, value->end);
  return true;
}

/// `a += e` is `a = a + (e)`, `a++` is `a = a + 1`.
bool PlantParser::update(const Token& target) {
  const Token& sign = cursor().take();
  if (section_ == Section::Var) {
    errors().error("RP012", cursor().range(sign),
                   "the operator " + quoted_excerpt(cursor().text(sign)) +
                       " is not supported after `//Var`");
    return false;
  }
  if (sign.kind == Increment || sign.kind == Decrement) {
    step(target, sign);
    return end_statement();
  }
  const auto begin = static_cast<std::uint32_t>(ast().nodes.size());
  ast().nodes.push_back({.op = AstOp::Name,
                         .where = cursor().range(target),
                         .text = cursor().text(target)});
  const auto value = expressions().parse();
  if (!value || !check_expression(value->nodes)) return false;
  ast().nodes.push_back({.op = operator_of(sign.kind),
                         .arguments = 2,
                         .size = value->nodes.end - begin + 1,
                         .where = from(target, value->end),
                         .text = cursor().text(sign)});
  emit(target, {begin, value->nodes.end + 1}, value->end);
  return end_statement();
}

bool PlantParser::prefix_update() {
  const Token& sign = cursor().take();
  const Token& target = cursor().peek();
  if (target.kind != Name || section_ == Section::Var ||
      is_reserved(cursor().text(target))) {
    errors().error("RP012", cursor().range(sign),
                   "the operator " + quoted_excerpt(cursor().text(sign)) +
                       " is not supported here");
    return false;
  }
  cursor().take();
  step(target, sign);
  return end_statement();
}

void PlantParser::step(const Token& target, const Token& sign) {
  const auto begin = static_cast<std::uint32_t>(ast().nodes.size());
  const SourceRange where = cover(cursor().range(target), cursor().range(sign));
  ast().nodes.push_back({.op = AstOp::Name,
                         .where = cursor().range(target),
                         .text = cursor().text(target)});
  ast().nodes.push_back(
      {.op = AstOp::Number, .where = cursor().range(sign), .text = "1"});
  ast().nodes.push_back({.op = operator_of(sign.kind),
                         .arguments = 2,
                         .size = 3,
                         .where = where,
                         .text = cursor().text(sign)});
  emit(target, {begin, begin + 3}, where.end);
}

/// A call whose result is not used: it draws.
bool PlantParser::call(const Token& callee, const Token& last) {
  const SourceRange name = from(callee, last.end);
  if (is_element(cursor().text(callee))) {
    errors().error("RP014", name,
                   "the plant cannot call " +
                       quoted_excerpt(cursor().text(callee)) +
                       ": timers and counters belong to rungs");
    return false;
  }
  if (!skip_arguments(callee)) return false;
  const std::string_view text = {cursor().text(callee).data(),
                                 name.end - name.begin};
  note_ignored(text, name);
  if (section_ == Section::Sim) {
    ast().plant.push_back({.kind = Statement::IgnoredCall,
                           .target = text,
                           .target_where = name,
                           .value = {},
                           .where = from(callee, cursor().before().end)});
  }
  return end_statement();
}

/// To the `)` that closes the call, also after an error.
bool PlantParser::skip_arguments(const Token& callee) {
  std::size_t depth = 0;
  bool good = true;
  do {
    const Token& token = cursor().peek();
    if (at_section_end()) {
      errors().error("RP011", cursor().range(callee),
                     "the call of " + quoted_excerpt(cursor().text(callee)) +
                         " is not closed: expected `)`");
      return false;
    }
    good = good && check_argument(token);
    if (token.kind == TokenKind::Open) ++depth;
    if (token.kind == Close) --depth;
    cursor().take();
  } while (depth != 0);
  return good;
}

/// The head of a statement that is not supported.
void PlantParser::skip_parentheses() {
  std::size_t depth = 0;
  do {
    if (at_section_end()) return;
    const TokenKind kind = cursor().take().kind;
    if (kind == TokenKind::Open) ++depth;
    if (kind == Close) --depth;
  } while (depth != 0);
}

/// Arguments may be anything that cannot change a cell or an element.
bool PlantParser::check_argument(const Token& token) {
  const std::string_view text = cursor().text(token);
  const bool calls_element = token.kind == Name && is_element(text) &&
                             cursor().peek(1).kind == TokenKind::Open;
  if (token.kind == Assign || is_update(token.kind) || token.kind == Unknown ||
      calls_element || text == "function" || text == "=>") {
    errors().error(
        "RP014", cursor().range(token),
        quoted_excerpt(text) + " cannot stand in a call that is not executed");
    return false;
  }
  return true;
}

/// Values are numbers and truth values, and nothing is called.
bool PlantParser::check_expression(const AstExpression& value) {
  for (std::uint32_t i = value.begin; i < value.end; ++i) {
    const AstNode& node = ast().nodes[i];
    if (node.op != AstOp::Call && node.op != AstOp::String) continue;
    errors().error(
        "RP014", node.where,
        node.op == AstOp::Call
            ? "the plant cannot use the result of " + quoted_excerpt(node.text)
            : "texts are not supported in the plant");
    return false;
  }
  return true;
}

void PlantParser::emit(const Token& target, AstExpression value,
                       std::uint32_t end) {
  const std::string_view name = cursor().text(target);
  const SourceRange name_where = cursor().range(target);
  const SourceRange where = {
      cursor().file(), cover(name_where, ast().nodes[value.root()].where).begin,
      end};
  if (section_ == Section::Var) {
    ast().initials.push_back({name, name_where, value, where});
  } else {
    ast().plant.push_back({Statement::Assign, name, name_where, value, where});
  }
}

void PlantParser::bracket(Statement kind, const Token& token) {
  ast().plant.push_back({.kind = kind,
                         .target = {},
                         .target_where = {},
                         .value = {},
                         .where = cursor().range(token)});
}

void PlantParser::note_ignored(std::string_view name,
                               const SourceRange& where) {
  if (!ignored_.insert(name).second) return;
  errors().report({.code = "RP017",
                   .severity = Severity::Note,
                   .where = where,
                   .message = "calls of " + quoted_excerpt(name) +
                              " are not executed: they only draw",
                   .labels = {}});
}

/// To the next statement: past `;`, at a brace, or where a line begins with a
/// name.
void PlantParser::recover() {
  while (!at_section_end() && !cursor().at(OpenBrace) &&
         !cursor().at(CloseBrace)) {
    if (cursor().at(Name) && cursor().peek().starts_line) return;
    if (cursor().take().kind == Semicolon) return;
  }
}

}  // namespace rung::script
