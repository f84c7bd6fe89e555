#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "frontend/ast.h"

namespace rung {

/// The tokens of a file, for the parser of a language whose tokens have a
/// `begin` and an `end`.
template <class Token>
struct TokenListOf {
  std::string_view text;
  FileId file;
  std::vector<Token> tokens;
  std::vector<AstComment> comments;
  std::vector<AstAnnotation> annotations;
  SourceRange open_comment;  // one that is never closed

  std::string_view text_of(const Token& token) const {
    return text.substr(token.begin, token.end - token.begin);
  }
  SourceRange range_of(const Token& token) const {
    return {file, token.begin, token.end};
  }
};

/// Text of the user's in a message: in backticks, cut when it is long.
std::string quoted_excerpt(std::string_view text);

}  // namespace rung
