#pragma once

#include "backend/unit/names.h"
#include "backend/unit/unit.h"

namespace rung::backend::ldmicro {

/// Letters, digits and underscores.
const NameRules& name_rules();

/// Gives the variables of a unit the first letter that says what they are:
/// X inputs, Y outputs, R relays, another one numbers; T timers, C counters.
void assign_names(Unit& unit);

}  // namespace rung::backend::ldmicro
