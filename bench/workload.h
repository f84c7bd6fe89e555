#pragma once

#include <cstddef>
#include <string>

#include "analysis/program.h"
#include "analysis/property.h"
#include "base/source.h"

namespace rung::bench {

/// A sim script of `rungs` rungs in cells of four: a motor that latches, its
/// run-up timer, a batch counter and an analog limit. Each cell is locked out
/// by the one before and has two property lines.
std::string plant_text(std::size_t rungs);

/// A text that was read and built.
struct Workload {
  explicit Workload(const std::string& text);

  SourceSet sources;  // the program's views point into it
  FileId file;
  Program program;
  PropertySet properties;
};

}  // namespace rung::bench
