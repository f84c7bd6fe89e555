#pragma once

#include <cstdint>
#include <vector>

#include "analysis/transition_system.h"

namespace rung {

/// Groups terms whose cones share state: what one group's engines learn is of
/// use for the rest of it, and a plant of independent cells falls into cells.
/// A term over inputs alone is with the one group that reads them, if it is
/// one. Returns indices into `roots`, in order of each group's first. Limits:
/// linear in the cone of `roots`.
std::vector<std::vector<std::size_t>> partition(
    const TransitionSystem& ts, const std::vector<ExprId>& roots);

}  // namespace rung
