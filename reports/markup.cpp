#include "reports/markup.h"

#include <fmt/format.h>

#include <limits>

#include "reports/unicode.h"

namespace rung {
namespace {

/// Valid UTF-8 that is no character of XML 1.0.
bool is_no_character(const Character& character) {
  return character.valid && (character.code & 0xfffeU) == 0xfffeU;
}

void append_escaped(std::string_view text, std::string& out) {
  for (const char c : text) {
    const std::string_view entity = c == '\'' ? "&#39;" : entity_of(c);
    if (entity.empty()) {
      out += c;
    } else {
      out += entity;
    }
  }
}

}  // namespace

std::string_view entity_of(char c) {
  switch (c) {
    case '&':
      return "&amp;";
    case '<':
      return "&lt;";
    case '>':
      return "&gt;";
    case '"':
      return "&quot;";
    default:
      return {};
  }
}

std::string markup(std::string_view text) {
  return markup(text, std::numeric_limits<std::size_t>::max());
}

std::string markup(std::string_view text, std::size_t columns) {
  std::string out;
  std::size_t column = 0;
  for (std::size_t at = 0; at < text.size();) {
    const Character character = decode(text, at);
    const std::string_view bytes = text.substr(at, character.bytes);
    Printable shown = printable(character, bytes, column);
    if (is_no_character(character)) {
      shown.text = fmt::format("\\u{{{:x}}}", character.code);
      shown.width = shown.text.size();
    }
    if (columns - column < shown.width) return out + "…";
    append_escaped(shown.text, out);
    column += shown.width;
    at += character.bytes;
  }
  return out;
}

}  // namespace rung
