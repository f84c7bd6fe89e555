#pragma once

#include <cstdint>
#include <vector>

#include "check/model.h"
#include "check/script.h"

namespace rung::check {

/// States from `first` on that may be equal in every scan, as far as random
/// runs show it. Engines keep one memory where two property lines remember the
/// same, and their lemmas know one name of it only. A guess, to be proved.
std::vector<Claim> guess_equal_memories(const Model& model,
                                        std::uint32_t first);

}  // namespace rung::check
