#pragma once

#include <cstdint>
#include <optional>

#include "state_search.h"

namespace rung {

/// The longest and the shortest way from P to Q through every scan of a small
/// system; by SpanUnit.
struct Extremes {
  bool cause = false;                    // P is true at some scan's end
  std::optional<std::int64_t> worst[2];  // no value: Q need not come
  std::optional<std::int64_t> best[2];   // no value: it never does
};

/// Preconditions: the obligations of `search` were `reach P`, `reach Q` and
/// `reach` P's rise, and it is complete.
Extremes find_extremes(const StateSearch& search);

}  // namespace rung
