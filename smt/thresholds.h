#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

#include "smt/cone.h"

namespace rung {

/// States that `term` reads within its scan, the nearest `limit` of them. With
/// `words_only`, just those whose value it passes on or adds to.
std::vector<std::uint32_t> states_read(const TransitionSystem& ts, ExprId term,
                                       bool words_only, std::size_t limit);

/// By state index, the numbers c for which `x >= c` tells apart what the cone
/// tells apart: those that the word is compared with. Ascending, a handful for
/// each word; bits have none.
std::unordered_map<std::uint32_t, std::vector<std::int64_t>> thresholds(
    const Cone& cone);

}  // namespace rung
