#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "analysis/program.h"

namespace rung {

/// A run of `repeat` scans with the same inputs, each taking `dt_ms`.
struct StimulusStep {
  std::int64_t dt_ms = 1;
  std::uint64_t repeat = 1;
  std::vector<std::int64_t> inputs;  // in the order of Stimulus::inputs
};

/// What the environment does: the inputs of each scan and the time it takes.
/// A program is deterministic, so this is a whole run.
struct Stimulus {
  std::vector<CellId> inputs;
  std::vector<StimulusStep> steps;
};

/// A stimulus with the values of every cell at the end of each step (of its
/// last scan), as the simulator computed them.
struct Trace {
  struct Step {
    std::uint64_t scan = 1;  // number of the step's last scan, from 1
    std::int64_t dt_ms = 1;
    std::uint64_t repeat = 1;
    std::vector<std::int64_t> values;  // by CellId index
    bool changes = false;  // a cell also changes behind its first scan
  };
  std::vector<Step> steps;
  /// The steps from this one on (by index) can follow each other for ever.
  std::optional<std::size_t> loop;
};

}  // namespace rung
