#pragma once

#include <string>
#include <vector>

#include "backend/unit/network.h"

namespace rung::backend {

/// One rung: contacts in series and in parallel, and a coil.
/// Rows have two lines each, the names and what they stand above.
std::string draw_rung(const Network& network, const Unit& unit,
                      const std::string& coil);

/// A timer: its contact, its box, and the coil of its output.
std::string draw_timer(const Circuit& contact, const Unit& unit,
                       const Block& block, const std::string& preset,
                       const std::string& coil);

}  // namespace rung::backend
