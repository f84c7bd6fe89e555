#pragma once

#include "base/source.h"

namespace rung {

struct Place {
  LineColumn begin;
  LineColumn end;  // just behind the last character
};

/// Lines and columns of source ranges. Counts on from where the last range
/// began: sorted ranges cost one pass over the text, even if it is one line.
class Locator {
 public:
  explicit Locator(const SourceSet& sources) : sources_(&sources) {}

  Place of(const SourceRange& range);

 private:
  const SourceSet* sources_;
  FileId file_;
  std::uint32_t offset_ = 0;
  LineColumn last_;
};

}  // namespace rung
