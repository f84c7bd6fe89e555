#include "reports/unicode.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace rung {
namespace {

struct CodeRange {
  std::uint32_t first;
  std::uint32_t last;
};

/// Combining marks and joiners: they take no column of their own.
constexpr std::array kZeroWidth = {
    CodeRange{0x0300, 0x036f},   CodeRange{0x0483, 0x0489},
    CodeRange{0x0591, 0x05bd},   CodeRange{0x0610, 0x061a},
    CodeRange{0x064b, 0x065f},   CodeRange{0x1ab0, 0x1aff},
    CodeRange{0x1dc0, 0x1dff},   CodeRange{0x20d0, 0x20ff},
    CodeRange{0xfe00, 0xfe0f},   CodeRange{0xfe20, 0xfe2f},
    CodeRange{0xe0100, 0xe01ef},
};

/// East Asian wide characters and emoji.
constexpr std::array kWide = {
    CodeRange{0x1100, 0x115f},   CodeRange{0x231a, 0x231b},
    CodeRange{0x2329, 0x232a},   CodeRange{0x23e9, 0x23ec},
    CodeRange{0x2614, 0x2615},   CodeRange{0x26a1, 0x26a1},
    CodeRange{0x2705, 0x2705},   CodeRange{0x274c, 0x274c},
    CodeRange{0x2e80, 0x303e},   CodeRange{0x3041, 0xa4cf},
    CodeRange{0xa960, 0xa97f},   CodeRange{0xac00, 0xd7a3},
    CodeRange{0xf900, 0xfaff},   CodeRange{0xfe30, 0xfe6f},
    CodeRange{0xff00, 0xff60},   CodeRange{0xffe0, 0xffe6},
    CodeRange{0x1f300, 0x1f64f}, CodeRange{0x1f680, 0x1f6ff},
    CodeRange{0x1f900, 0x1f9ff}, CodeRange{0x1fa70, 0x1faff},
    CodeRange{0x20000, 0x3fffd},
};

/// Marks that change what a line looks like without being seen themselves:
/// zero-width spaces and joins, text direction, line separators.
constexpr std::array kInvisible = {
    CodeRange{0x00ad, 0x00ad}, CodeRange{0x061c, 0x061c},
    CodeRange{0x200b, 0x200f}, CodeRange{0x2028, 0x202e},
    CodeRange{0x2060, 0x206f}, CodeRange{0xfeff, 0xfeff},
    CodeRange{0xfff9, 0xfffb},
};

template <std::size_t N>
bool contains(const std::array<CodeRange, N>& ranges, std::uint32_t code) {
  const auto found = std::lower_bound(
      ranges.begin(), ranges.end(), code,
      [](const CodeRange& range, std::uint32_t c) { return range.last < c; });
  return found != ranges.end() && found->first <= code;
}

bool is_control(std::uint32_t code) {
  return code < 0x20 || (code >= 0x7f && code < 0xa0);
}

std::uint32_t byte_at(std::string_view text, std::size_t at) {
  return static_cast<unsigned char>(text[at]);
}

/// How many bytes the sequence that starts with `lead` has; 0: none starts so.
std::uint32_t sequence_length(std::uint32_t lead) {
  if (lead < 0x80) return 1;
  if (lead >= 0xc2 && lead < 0xe0) return 2;
  if (lead >= 0xe0 && lead < 0xf0) return 3;
  if (lead >= 0xf0 && lead < 0xf5) return 4;
  return 0;
}

bool is_well_formed(std::uint32_t code, std::uint32_t length) {
  if (length == 3) return code >= 0x800 && (code < 0xd800 || code > 0xdfff);
  if (length == 4) return code >= 0x10000 && code <= 0x10ffff;
  return true;
}

}  // namespace

Character decode(std::string_view text, std::size_t at) {
  const std::uint32_t lead = byte_at(text, at);
  const Character bad = {lead, 1, false};
  const std::uint32_t length = sequence_length(lead);
  if (length == 1) return {lead, 1, true};
  if (length == 0 || at + length > text.size()) return bad;
  std::uint32_t code = lead & (0x7fU >> length);
  for (std::uint32_t i = 1; i < length; ++i) {
    const std::uint32_t next = byte_at(text, at + i);
    if ((next & 0xc0U) != 0x80U) return bad;
    code = (code << 6U) | (next & 0x3fU);
  }
  return is_well_formed(code, length) ? Character{code, length, true} : bad;
}

std::size_t display_width(std::uint32_t code) {
  if (contains(kZeroWidth, code)) return 0;
  return contains(kWide, code) ? 2 : 1;
}

Printable printable(const Character& character, std::string_view bytes,
                    std::size_t column) {
  if (character.valid && character.code == '\t') {
    const std::size_t width = kTabWidth - column % kTabWidth;
    return {std::string(width, ' '), width};
  }
  std::string escape;
  if (!character.valid || is_control(character.code)) {
    escape = fmt::format("\\x{:02x}", character.code);
  } else if (contains(kInvisible, character.code)) {
    escape = fmt::format("\\u{{{:x}}}", character.code);
  } else {
    return {std::string(bytes), display_width(character.code)};
  }
  const std::size_t width = escape.size();
  return {std::move(escape), width};
}

std::size_t plain_bytes(std::string_view text, std::size_t at) {
  std::size_t end = at;
  while (end < text.size() && text[end] >= ' ' && text[end] <= '~') ++end;
  return end - at;
}

std::string printable(std::string_view text) {
  std::string out;
  std::size_t column = 0;
  for (std::size_t at = 0; at < text.size();) {
    if (const std::size_t plain = plain_bytes(text, at); plain != 0) {
      out += text.substr(at, plain);
      column += plain;
      at += plain;
      continue;
    }
    const Character character = decode(text, at);
    const Printable shown =
        printable(character, text.substr(at, character.bytes), column);
    out += shown.text;
    column += shown.width;
    at += character.bytes;
  }
  return out;
}

std::size_t printable_width(std::string_view text) {
  std::size_t column = 0;
  for (std::size_t at = 0; at < text.size();) {
    if (const std::size_t plain = plain_bytes(text, at); plain != 0) {
      column += plain;
      at += plain;
      continue;
    }
    const Character character = decode(text, at);
    column +=
        printable(character, text.substr(at, character.bytes), column).width;
    at += character.bytes;
  }
  return column;
}

std::string valid_utf8(std::string_view text) {
  std::string out;
  out.reserve(text.size());
  for (std::size_t at = 0; at < text.size();) {
    const Character character = decode(text, at);
    // XML cannot hold these two, not even as references.
    const bool none = character.code == 0xfffe || character.code == 0xffff;
    if (character.valid && !none) {
      out += text.substr(at, character.bytes);
    } else {
      out += "\xef\xbf\xbd";
    }
    at += character.bytes;
  }
  return out;
}

}  // namespace rung
