#pragma once

#include <string>
#include <vector>

#include "analysis/rules/support.h"

namespace rung {

/// The device reports what it is there for: a trip has come, a button is
/// pressed. A term of the scan.
ExprId is_active(RuleRun& run, const Wiring& wiring);

/// Is the contact true while the device is active?
inline bool follows(const Wiring& wiring, Contact contact) {
  return contact.cell == wiring.cell &&
         contact.inverted == wiring.normally_closed;
}

/// By cell: what a line declares of it; null where none does.
std::vector<const Wiring*> wiring_of_cells(const RuleRun& run);

/// The operands of And and Or at `node`: contacts, calls, comparisons.
std::vector<std::uint32_t> leaves(const Program& program, std::uint32_t node);

/// "the trip `I1`", "the reset `I2`", "`I3`"
std::string device(const Program& program, const Wiring& wiring);

}  // namespace rung
