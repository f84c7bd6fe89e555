#pragma once

#include "analysis/simulator_elements.h"

namespace rung {

/// The timers of plcLib sketches, and the tasks of ARTe.
SimulatedDialect simulated_plclib();

}  // namespace rung
