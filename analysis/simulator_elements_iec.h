#pragma once

#include <cstdint>

#include "analysis/simulator_elements.h"

namespace rung {

/// The part of execute_element() that is IEC 61131-3's.
std::int64_t execute_block(ElementCode code, SimulatedElement& element,
                           const ElementInputs& inputs, ElementClock& clock);

/// `t >= limit`; where it is false for a running timer, it is an event to come.
/// A timer that was started in this very scan is none: as long as nothing else
/// changes, it is started again in every scan.
bool reached(std::int64_t t, std::int64_t limit, ElementClock& clock);

}  // namespace rung
