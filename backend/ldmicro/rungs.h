#pragma once

#include <cstdint>
#include <string>
#include <unordered_map>
#include <vector>

#include "backend/unit/network.h"
#include "backend/unit/unit.h"

namespace rung::backend::ldmicro {

/// Contacts, and what stands behind them.
struct Rung {
  RungId source;  // none: before all of them
  Network power;
  std::vector<std::string> outputs;  // "COIL Yq 0 0 0"
};

struct Rungs {
  std::vector<Rung> rungs;
  /// What a contact of this cell is written as, where it compares numbers:
  /// as it is, and negated.
  struct Comparison {
    std::string open;
    std::string closed;
  };
  std::unordered_map<CellId, Comparison> comparisons;
};

/// The statements of a unit as rungs, in their order, behind those that give
/// cells their first values and sample the inputs: the tool reads the pin at
/// every contact, so one that has several is copied first.
///
/// `cycle` is the time of a scan in ms. Linear, no recursion.
Rungs make_rungs(Unit& unit, std::int64_t cycle);

}  // namespace rung::backend::ldmicro
