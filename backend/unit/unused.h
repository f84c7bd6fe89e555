#pragma once

#include <vector>

#include "analysis/program.h"

namespace rung::backend {

/// What a reader made and nothing looks at: outputs of blocks that a drawing
/// shows, and leads nowhere.
struct Unused {
  std::vector<bool> cells;  // by CellId
  std::vector<bool> rungs;  // by RungId
};

/// Rungs of such cells, but for those that execute an element. Linear.
Unused find_unused(const Program& program);

}  // namespace rung::backend
