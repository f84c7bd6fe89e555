#include "reports/locate.h"

#include <algorithm>
#include <string_view>

namespace rung {
namespace {

bool starts_character(char byte) {
  return (static_cast<unsigned char>(byte) & 0xc0U) != 0x80U;
}

LineColumn count_on(LineColumn from, std::string_view text) {
  for (const char byte : text) {
    if (byte == '\n') {
      from = {from.line + 1, 1};
    } else if (starts_character(byte)) {
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
              ? count_on(last_, text.substr(offset_, begin - offset_))
              : source.position(begin);
  file_ = range.file;
  offset_ = begin;
  return {last_, count_on(last_, text.substr(begin, end - begin))};
}

}  // namespace rung
