#pragma once

#include <unordered_map>
#include <vector>

#include "analysis/transition_system.h"

namespace rung {

/// The terms `roots` with variables replaced: by VarId index, the term that
/// stands for it. Linear in the terms under the roots.
std::vector<ExprId> substitute(
    TransitionSystem& ts, const std::vector<ExprId>& roots,
    const std::unordered_map<std::uint32_t, ExprId>& replacement);

}  // namespace rung
