#include "analysis/formula.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <utility>

namespace rung {
namespace {

enum class TokenKind : std::uint8_t {
  End,
  Operand,
  Prefix,
  Infix,
  Open,
  Close,
  Comma,
  Question,
  Colon,
  CallOpen,
  Bad
};

struct Token {
  TokenKind kind = TokenKind::End;
  FormulaNode node;       // Operand, Prefix, Infix, CallOpen
  int precedence = 0;     // Prefix, Infix
  std::string_view text;  // as written
  std::uint32_t begin = 0;
  std::uint32_t end = 0;
};

struct Operator {
  std::string_view text;
  FormulaOp op;
  int precedence;
};

constexpr int kChoosePrecedence = 1;
constexpr int kImpliesPrecedence = 3;  // groups to the right
constexpr int kPrefixPrecedence = 11;

// The longest spelling first: the first row that matches is taken.
constexpr std::array<Operator, 18> kOperators = {{
    {"<->", FormulaOp::Equivalent, 2},
    {"->", FormulaOp::Implies, kImpliesPrecedence},
    {"||", FormulaOp::Or, 4},
    {"&&", FormulaOp::And, 6},
    {"==", FormulaOp::Equal, 7},
    {"!=", FormulaOp::NotEqual, 7},
    {"<>", FormulaOp::NotEqual, 7},
    {"<=", FormulaOp::LessEqual, 8},
    {">=", FormulaOp::GreaterEqual, 8},
    {"=", FormulaOp::Equal, 7},
    {"<", FormulaOp::Less, 8},
    {">", FormulaOp::Greater, 8},
    {"^", FormulaOp::Xor, 5},
    {"&", FormulaOp::And, 6},
    {"|", FormulaOp::Or, 4},
    {"+", FormulaOp::Add, 9},
    {"-", FormulaOp::Subtract, 9},
    {"*", FormulaOp::Multiply, 10},
}};

constexpr std::array<Operator, 8> kWords = {{
    {"AND", FormulaOp::And, 6},
    {"OR", FormulaOp::Or, 4},
    {"XOR", FormulaOp::Xor, 5},
    {"NOT", FormulaOp::Not, kPrefixPrecedence},
    {"TRUE", FormulaOp::Bool, 1},
    {"true", FormulaOp::Bool, 1},
    {"FALSE", FormulaOp::Bool, 0},
    {"false", FormulaOp::Bool, 0},
}};

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_name_start(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' ||
         c == '$' || c == '%';
}
bool is_name_part(char c) { return is_name_start(c) || is_digit(c); }

class Lexer {
 public:
  explicit Lexer(std::string_view text) : text_(text) {}

  /// `wants_operand`: where an operand may start, `-` and `!` are prefixes.
  Token next(bool wants_operand) {
    while (at_ < text_.size() && is_space(text_[at_])) ++at_;
    const std::size_t begin = at_;
    Token token = scan(wants_operand);
    token.begin = token.node.begin = static_cast<std::uint32_t>(begin);
    token.end = token.node.end = static_cast<std::uint32_t>(at_);
    token.text = text_.substr(begin, at_ - begin);
    return token;
  }

 private:
  static bool is_space(char c) { return c == ' ' || c == '\t'; }
  char peek(std::size_t ahead = 0) const {
    return at_ + ahead < text_.size() ? text_[at_ + ahead] : '\0';
  }

  Token scan(bool wants_operand) {
    if (at_ >= text_.size()) return {TokenKind::End};
    const char c = peek();
    if (is_digit(c)) return number();
    if (is_name_start(c)) return name();
    if (wants_operand && (c == '!' || c == '-')) {
      ++at_;
      return prefix(c == '!' ? FormulaOp::Not : FormulaOp::Negate);
    }
    return sign(c);
  }

  Token sign(char c) {
    for (const Operator& row : kOperators) {
      if (text_.substr(at_, row.text.size()) != row.text) continue;
      at_ += row.text.size();
      return {TokenKind::Infix, {.op = row.op, .arguments = 2}, row.precedence};
    }
    ++at_;
    switch (c) {
      case '(':
        return {TokenKind::Open};
      case ')':
        return {TokenKind::Close};
      case ',':
        return {TokenKind::Comma};
      case '?':
        return {TokenKind::Question};
      case ':':
        return {TokenKind::Colon};
      default:
        return {TokenKind::Bad};
    }
  }

  static Token prefix(FormulaOp op) {
    return {TokenKind::Prefix, {.op = op, .arguments = 1}, kPrefixPrecedence};
  }

  /// A whole number of at most 15 digits; with the unit s also a decimal one.
  Token number() {
    constexpr std::size_t kMaxDigits = 15;
    std::int64_t value = 0;
    std::int64_t scale = 1;
    std::size_t digits = 0;
    bool fraction = false;
    for (;
         is_digit(peek()) || (peek() == '.' && is_digit(peek(1)) && !fraction);
         ++at_) {
      if (peek() == '.') {
        fraction = true;
        continue;
      }
      if (++digits > kMaxDigits) continue;
      value = value * 10 + (peek() - '0');
      if (fraction) scale *= 10;
    }
    const std::int64_t unit = read_unit();
    if (unit == 0 || digits > kMaxDigits ||
        value > std::numeric_limits<std::int64_t>::max() / 1000 ||
        value * unit % scale != 0) {
      return {TokenKind::Bad};
    }
    return {TokenKind::Operand,
            {.op = FormulaOp::Number, .number = value * unit / scale}};
  }

  /// Milliseconds of the unit that follows, 1 when none does, 0 for a wrong
  /// one.
  std::int64_t read_unit() {
    std::size_t begin = at_;
    while (begin < text_.size() && is_space(text_[begin])) ++begin;
    std::size_t end = begin;
    while (end < text_.size() && is_name_part(text_[end])) ++end;
    const std::string_view word = text_.substr(begin, end - begin);
    if (word == "ms" || word == "s") {
      at_ = end;
      return word == "s" ? 1000 : 1;
    }
    return begin == at_ && !word.empty() ? 0 : 1;
  }

  // `.member`, `.3`, `[3]`: what addresses and tags have behind a name.
  void members() {
    while (true) {
      if (peek() == '.' && is_name_part(peek(1))) {
        ++at_;
        while (is_name_part(peek())) ++at_;
      } else if (peek() == '[' && is_digit(peek(1))) {
        std::size_t end = 1;
        while (is_digit(peek(end))) ++end;
        if (peek(end) != ']') return;
        at_ += end + 1;
      } else {
        return;
      }
    }
  }

  Token name() {
    const std::size_t begin = at_;
    while (is_name_part(peek())) ++at_;
    const std::string_view word = text_.substr(begin, at_ - begin);
    for (const Operator& row : kWords) {
      if (row.text != word) continue;
      if (row.op == FormulaOp::Bool) {
        return {TokenKind::Operand,
                {.op = FormulaOp::Bool, .number = row.precedence}};
      }
      if (row.op == FormulaOp::Not) return prefix(FormulaOp::Not);
      return {TokenKind::Infix, {.op = row.op, .arguments = 2}, row.precedence};
    }
    if (peek() == '(' && !read_instance()) {
      ++at_;
      return {TokenKind::CallOpen, {.op = FormulaOp::Call, .text = word}};
    }
    members();
    while (peek() == '\'') ++at_;
    return {TokenKind::Operand,
            {.op = FormulaOp::Name, .text = text_.substr(begin, at_ - begin)}};
  }

  /// `(12)` before a dot belongs to the name: T(12).q.
  bool read_instance() {
    std::size_t end = at_ + 1;
    while (end < text_.size() && is_digit(text_[end])) ++end;
    const bool found = end > at_ + 1 && end + 1 < text_.size() &&
                       text_[end] == ')' && text_[end + 1] == '.';
    if (found) at_ = end + 1;
    return found;
  }

  std::string_view text_;
  std::size_t at_ = 0;
};

/// Operator precedence with explicit stacks: depth costs heap, never stack.
class Parser {
 public:
  explicit Parser(std::string_view text) : lexer_(text) {
    result_.length = static_cast<std::uint32_t>(text.size());
  }

  Formula parse() {
    while (result_.error.empty()) {
      const Token token = lexer_.next(wants_operand_);
      if (token.kind == TokenKind::End) {
        finish(token);
        break;
      }
      if (wants_operand_) {
        operand(token);
      } else {
        after_operand(token);
      }
    }
    if (!result_.error.empty()) result_.nodes.clear();
    return std::move(result_);
  }

 private:
  struct Pending {
    TokenKind kind;
    FormulaNode node;
    int precedence = 0;
    std::uint32_t begin = 0;
  };

  void fail(const Token& token, std::string what) {
    result_.error = std::move(what);
    result_.error_at = token.begin;
  }

  void operand(const Token& token) {
    switch (token.kind) {
      case TokenKind::Operand:
        push(token.node);
        wants_operand_ = false;
        return;
      case TokenKind::Prefix:
        pending_.push_back(
            {token.kind, token.node, token.precedence, token.begin});
        return;
      case TokenKind::Open:
        pending_.push_back({token.kind, {}, 0, token.begin});
        return;
      case TokenKind::CallOpen: {
        FormulaNode node = token.node;
        node.arguments = 1;
        pending_.push_back({token.kind, node, 0, token.begin});
        return;
      }
      default:
        fail(token, token.kind == TokenKind::Bad
                        ? "`" + std::string(token.text) + "` is not understood"
                        : "a name or a number is missing before `" +
                              std::string(token.text) + "`");
    }
  }

  void after_operand(const Token& token) {
    switch (token.kind) {
      case TokenKind::Infix: {
        const bool right = token.precedence == kImpliesPrecedence;
        reduce_above(right ? token.precedence : token.precedence - 1);
        pending_.push_back(
            {token.kind, token.node, token.precedence, token.begin});
        wants_operand_ = true;
        return;
      }
      case TokenKind::Question:
        reduce_above(kChoosePrecedence);
        pending_.push_back({token.kind, {}, 0, token.begin});
        wants_operand_ = true;
        return;
      case TokenKind::Colon:
        return colon(token);
      case TokenKind::Comma:
        return comma(token);
      case TokenKind::Close:
        return close(token);
      default:
        fail(token,
             "an operator is missing before `" + std::string(token.text) + "`");
    }
  }

  void colon(const Token& token) {
    reduce_above(0);
    if (pending_.empty() || pending_.back().kind != TokenKind::Question) {
      return fail(token, "`:` without `?`");
    }
    pending_.back() = {TokenKind::Infix,
                       {.op = FormulaOp::Choose, .arguments = 3},
                       kChoosePrecedence,
                       token.begin};
    wants_operand_ = true;
  }

  void comma(const Token& token) {
    reduce_above(0);
    if (pending_.empty() || pending_.back().kind != TokenKind::CallOpen) {
      return fail(token, "`,` outside of a call");
    }
    ++pending_.back().node.arguments;
    wants_operand_ = true;
  }

  void close(const Token& token) {
    reduce_above(0);
    if (pending_.empty() || pending_.back().kind == TokenKind::Question) {
      return fail(token, "`)` without `(`");
    }
    const Pending open = pending_.back();
    pending_.pop_back();
    if (open.kind == TokenKind::CallOpen) {
      FormulaNode node = open.node;
      node.end = token.end;
      push(node);
    }
  }

  void finish(const Token& end) {
    if (wants_operand_) {
      return fail(end, pending_.empty() ? "a formula is missing"
                                        : "the formula ends too early");
    }
    reduce_above(0);
    if (!pending_.empty()) {
      result_.error = pending_.back().kind == TokenKind::Question
                          ? "`?` without `:`"
                          : "`(` without `)`";
      result_.error_at = pending_.back().begin;
    }
  }

  /// Applies the pending operators that bind tighter than `precedence`.
  void reduce_above(int precedence) {
    while (!pending_.empty() && pending_.back().precedence > precedence) {
      const FormulaNode node = pending_.back().node;
      pending_.pop_back();
      push(node);
    }
  }

  void push(FormulaNode node) {
    node.size = 1;
    std::uint32_t root = static_cast<std::uint32_t>(result_.nodes.size());
    for (std::uint32_t i = 0; i < node.arguments; ++i) {
      const FormulaNode& child = result_.nodes[root - 1];
      node.size += child.size;
      node.begin = std::min(node.begin, child.begin);
      node.end = std::max(node.end, child.end);
      root -= child.size;
    }
    result_.nodes.push_back(node);
  }

  Lexer lexer_;
  Formula result_;
  std::vector<Pending> pending_;
  bool wants_operand_ = true;
};

}  // namespace

Formula parse_formula(std::string_view text) { return Parser(text).parse(); }

}  // namespace rung
