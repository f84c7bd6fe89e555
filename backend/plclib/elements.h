#pragma once

#include <memory>

#include "backend/unit/builder.h"

namespace rung::backend {

/// Timers as those of plcLib where these do the same, everything else as bits
/// and words of the sketch. The pin of a call is the function that is called.
std::unique_ptr<Elements> plclib_elements();

}  // namespace rung::backend
