#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace rung {

/// The candidate nearest to `word`, for "did you mean"; empty when none is
/// within a third of its length (at least one edit). Ties: the first one.
std::string_view nearest(std::string_view word,
                         const std::vector<std::string_view>& candidates);

/// ` (did you mean `x`?)`, or the empty string when nothing is near.
std::string did_you_mean(std::string_view word,
                         const std::vector<std::string_view>& candidates);

}  // namespace rung
