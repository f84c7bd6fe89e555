#pragma once

#include <vector>

#include "analysis/transition_system.h"

namespace rung {

/// Which of `conditions` are true whatever the values of the few terms that
/// they depend on directly: all combinations of up to kMostLeaves of them are
/// tried. What stands above these terms is exact, they themselves are free: a
/// flag that is set holds in every scan, one that is not says nothing.
/// Limits: linear in the number of conditions; the size of the program does
/// not matter.
std::vector<bool> enumerate(const TransitionSystem& ts,
                            const std::vector<ExprId>& conditions);

/// At most so many terms of a condition are left free.
inline constexpr unsigned kMostLeaves = 10;

}  // namespace rung
