#pragma once

#include <cstdint>

#include "frontend/token_list.h"

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

/// The last one is End.
using TokenList = TokenListOf<Token>;

/// Splits a file into tokens. Precondition: check_text() found nothing.
/// Never fails: what is no token is one of kind Unknown or Bad....
TokenList tokenize(const SourceSet& sources, FileId file);

}  // namespace rung::script
