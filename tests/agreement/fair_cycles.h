#pragma once

#include <cstdint>

#include "state_search.h"

namespace rung {

/// Is there an infinite run of a small system that has a scan with each of the
/// `fair` conditions again and again, and from some scan on none with `goal`?
/// Numbers of obligations of the search, as bits; `goal` may be none.
///
/// Strongly connected components of the scans without the goal: one with a
/// scan for each is such a run, and there is no other.
bool has_fair_cycle(const StateSearch& search, std::uint64_t goal,
                    std::uint64_t fair);

}  // namespace rung
