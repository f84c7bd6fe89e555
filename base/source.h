#pragma once

#include <cstdint>
#include <deque>
#include <string>
#include <string_view>
#include <vector>

#include "base/id.h"

namespace rung {

using FileId = Id<struct FileTag>;

/// Bytes [begin, end) of one input file. Line and column are computed when a
/// report is written, never stored.
struct SourceRange {
  FileId file;
  std::uint32_t begin = 0;
  std::uint32_t end = 0;

  bool has_value() const { return file.has_value(); }
  friend bool operator==(const SourceRange&, const SourceRange&) = default;
};

/// The smallest range that covers both; both are in the same file.
SourceRange cover(const SourceRange& first, const SourceRange& last);

/// A position as people count: the first line and the first column are 1.
/// Columns count Unicode code points, as editors and SARIF do.
struct LineColumn {
  std::uint32_t line = 1;
  std::uint32_t column = 1;
};

/// One input file, held in memory; positions are byte offsets into `text`.
class SourceFile {
 public:
  SourceFile(std::string path, std::string text);

  const std::string& path() const { return path_; }
  std::string_view text() const { return text_; }
  std::size_t line_count() const { return line_starts_.size(); }

  /// Offsets past the end are read as the end.
  LineColumn position(std::uint32_t offset) const;

  /// The text of a line (counted from 1), without its line end.
  std::string_view line(std::uint32_t number) const;

 private:
  std::string path_;
  std::string text_;
  std::vector<std::uint32_t> line_starts_;
};

/// Owns the input files of one run. References and the views into a file's
/// text stay valid as long as the set lives.
class SourceSet {
 public:
  SourceSet() = default;
  // A copy would have other texts than those that views point into.
  SourceSet(const SourceSet&) = delete;
  SourceSet& operator=(const SourceSet&) = delete;
  SourceSet(SourceSet&&) = default;
  SourceSet& operator=(SourceSet&&) = default;

  FileId add(std::string path, std::string text);
  const SourceFile& operator[](FileId id) const { return files_[id.index()]; }
  std::size_t size() const { return files_.size(); }

  std::string_view text(const SourceRange& range) const;

 private:
  std::deque<SourceFile> files_;  // a deque: views into the texts stay valid
};

/// Files above this size are refused before they are read (1 GiB): offsets are
/// 32 bits wide.
inline constexpr std::uint64_t kMaxFileBytes = std::uint64_t{1} << 30;

}  // namespace rung
