#pragma once

#include <string>
#include <utility>
#include <vector>

#include "analysis/program.h"
#include "base/source.h"

namespace rung::backend {

/// The comments of a source by the rung that they speak of: the one on whose
/// line they stand, else the next one.
struct RungComments {
  std::vector<std::vector<std::string>> before;  // lines, by rung
  std::vector<std::string> at_end;
};
RungComments place_comments(const Program& program, const SourceSet& sources);

/// The property lines of a source as they hold for the written text, with the
/// names that it has; those that it cannot carry are given as comments.
struct PropertyLines {
  std::vector<std::string> lines;  // without `//@`
  std::vector<std::string> comments;
};
PropertyLines carry_properties(
    const Program& program,
    const std::vector<std::pair<std::string, std::string>>& signals);

}  // namespace rung::backend
