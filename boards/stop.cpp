#include "boards/stop.h"

#include <cstdint>
#include <limits>

namespace rung::boards {

bool machine_stops(const Program& program, const Simulator& simulator) {
  for (const Rung& rung : program.rungs) {
    const Cell& cell = program.cells[rung.target];
    const std::int64_t value = simulator.node_value(rung.root());
    if (value < cell.low || value > cell.high) return true;
  }
  for (std::uint32_t i = 0; i < program.nodes.size(); ++i) {
    const std::int64_t value = simulator.node_value(i);
    if (value < std::numeric_limits<std::int32_t>::min() ||
        value > std::numeric_limits<std::int32_t>::max()) {
      return true;
    }
  }
  return false;
}

}  // namespace rung::boards
