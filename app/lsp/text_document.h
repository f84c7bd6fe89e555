#pragma once

#include <compare>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace rung::lsp {

/// What a column counts; client and server agree on one.
enum class Encoding : std::uint8_t { Utf8, Utf16, Utf32 };

/// As the protocol has it: the first line and the first column are 0.
struct Position {
  std::uint32_t line = 0;
  std::uint32_t column = 0;
  friend auto operator<=>(const Position&, const Position&) = default;
};

/// The text of an open file, UTF-8, with its lines.
class TextDocument {
 public:
  explicit TextDocument(std::string text = {});

  const std::string& text() const { return text_; }
  std::uint32_t size() const {
    return static_cast<std::uint32_t>(text_.size());
  }

  /// Behind the last line: the end of the text; behind the end of a line: that
  /// end; inside a character: its beginning. So the protocol wants it.
  std::uint32_t offset(Position position, Encoding encoding) const;
  Position position(std::uint32_t offset, Encoding encoding) const;

  /// Bytes [begin, end) become `text`.
  void replace(std::uint32_t begin, std::uint32_t end, std::string_view text);

 private:
  void find_lines();
  /// Where the line's text ends, its line end not included.
  std::uint32_t line_end(std::size_t line) const;

  std::string text_;
  std::vector<std::uint32_t> starts_;
};

}  // namespace rung::lsp
