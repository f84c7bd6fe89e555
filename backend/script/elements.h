#pragma once

#include <memory>

#include "backend/unit/builder.h"

namespace rung::backend {

/// Elements as calls in the expressions of a script: those of the dialect
/// themselves, blocks of IEC 61131-3 (sim only) where a call does the same,
/// edges and latches as bits.
std::unique_ptr<Elements> script_elements(bool yun);

}  // namespace rung::backend
