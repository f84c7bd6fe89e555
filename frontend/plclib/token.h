#pragma once

#include <cstdint>
#include <string_view>

#include "frontend/error_limit.h"
#include "frontend/token_list.h"

namespace rung::plclib {

enum class TokenKind : std::uint8_t {
  End,
  Word,       // an identifier or a keyword
  Number,     // as written, with its suffix
  Text,       // "..." or '.'
  Symbol,     // an operator or a bracket
  Directive,  // a whole line from `#` on; gone after preprocess()
  Unknown,
};

struct Token {
  TokenKind kind = TokenKind::End;
  std::uint32_t begin = 0;
  std::uint32_t end = 0;
};

/// The last one is End.
using TokenList = TokenListOf<Token>;

/// Splits a sketch into tokens. Comments that begin with `@` are property
/// lines. Linear.
TokenList tokenize(std::string_view text, FileId file);

/// What the directives of a sketch said.
struct Directives {
  bool no_pin_defs = false;  // #define noPinDefs
};

/// Obeys `#include <plcLib.h>` and `#define NAME tokens`; every other directive
/// is an error (RP055). Tokens of a macro stand where its name stood, and keep
/// the place of the definition.
Directives preprocess(TokenList& list, ErrorLimit& errors);

}  // namespace rung::plclib
