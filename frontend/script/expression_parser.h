#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "frontend/ast.h"
#include "frontend/error_limit.h"
#include "frontend/script/token.h"

namespace rung::script {

/// A place in the tokens. Past the end there is End for ever.
class Cursor {
 public:
  explicit Cursor(const TokenList& list) : list_(&list) {}

  const Token& peek(std::size_t ahead = 0) const {
    const std::size_t last = list_->tokens.size() - 1;
    return list_->tokens[at_ + ahead < last ? at_ + ahead : last];
  }
  const Token& take() {
    const Token& token = peek();
    if (token.kind != TokenKind::End) ++at_;
    return token;
  }
  bool at(TokenKind kind) const { return peek().kind == kind; }
  const Token& before() const { return list_->tokens[at_ == 0 ? 0 : at_ - 1]; }
  std::string_view text(const Token& token) const {
    return list_->text_of(token);
  }
  SourceRange range(const Token& token) const { return list_->range_of(token); }
  FileId file() const { return list_->file; }

 private:
  const TokenList* list_;
  std::size_t at_ = 0;
};

/// Does a rung begin at the cursor: a name at the start of a line, then `=`?
bool starts_assignment(const Cursor& cursor);

/// A word of Javascript that cannot name a cell.
bool is_reserved(std::string_view word);

/// Reports, in the words that fit the token, that it cannot stand here.
void report_unexpected(const Cursor& cursor, const Token& token,
                       std::string_view expected, ErrorLimit& errors);

struct ParsedExpression {
  AstExpression nodes;
  std::uint32_t end = 0;  // of its text, closing parentheses included
};

/// An operator-precedence parser with its own stack; it appends to `nodes` in
/// postorder as soon as an operator has its operands.
class ExpressionParser {
 public:
  ExpressionParser(Cursor& cursor, std::vector<AstNode>& nodes,
                   ErrorLimit& errors)
      : cursor_(&cursor), nodes_(&nodes), errors_(&errors) {}

  /// Reads an expression and stops before the first token that cannot continue
  /// it; the caller decides whether that token may stand there. On an error,
  /// which is reported, nothing is appended and there is no value.
  std::optional<ParsedExpression> parse();

 private:
  struct Pending {
    enum class Kind : std::uint8_t { Unary, Binary, Paren, Call };
    Kind kind = Kind::Unary;
    AstOp op = AstOp::Not;
    std::uint8_t binding = 0;         // binds tighter when larger
    std::size_t operands_before = 0;  // of Call
    Token token;                      // the operator, `(`, or the callee's name
  };
  /// The text of an operand, with the parentheses around it.
  struct Extent {
    std::uint32_t begin = 0;
    std::uint32_t end = 0;
  };

  bool read_operand();   // false: error
  bool read_name();      //
  bool read_operator();  // false: error, or the expression has ended
  bool close();          //
  bool next_argument();  //
  void missing_operand();
  void missing_close();
  void reduce_while(std::uint8_t binding);
  void reduce();
  void finish_call(const Pending& call, std::uint32_t end);
  void leaf(AstOp op, const Token& token, std::string_view text);
  bool inside() const { return open_ != 0; }

  Cursor* cursor_;
  std::vector<AstNode>* nodes_;
  ErrorLimit* errors_;
  std::vector<Pending> pending_;
  std::vector<Extent> operands_;
  std::size_t open_ = 0;  // parentheses and calls in pending_
  bool wants_operand_ = true;
  bool failed_ = false;
};

}  // namespace rung::script
