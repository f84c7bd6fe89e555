// Put before a source of the machine: an executor with a fault, which takes
// `&&` for `||`. Tests only.
#ifndef RUNGPROOF_FAULT_H
#define RUNGPROOF_FAULT_H

#include "rungproof_format.h"

namespace rungproof {
const uint8_t kTakenForAnd = kOr;
const uint8_t kTakenForOr = kAnd;
}  // namespace rungproof
#define kAnd kTakenForAnd
#define kOr kTakenForOr

#endif
