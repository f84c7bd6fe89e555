#pragma once

#include <vector>

#include "analysis/transition_system.h"

namespace rung {

/// The terms that `roots` depend on, through any number of scans: operands
/// first, in the order of their first use from the roots on, and never by id.
/// So equal parts of a plant have equal orders.
/// Limits: linear in the terms returned; no recursion.
std::vector<ExprId> terms_in_order(const TransitionSystem& ts,
                                   const std::vector<ExprId>& roots);

}  // namespace rung
