#pragma once

#include "analysis/simulator_elements.h"

namespace rung {

/// The standard function blocks of IEC 61131-3.
SimulatedDialect simulated_iec();

}  // namespace rung
