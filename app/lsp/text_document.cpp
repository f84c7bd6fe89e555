#include "app/lsp/text_document.h"

#include <algorithm>
#include <utility>

namespace rung::lsp {
namespace {

std::uint32_t bytes_of(char first) {
  const auto lead = static_cast<unsigned char>(first);
  if (lead < 0xc0U) return 1;  // ASCII; a stray byte is one by itself
  if (lead < 0xe0U) return 2;
  return lead < 0xf0U ? 3 : 4;
}

/// How many columns a character of so many bytes takes.
std::uint32_t columns_of(std::uint32_t bytes, Encoding encoding) {
  switch (encoding) {
    case Encoding::Utf8:
      return bytes;
    case Encoding::Utf16:
      return bytes == 4 ? 2 : 1;
    case Encoding::Utf32:
      break;
  }
  return 1;
}

}  // namespace

TextDocument::TextDocument(std::string text) : text_(std::move(text)) {
  find_lines();
}

void TextDocument::find_lines() {
  starts_.assign(1, 0);
  for (std::uint32_t i = 0; i < size(); ++i) {
    const bool ends =
        text_[i] == '\n' ||
        (text_[i] == '\r' && (i + 1 == size() || text_[i + 1] != '\n'));
    if (ends) starts_.push_back(i + 1);
  }
}

std::uint32_t TextDocument::line_end(std::size_t line) const {
  std::uint32_t end = line + 1 < starts_.size() ? starts_[line + 1] : size();
  while (end > starts_[line] &&
         (text_[end - 1] == '\n' || text_[end - 1] == '\r')) {
    --end;
  }
  return end;
}

std::uint32_t TextDocument::offset(Position position, Encoding encoding) const {
  if (position.line >= starts_.size()) return size();
  const std::uint32_t end = line_end(position.line);
  std::uint32_t at = starts_[position.line];
  std::uint32_t column = 0;
  while (at < end) {
    const std::uint32_t bytes = std::min(bytes_of(text_[at]), end - at);
    column += columns_of(bytes, encoding);
    if (column > position.column) break;
    at += bytes;
  }
  return at;
}

Position TextDocument::position(std::uint32_t offset, Encoding encoding) const {
  offset = std::min(offset, size());
  const auto next = std::upper_bound(starts_.begin(), starts_.end(), offset);
  const auto line = static_cast<std::size_t>(next - starts_.begin()) - 1;
  offset = std::min(offset, std::max(line_end(line), starts_[line]));
  Position found{static_cast<std::uint32_t>(line), 0};
  for (std::uint32_t at = starts_[line]; at < offset;) {
    const std::uint32_t bytes = bytes_of(text_[at]);
    found.column += columns_of(std::min(bytes, offset - at), encoding);
    at += bytes;
  }
  return found;
}

void TextDocument::replace(std::uint32_t begin, std::uint32_t end,
                           std::string_view text) {
  begin = std::min(begin, size());
  end = std::clamp(end, begin, size());
  text_.replace(begin, end - begin, text);
  find_lines();
}

}  // namespace rung::lsp
