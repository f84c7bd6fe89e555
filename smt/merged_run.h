#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

#include "smt/run.h"

namespace rung {

/// When a run's scans are and how long its stretches: dt and delta by turns.
std::vector<std::int64_t> beats_of(const TransitionSystem& ts,
                                   const FoundRun& run);

/// Runs of independent parts, side by side in one: a plant is executed once
/// for many of its parts.
class MergedRun {
 public:
  /// False, and nothing is added, when an input has another value in the runs
  /// that are here.
  /// Preconditions: equal beats_of().
  bool add(const TransitionSystem& ts, const FoundRun& run);

  const FoundRun& run() const { return run_; }

 private:
  bool agrees(const FoundRun& run) const;

  FoundRun run_;
  std::unordered_map<VarId, std::size_t> column_;
};

}  // namespace rung
