#pragma once

#include "analysis/simulator_elements.h"

namespace rung {

/// The timers of LDmicro.
SimulatedDialect simulated_ldmicro();

}  // namespace rung
