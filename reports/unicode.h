#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace rung {

/// One code point of a text, or one byte that is not UTF-8.
struct Character {
  std::uint32_t code = 0;
  std::uint32_t bytes = 1;
  bool valid = true;
};

/// The character at `at` (< text.size()). Overlong forms, surrogates and
/// truncated sequences are single invalid bytes.
Character decode(std::string_view text, std::size_t at);

/// How many columns of a terminal a printable code point takes: 0, 1 or 2.
std::size_t display_width(std::uint32_t code);

/// Text as a terminal may show it: control characters, bytes that are not
/// UTF-8 and the marks that reverse text are written as escapes. A tab becomes
/// spaces up to the next multiple of kTabWidth, counted from `column`.
inline constexpr std::size_t kTabWidth = 4;
struct Printable {
  std::string text;
  std::size_t width = 0;
};
Printable printable(const Character& character, std::string_view bytes,
                    std::size_t column);
std::string printable(std::string_view text);

/// How many bytes from `at` are plain ASCII: printed as they are, a column
/// each.
std::size_t plain_bytes(std::string_view text, std::size_t at);

/// The columns that printable(text) takes.
std::size_t printable_width(std::string_view text);

/// Each byte that is not UTF-8, and U+FFFE and U+FFFF, become U+FFFD; for JSON
/// and XML.
std::string valid_utf8(std::string_view text);

}  // namespace rung
