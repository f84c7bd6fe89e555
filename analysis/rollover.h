#pragma once

#include "analysis/program.h"

namespace rung {

/// The milliseconds that a controller's clock of 32 bits counts: 49.7 days.
constexpr std::int64_t kRolloverMs = std::int64_t{1} << 32;

/// Makes the timers of `program` those of a controller whose millis() begins
/// anew at 2^32 (ElementKind::rollover). Before its properties are read.
/// False: it has no such timer.
bool use_rollover(Program& program);

}  // namespace rung
