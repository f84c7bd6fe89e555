#pragma once

#include <cstddef>
#include <string>
#include <unordered_set>
#include <vector>

#include "analysis/program.h"
#include "analysis/transition_system.h"

namespace rung {

/// The variables and comparisons that `root` depends on through any number of
/// scans.
std::unordered_set<ExprId> dependencies(const TransitionSystem& ts,
                                        ExprId root);

/// The comparisons at the top of a fault's condition: its value is clamped by
/// the same ones, so they are in the cone of all that reads it.
std::vector<ExprId> comparisons(const TransitionSystem& ts, ExprId condition);

/// The faults whose number `root` depends on: indices, ascending.
std::vector<std::size_t> faults_under(const TransitionSystem& ts, ExprId root);

/// Why nothing is said of what depends on a fault that may happen.
std::string may_leave_range(const Program& program, const Fault& fault);

}  // namespace rung
