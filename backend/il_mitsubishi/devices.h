#pragma once

#include <string>

#include "backend/unit/unit.h"

namespace rung::backend {

/// Gives every variable and every timer its device: X, Y and M by their roles,
/// and timers of 100 ms or 10 ms by their presets. A name that is such a device
/// stays; else the number in the name is taken where it is free.
/// Empty, or why there are too few.
std::string assign_devices(Unit& unit);

/// How many milliseconds a count of this timer is.
std::int64_t timer_base(std::int64_t preset);

}  // namespace rung::backend
