#pragma once

#include <optional>

#include "base/digest.h"

namespace rung {

/// A digest of the machine code that runs: the build ids which the linker gave
/// the program and every library that is loaded with it. Another build, or
/// another solver library, has another one.
/// Nothing where the program has no build id.
std::optional<Digest> build_identity();

}  // namespace rung
