#pragma once

#include <cstdint>
#include <vector>

#include "analysis/obligation.h"
#include "analysis/transition_system.h"

namespace rung {

/// Every reachable state of a small system, one by one: what engines say can
/// be held against it.
struct StateSearch {
  /// A scan of a run, between states by number.
  struct Edge {
    std::uint32_t from = 0;
    std::uint32_t to = 0;
    std::int64_t dt_ms = 0;
    std::uint64_t number = 0;  // of scans to its end, at least
    /// By obligation, bit i for the i-th: it ends with the condition.
    std::uint64_t goals = 0;
  };
  std::vector<Edge> edges;
  /// By obligation: scans of a shortest run at whose end an invariant's
  /// condition is false, or a reach obligation's true, or from whose end no
  /// run leads to a recover obligation's; 0 when no run has one.
  std::vector<std::uint64_t> decided_at;
  /// By obligation: its trigger holds at some scan's end; true without one.
  std::vector<bool> triggered;
  /// By number: the values of its states, and how many scans lead there; 0 for
  /// the first one when none do.
  std::vector<std::vector<std::int64_t>> states;
  std::vector<std::uint64_t> reached_in;
  bool runs = false;      // some scan meets the assumptions
  bool complete = false;  // not given up at `max_states`
};

/// Preconditions: no word inputs.
StateSearch search_states(const TransitionSystem& ts,
                          const std::vector<Obligation>& obligations,
                          std::size_t max_states);

}  // namespace rung
