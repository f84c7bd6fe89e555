#pragma once

#include "analysis/simulator_elements.h"

namespace rung {

/// The timers of Logix controllers.
SimulatedDialect simulated_logix();

}  // namespace rung
