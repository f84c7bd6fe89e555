#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "frontend/ast.h"

namespace rung::script {

enum class TokenKind : std::uint8_t {
  End,
  Name,
  Number,
  BadNumber,
  String,
  BadString,  // not closed on its line, or with an escape
  Or,
  And,
  Equal,
  StrictEqual,
  NotEqual,
  StrictNotEqual,
  Less,
  LessEqual,
  Greater,
  GreaterEqual,
  Plus,
  Minus,
  Star,
  Slash,
  Not,
  Open,  // (
  Close,
  OpenBrace,
  CloseBrace,
  Comma,
  Semicolon,
  Dot,
  Assign,
  PlusAssign,
  MinusAssign,
  StarAssign,
  SlashAssign,
  Increment,
  Decrement,
  VarSection,       // the comment `//Var`
  SimSection,       // the comment `//Sim`
  DoubtfulSection,  // nearly one of the two
  Unsupported,      // an operator of Javascript that rungs do not have
  Unknown,          // characters that no token has
};

/// `+=`, `++` and the like.
constexpr bool is_update(TokenKind kind) {
  return kind >= TokenKind::PlusAssign && kind <= TokenKind::Decrement;
}

struct Token {
  TokenKind kind = TokenKind::End;
  bool starts_line = false;  // a line end stands between it and the one before
  std::uint32_t begin = 0;
  std::uint32_t end = 0;
};

/// The tokens of a file; the last one is End.
struct TokenList {
  std::string_view text;
  FileId file;
  std::vector<Token> tokens;
  std::vector<AstComment> comments;
  std::vector<AstAnnotation> annotations;
  SourceRange open_comment;  // a `/*` that is never closed

  std::string_view text_of(const Token& token) const {
    return text.substr(token.begin, token.end - token.begin);
  }
  SourceRange range_of(const Token& token) const {
    return {file, token.begin, token.end};
  }
};

/// Splits a file into tokens. Precondition: check_text() found nothing.
/// Never fails: what is no token is one of kind Unknown or Bad....
TokenList tokenize(const SourceSet& sources, FileId file);

/// Text of the user's in a message: in backticks, cut when it is long.
std::string quoted(std::string_view text);

}  // namespace rung::script
