#pragma once

#include <cstdint>
#include <functional>

#include "backend/unit/network.h"
#include "backend/unit/unit.h"

namespace rung::backend {

/// What the writers of ladders have in common: statements as coils.

bool is_comparison(NodeOp op);

enum class Storage : std::uint8_t { None, Set, Reset };

/// A coil: its target takes the power, or keeps its value but where there is
/// power.
struct Coil {
  Terms power;
  Storage storage = Storage::None;
};

/// `target := value` where `guard` is true; empty: always. The guard is a
/// contact, or the value a constant. `x OR target` sets, `target AND NOT x`
/// resets.
Coil coil_for(CellId target, const Terms& value, const Terms& guard);

/// The expression with a bit in the place of each comparison: what `stand_in`
/// gives for it.
Terms without_comparisons(const Terms& terms,
                          const std::function<CellId(Terms)>& stand_in);

/// A part of a network as a network of its own.
Network network_at(const Network& network, std::uint32_t part);

}  // namespace rung::backend
