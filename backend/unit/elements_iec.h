#pragma once

#include <memory>
#include <string_view>

#include "backend/unit/builder.h"

namespace rung::backend {

/// Elements as the standard function blocks of IEC 61131-3, where there is one
/// that does the same, else as bits and words of their own (docs/lowering.md).
/// `dialect` says whose blocks they are: those of the standard, or of "matiec".
std::unique_ptr<Elements> iec_elements(std::string_view dialect = "iec");

}  // namespace rung::backend
