#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "analysis/program.h"
#include "analysis/simulator.h"
#include "reports/ladder/layout.h"

namespace rung {

/// What a rung did in one scan, for drawings.
struct RungState {
  struct Value {
    bool executed = false;  // false: skipped (short-circuit)
    std::int64_t value = 0;
  };
  std::vector<Value> nodes;  // by distance from Rung::begin
  std::int64_t target = 0;   // its value at the scan's end
};

/// The state of `rung` in the scan that `simulator` ran last.
RungState state_of(const Program& program, const Rung& rung,
                   const Simulator& simulator);

/// What stands under a symbol: of a contact the signal's value, not whether it
/// lets power through. Nothing where it was not executed.
std::optional<std::int64_t> shown_value(const LadderShape& shape,
                                        const RungState& state);

/// Which nets of `rung` have power; a word has when it is not 0. The coil's is
/// what the rung's expression gave.
std::vector<bool> powered_nets(const LadderRung& rung, const RungState& state);

}  // namespace rung
