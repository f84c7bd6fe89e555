#pragma once

#include <vector>

#include "analysis/program.h"
#include "analysis/property.h"
#include "base/source.h"

namespace rung {

/// What every program is asked without a line about it: each rung that latches
/// itself can be set and released, each output can become true and false, each
/// timer and counter can fire.
/// Limits: linear in the program.
std::vector<Property> builtin_properties(const Program& program,
                                         const SourceSet& sources);

}  // namespace rung
