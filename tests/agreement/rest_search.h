#pragma once

#include <cstdint>
#include <vector>

#include "analysis/program.h"
#include "state_search.h"

namespace rung {

/// What `settles within N scans` says of a small system, found by executing
/// scans of 0 ms from each of its states, with each of the inputs, until a
/// state is there for the second time.
///
/// `ts` is one in which time passes, or 0 ms; `search` has all states of the
/// same where it passes. The result, by N: scans of a shortest run after which
/// an output changes although N scans at rest are over; 0 when no run has one.
/// At [0]: unused.
std::vector<std::uint64_t> search_rest(const Program& program,
                                       const TransitionSystem& ts,
                                       const StateSearch& search,
                                       std::uint32_t most_scans);

}  // namespace rung
