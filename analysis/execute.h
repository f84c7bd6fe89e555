#pragma once

#include <algorithm>
#include <cstdint>

#include "analysis/simulator.h"
#include "analysis/trace.h"

namespace rung {

inline void set_inputs(Simulator& simulator, const Stimulus& stimulus,
                       const StimulusStep& step) {
  for (std::size_t i = 0; i < stimulus.inputs.size(); ++i) {
    simulator.set_input(stimulus.inputs[i], step.inputs[i]);
  }
}

/// Runs `count` scans; those that would only do what the last one did are
/// skipped. Each of the others takes one from `limit`: false when none is left.
/// `Runner` scans and skips as a Simulator does.
template <class Runner>
bool run_scans(Runner& runner, std::uint64_t count, std::int64_t dt_ms,
               std::uint64_t& limit) {
  while (count > 0) {
    if (limit == 0) return false;
    --limit;
    runner.scan(dt_ms);
    --count;
    const std::uint64_t idle = std::min(count, runner.idle_scans(dt_ms));
    runner.skip(idle, dt_ms);
    count -= idle;
  }
  return true;
}

}  // namespace rung
