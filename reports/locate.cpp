#include "reports/locate.h"

#include <algorithm>
#include <string_view>

namespace rung {
namespace {

bool starts_character(char byte) {
  return (static_cast<unsigned char>(byte) & 0xc0U) != 0x80U;
}

/// Goes on from the place of `begin` to that of `end`.
LineColumn count_on(LineColumn from, std::string_view text, std::size_t begin,
                    std::size_t end) {
  for (std::size_t i = begin; i < end; ++i) {
    const bool ends_line =
        text[i] == '\n' || (text[i] == '\r' && text.substr(i, 2) != "\r\n");
    if (ends_line) {
      from = {from.line + 1, 1};
    } else if (starts_character(text[i])) {
      ++from.column;
    }
  }
  return from;
}

}  // namespace

Place Locator::of(const SourceRange& range) {
  const SourceFile& source = (*sources_)[range.file];
  const std::string_view text = source.text();
  const auto size = static_cast<std::uint32_t>(text.size());
  const std::uint32_t begin = std::min(range.begin, size);
  const std::uint32_t end = std::clamp(range.end, begin, size);
  last_ = range.file == file_ && begin >= offset_
              ? count_on(last_, text, offset_, begin)
              : source.position(begin);
  file_ = range.file;
  offset_ = begin;
  return {last_, count_on(last_, text, begin, end)};
}

}  // namespace rung
