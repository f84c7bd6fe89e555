#pragma once

#include "analysis/simulator_elements.h"

namespace rung {

/// The timers and counters of S7-300 and S7-400.
SimulatedDialect simulated_s7();

}  // namespace rung
