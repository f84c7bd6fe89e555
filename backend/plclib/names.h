#pragma once

#include "backend/unit/names.h"

namespace rung::backend {

/// Names that a sketch for plcLib may have: none of C++, of the library, of
/// Arduino's core or of the headers that it includes, registers among them.
const NameRules& plclib_names();

}  // namespace rung::backend
