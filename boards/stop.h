#pragma once

#include "analysis/program.h"
#include "analysis/simulator.h"

namespace rung::boards {

/// Whether the machine stops in the scan that `simulator` has just run: a rung
/// writes what its cell does not hold, or a value leaves 32 bits. The simulator
/// goes on there.
bool machine_stops(const Program& program, const Simulator& simulator);

}  // namespace rung::boards
