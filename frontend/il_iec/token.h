#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "frontend/token_list.h"

namespace rung::il_iec {

enum class TokenKind : std::uint8_t {
  End,
  LineEnd,
  Word,     // an identifier or a keyword
  Address,  // %IX0.0
  Number,   // 12, without sign
  Time,     // T#1h2m3s4ms
  Colon,
  Assign,  // :=
  Arrow,   // =>
  Comma,
  Dot,
  Open,
  Close,
  Minus,
  Semicolon,
  And,      // & as an operator
  Unknown,  // characters that no token has; BadNumber and the like
};

struct Token {
  TokenKind kind = TokenKind::End;
  std::uint32_t begin = 0;
  std::uint32_t end = 0;
};

/// The last two are LineEnd and End.
using TokenList = TokenListOf<Token>;

/// Splits a text into tokens. Comments are `(* *)`, which do not nest, and `//`
/// to the line's end; those that begin with `@` are property lines. Linear.
TokenList tokenize(std::string_view text, FileId file);

/// The same word in capitals: IEC names do not differ in case.
std::string upper(std::string_view word);

}  // namespace rung::il_iec
