#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "frontend/token_list.h"

namespace rung::iec {

/// Tokens of the textual languages of IEC 61131-3. Ends of lines are tokens,
/// which instruction lists need and structured text skips.
enum class TokenKind : std::uint8_t {
  End,
  LineEnd,
  Word,      // an identifier or a keyword
  Address,   // %IX0.0
  Number,    // 12, 16#FF, INT#5, BOOL#1: an integer, without sign
  Time,      // T#1h2m3s4ms
  Real,      // 1.5, 1.0e3
  String,    // 'text', "text"
  Pragma,    // {...}
  Colon,     // :
  Assign,    // :=
  Arrow,     // =>
  Comma,     // ,
  Dot,       // .
  Range,     // ..
  Open,      // (
  Close,     // )
  Plus,      // +
  Minus,     // -
  Times,     // *
  Power,     // **
  Divide,    // /
  Equal,     // =
  NotEqual,  // <>
  Less,
  LessEqual,
  Greater,
  GreaterEqual,
  Semicolon,
  And,  // & as an operator
  Unknown,
};

struct Token {
  TokenKind kind = TokenKind::End;
  std::uint32_t begin = 0;
  std::uint32_t end = 0;
};

/// The last two are LineEnd and End.
using TokenList = TokenListOf<Token>;

/// Splits a text into tokens. Comments are `(* *)`, which do not nest, and `//`
/// to the line's end; those that begin with `@` are property lines. `begin`
/// and `end`: the part of the text to read. Linear.
TokenList tokenize(std::string_view text, FileId file, std::size_t begin = 0,
                   std::size_t end = std::string_view::npos);

/// The same word in capitals: IEC names do not differ in case.
std::string upper(std::string_view word);

}  // namespace rung::iec
