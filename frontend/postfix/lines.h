#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/source.h"

namespace rung::postfix {

/// What stands between blanks. A name in quotes is one token.
struct Token {
  std::string_view text;    // without the quotes and a target's `=`
  std::uint32_t begin = 0;  // with them, as byte offsets of the file
  std::uint32_t end = 0;
  bool quoted = false;
  bool target = false;  // `=NAME`
};

struct Line {
  std::vector<Token> tokens;
  std::optional<Token> comment;     // without `//` or `//@`, trimmed
  bool is_note = false;             // the comment is a property line
  std::optional<Token> open_quote;  // a name that does not end
};

/// Splits a text into lines, and a line into tokens.
class LineReader {
 public:
  explicit LineReader(std::string_view text) : text_(text) {}
  /// False at the end of the text. The line's memory is used again.
  bool next(Line& line);

 private:
  void read_comment(std::size_t end, Line& line);
  std::size_t read_token(std::size_t end, Line& line);

  std::string_view text_;
  std::size_t at_ = 0;
};

/// A decimal integer of at most 32 bits with sign, and nothing else.
std::optional<std::int64_t> read_integer(std::string_view text);

/// A token in a message: shortened, without control characters.
std::string shown(std::string_view token);

}  // namespace rung::postfix
