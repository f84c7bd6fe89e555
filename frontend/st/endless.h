#pragma once

#include "frontend/iec/cursor.h"

namespace rung::st {

/// At a WHILE or a REPEAT: is it plain that no pass changes its condition?
/// False where a call, EXIT or RETURN stands in it. Linear.
bool keeps_its_condition(iec::Cursor cursor);

}  // namespace rung::st
