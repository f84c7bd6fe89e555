#include "frontend/script/expression_parser.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <string>

namespace rung::script {
namespace {

using enum TokenKind;

struct Operator {
  TokenKind kind;
  AstOp op;
  std::uint8_t binding;
};

constexpr std::array<Operator, 14> kBinary = {{
    {Or, AstOp::Or, 1},
    {And, AstOp::And, 2},
    {Equal, AstOp::Equal, 3},
    {StrictEqual, AstOp::Equal, 3},
    {NotEqual, AstOp::NotEqual, 3},
    {StrictNotEqual, AstOp::NotEqual, 3},
    {Less, AstOp::Less, 4},
    {LessEqual, AstOp::LessEqual, 4},
    {Greater, AstOp::Greater, 4},
    {GreaterEqual, AstOp::GreaterEqual, 4},
    {Plus, AstOp::Add, 5},
    {Minus, AstOp::Subtract, 5},
    {Star, AstOp::Multiply, 6},
    {Slash, AstOp::Divide, 6},
}};
constexpr std::uint8_t kUnaryBinding = 7;

const Operator* binary_operator(TokenKind kind) {
  const auto* const found =
      std::find_if(kBinary.begin(), kBinary.end(),
                   [kind](const Operator& o) { return o.kind == kind; });
  return found == kBinary.end() ? nullptr : found;
}

// Sorted. Words with a meaning of their own in Javascript, and the spellings
// of other languages that are surely meant as theirs.
constexpr std::array<std::string_view, 62> kReserved = {
    "AND",        "FALSE",     "False",     "Infinity", "Math",      "NOT",
    "NaN",        "OR",        "TRUE",      "True",     "XOR",       "and",
    "arguments",  "async",     "await",     "break",    "case",      "catch",
    "class",      "const",     "continue",  "debugger", "default",   "delete",
    "do",         "else",      "enum",      "eval",     "export",    "extends",
    "finally",    "for",       "function",  "if",       "import",    "in",
    "instanceof", "interface", "let",       "new",      "not",       "null",
    "of",         "or",        "package",   "private",  "protected", "public",
    "return",     "static",    "super",     "switch",   "this",      "throw",
    "try",        "typeof",    "undefined", "var",      "void",      "while",
    "with",       "yield"};

static_assert(std::is_sorted(kReserved.begin(), kReserved.end()));

/// What was probably meant by something that is not in the language.
struct Hint {
  std::string_view seen;
  std::string_view meant;
};
constexpr std::array<Hint, 23> kHints = {{
    {"&", "`&&`"},        {"|", "`||`"},        {"=>", "`>=`"},
    {"=<", "`<=`"},       {"<>", "`!=`"},       {"=", "`==`"},
    {"~", "`!`"},         {"AND", "`&&`"},      {"and", "`&&`"},
    {"OR", "`||`"},       {"or", "`||`"},       {"NOT", "`!`"},
    {"not", "`!`"},       {"TRUE", "`true`"},   {"True", "`true`"},
    {"FALSE", "`false`"}, {"False", "`false`"}, {"\u2264", "`<=`"},
    {"\u2265", "`>=`"},   {"\u2260", "`!=`"},   {"\u2013", "`-`"},
    {"\u2212", "`-`"},    {"\u00ac", "`!`"},
}};

std::string hint(std::string_view seen) {
  for (const Hint& entry : kHints) {
    if (entry.seen == seen) {
      return " (did you mean " + std::string(entry.meant) + "?)";
    }
  }
  return {};
}

bool ends_statement(const Token& token) {
  return token.starts_line || token.kind == Semicolon || token.kind == End ||
         token.kind == VarSection || token.kind == SimSection ||
         token.kind == CloseBrace;
}

/// Quotes are ASCII, or typographic and three bytes long.
std::string_view without_quotes(std::string_view text) {
  const auto length = [](char c) {
    return std::size_t{c == '"' || c == '\'' ? 1U : 3U};
  };
  const std::size_t open = length(text.front());
  return text.substr(open, text.size() - open - length(text.back()));
}

}  // namespace

bool starts_assignment(const Cursor& cursor) {
  return cursor.at(Name) && cursor.peek().starts_line &&
         cursor.peek(1).kind == Assign;
}

bool is_reserved(std::string_view word) {
  return std::binary_search(kReserved.begin(), kReserved.end(), word);
}

void report_unexpected(const Cursor& cursor, const Token& token,
                       std::string_view expected, ErrorLimit& errors) {
  const std::string seen = quoted_excerpt(cursor.text(token));
  const std::string meant = hint(cursor.text(token));
  const SourceRange where = cursor.range(token);
  switch (token.kind) {
    case Unknown:
      errors.error("RP003", where, seen + " is no part of a script" + meant);
      return;
    case BadNumber:
      errors.error("RP005", where,
                   seen + " is not a number: write 20, 0.5, 1e3 or 0x1F");
      return;
    case BadString:
      errors.error("RP006", where,
                   "the text " + seen +
                       " has no closing quote on its line, or a backslash");
      return;
    case Unsupported:
      errors.error("RP012", where,
                   "the operator " + seen + " is not supported" + meant);
      return;
    case Assign:
      errors.error("RP012", where,
                   "`=` assigns, and only a whole rung can assign" + meant);
      return;
    case End:
      errors.error(
          "RP010", where,
          "expected " + std::string(expected) + ", found the end of the file");
      return;
    default:
      break;
  }
  if (is_update(token.kind)) {
    errors.error("RP012", where,
                 seen + " changes a value, and only a whole rung can assign");
  } else {
    errors.error(
        "RP010", where,
        "expected " + std::string(expected) + ", found " + seen + meant);
  }
}

std::optional<ParsedExpression> ExpressionParser::parse() {
  const auto begin = static_cast<std::uint32_t>(nodes_->size());
  pending_.clear();
  operands_.clear();
  open_ = 0;
  wants_operand_ = true;
  failed_ = false;
  while (wants_operand_ ? read_operand() : read_operator()) {
  }
  if (failed_) {
    nodes_->resize(begin);
    return std::nullopt;
  }
  reduce_while(0);
  assert(operands_.size() == 1 && pending_.empty());
  return ParsedExpression{{begin, static_cast<std::uint32_t>(nodes_->size())},
                          operands_[0].end};
}

void ExpressionParser::leaf(AstOp op, const Token& token,
                            std::string_view text) {
  nodes_->push_back({.op = op, .where = cursor_->range(token), .text = text});
  operands_.push_back({token.begin, token.end});
  wants_operand_ = false;
}

/// Reads one token of those that may stand where an operand begins.
bool ExpressionParser::read_operand() {
  const Token& token = cursor_->peek();
  const std::string_view text = cursor_->text(token);
  using enum Pending::Kind;
  switch (token.kind) {
    case TokenKind::Name:
      return read_name();
    case TokenKind::Number:
      leaf(AstOp::Number, token, text);
      break;
    case TokenKind::String:
      leaf(AstOp::String, token, without_quotes(text));
      break;
    case TokenKind::Not:
      pending_.push_back({Unary, AstOp::Not, kUnaryBinding, 0, token});
      break;
    case TokenKind::Minus:
      pending_.push_back({Unary, AstOp::Negate, kUnaryBinding, 0, token});
      break;
    case TokenKind::Open:
      pending_.push_back({Paren, AstOp::Call, 0, operands_.size(), token});
      ++open_;
      break;
    default:
      missing_operand();
      failed_ = true;
      return false;
  }
  cursor_->take();
  return true;
}

bool ExpressionParser::read_name() {
  if (starts_assignment(*cursor_)) {  // the line before is incomplete
    missing_operand();
    failed_ = true;
    return false;
  }
  const Token& token = cursor_->peek();
  const std::string_view text = cursor_->text(token);
  const TokenKind after = cursor_->peek(1).kind;
  if (text == "true" || text == "false") {
    leaf(AstOp::Bool, token, text);
  } else if (after == TokenKind::Dot) {
    errors_->error("RP014", cursor_->range(token),
                   "members of objects such as " + quoted_excerpt(text) +
                       " are not supported in expressions");
    failed_ = true;
    return false;
  } else if (is_reserved(text)) {
    errors_->error(
        "RP013", cursor_->range(token),
        quoted_excerpt(text) + " cannot be used as a name" + hint(text));
    failed_ = true;
    return false;
  } else if (after == TokenKind::Open) {
    pending_.push_back(
        {Pending::Kind::Call, AstOp::Call, 0, operands_.size(), token});
    ++open_;
    cursor_->take();
    if (cursor_->peek(1).kind == TokenKind::Close) {  // f(): no arguments
      cursor_->take();
      wants_operand_ = false;
      return true;
    }
  } else {
    leaf(AstOp::Name, token, text);
  }
  cursor_->take();
  return true;
}

/// Something other than an operand. When that is the end of the rung, the
/// error is at what still waits for its operand.
void ExpressionParser::missing_operand() {
  const Token& token = cursor_->peek();
  if (!ends_statement(token)) {
    report_unexpected(*cursor_, token, "a name, a number or `(`", *errors_);
    return;
  }
  const Token& before = cursor_->before();
  errors_->error("RP010", cursor_->range(before),
                 "the rung ends after " +
                     quoted_excerpt(cursor_->text(before)) +
                     ": expected a name, a number or `(`");
}

/// Reads what follows an operand: an operator, `)` or `,`.
bool ExpressionParser::read_operator() {
  const Token& token = cursor_->peek();
  if (const Operator* const found = binary_operator(token.kind)) {
    reduce_while(found->binding);
    pending_.push_back(
        {Pending::Kind::Binary, found->op, found->binding, 0, token});
    cursor_->take();
    wants_operand_ = true;
    return true;
  }
  if (!inside()) return false;
  if (token.kind == TokenKind::Close) return close();
  if (token.kind == TokenKind::Comma) return next_argument();
  missing_close();
  failed_ = true;
  return false;
}

bool ExpressionParser::close() {
  const Token& token = cursor_->take();
  reduce_while(0);
  const Pending open = pending_.back();
  pending_.pop_back();
  --open_;
  if (open.kind == Pending::Kind::Call) {
    finish_call(open, token.end);
  } else {
    operands_.back() = {open.token.begin, token.end};
  }
  return true;
}

bool ExpressionParser::next_argument() {
  reduce_while(0);
  if (pending_.back().kind != Pending::Kind::Call) {
    report_unexpected(*cursor_, cursor_->peek(), "an operator or `)`",
                      *errors_);
    failed_ = true;
    return false;
  }
  cursor_->take();
  wants_operand_ = true;
  return true;
}

void ExpressionParser::missing_close() {
  const Token& token = cursor_->peek();
  if (!ends_statement(token) && token.kind != TokenKind::Name) {
    report_unexpected(*cursor_, token, "an operator or `)`", *errors_);
    return;
  }
  if (!ends_statement(token)) {
    errors_->error("RP010", cursor_->range(token),
                   "expected an operator or `)`, found " +
                       quoted_excerpt(cursor_->text(token)) +
                       hint(cursor_->text(token)));
    return;
  }
  const auto open =
      std::find_if(pending_.rbegin(), pending_.rend(), [](const Pending& p) {
        return p.kind == Pending::Kind::Paren || p.kind == Pending::Kind::Call;
      });
  errors_->error("RP011", cursor_->range(open->token),
                 open->kind == Pending::Kind::Call
                     ? "the call of " +
                           quoted_excerpt(cursor_->text(open->token)) +
                           " is not closed: expected `)`"
                     : "this `(` is not closed");
}

/// Applies the operators on top of the stack that bind at least as tight; the
/// innermost open parenthesis stops it.
void ExpressionParser::reduce_while(std::uint8_t binding) {
  while (!pending_.empty() && pending_.back().binding != 0 &&
         pending_.back().binding >= binding) {
    reduce();
  }
}

void ExpressionParser::reduce() {
  const Pending op = pending_.back();
  pending_.pop_back();
  const std::uint32_t right = nodes_->back().size;
  AstNode node = {.op = op.op, .arguments = 1, .size = right + 1};
  Extent extent = {op.token.begin, operands_.back().end};
  if (op.kind == Pending::Kind::Binary) {
    node.arguments = 2;
    node.size += (*nodes_)[nodes_->size() - 1 - right].size;
    operands_.pop_back();
    extent.begin = operands_.back().begin;
  }
  node.text = cursor_->text(op.token);
  node.where = {cursor_->file(), extent.begin, extent.end};
  nodes_->push_back(node);
  operands_.back() = extent;
}

void ExpressionParser::finish_call(const Pending& call, std::uint32_t end) {
  const auto arguments =
      static_cast<std::uint32_t>(operands_.size() - call.operands_before);
  AstNode node = {.op = AstOp::Call,
                  .arguments = arguments,
                  .where = {cursor_->file(), call.token.begin, end},
                  .text = cursor_->text(call.token)};
  for (std::uint32_t i = 0; i < arguments; ++i) {
    node.size += (*nodes_)[nodes_->size() - node.size].size;
  }
  nodes_->push_back(node);
  operands_.resize(call.operands_before);
  operands_.push_back({call.token.begin, end});
}

}  // namespace rung::script
