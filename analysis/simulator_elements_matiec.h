#pragma once

#include "analysis/simulator_elements.h"

namespace rung {

/// Function blocks as matiec (OpenPLC, Beremiz) and ESBMC-PLC have them.
SimulatedDialect simulated_matiec();

}  // namespace rung
