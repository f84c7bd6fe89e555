#include "base/source.h"

#include <algorithm>
#include <cassert>
#include <utility>

namespace rung {

SourceRange cover(const SourceRange& first, const SourceRange& last) {
  assert(first.file == last.file);
  return {first.file, std::min(first.begin, last.begin),
          std::max(first.end, last.end)};
}

SourceFile::SourceFile(std::string path, std::string text)
    : path_(std::move(path)), text_(std::move(text)) {
  line_starts_.push_back(0);
  // A line ends with \n, \r\n or, as for Javascript, with \r alone.
  for (std::size_t i = 0; i < text_.size(); ++i) {
    const char c = text_[i];
    if (c != '\n' && c != '\r') continue;
    if (c == '\r' && text_.compare(i, 2, "\r\n") == 0) continue;
    line_starts_.push_back(static_cast<std::uint32_t>(i + 1));
  }
}

LineColumn SourceFile::position(std::uint32_t offset) const {
  offset = std::min(offset, static_cast<std::uint32_t>(text_.size()));
  const auto next =
      std::upper_bound(line_starts_.begin(), line_starts_.end(), offset);
  const auto line = static_cast<std::uint32_t>(next - line_starts_.begin());
  std::uint32_t column = 1;
  for (std::uint32_t i = line_starts_[line - 1]; i < offset; ++i) {
    // UTF-8 continuation bytes do not start a column of their own.
    if ((static_cast<unsigned char>(text_[i]) & 0xc0U) != 0x80U) ++column;
  }
  return {line, column};
}

std::string_view SourceFile::line(std::uint32_t number) const {
  if (number == 0 || number > line_starts_.size()) return {};
  const std::uint32_t begin = line_starts_[number - 1];
  std::size_t end =
      number < line_starts_.size() ? line_starts_[number] - 1 : text_.size();
  if (end > begin && text_[end - 1] == '\r') --end;
  return std::string_view(text_).substr(begin, end - begin);
}

FileId SourceSet::add(std::string path, std::string text) {
  files_.emplace_back(std::move(path), std::move(text));
  return FileId(static_cast<std::uint32_t>(files_.size() - 1));
}

std::string_view SourceSet::text(const SourceRange& range) const {
  const std::string_view all = files_[range.file.index()].text();
  return all.substr(range.begin, range.end - range.begin);
}

}  // namespace rung
