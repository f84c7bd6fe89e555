#pragma once

#include <vector>

#include "analysis/program.h"

namespace rung {

/// Every node, constant and preset of a program, changed.
std::vector<Program> changed_programs(const Program& program);

}  // namespace rung
