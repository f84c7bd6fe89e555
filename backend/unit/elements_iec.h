#pragma once

#include <memory>

#include "backend/unit/builder.h"

namespace rung::backend {

/// Elements as the standard function blocks of IEC 61131-3, where there is one
/// that does the same, else as bits and words of their own (docs/lowering.md).
std::unique_ptr<Elements> iec_elements();

}  // namespace rung::backend
