#pragma once

#include <cstddef>
#include <string>
#include <string_view>
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

/// Where a name may end, too, that goes on behind a word: `assert.3`.
std::vector<std::size_t> dotted_ends(std::string_view text, std::size_t end);
/// All words of a property line that may be names, those with dots as well.
std::vector<std::string_view> names_in(std::string_view text);

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
