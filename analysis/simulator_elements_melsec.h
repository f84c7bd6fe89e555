#pragma once

#include "analysis/simulator_elements.h"

namespace rung {

/// The timers and counters of the FX family.
SimulatedDialect simulated_melsec();

}  // namespace rung
