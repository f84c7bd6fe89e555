#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "smt/cone.h"
#include "smt/induction.h"
#include "smt/sat.h"

namespace rung {

/// States that have one value after every scan, and what follows from that.
struct RegisterClasses {
  /// A state and the first of its class, both state indices.
  std::vector<std::pair<std::uint32_t, std::uint32_t>> equal;
  std::vector<bool> unreachable;  // by goal: false in every scan, by these
};

/// Register correspondence: the coarsest partition of the cone's states that
/// one induction over scans shows. It begins with states of one initial value,
/// range and `signature` (by Cone::states(); what random runs saw of them),
/// reads each state as the first of its class, and splits classes as long as
/// two next values differ: most are then one gate, a solver decides the rest.
///
/// `goals` are signals of the step that should never be true.
///
/// Source: van Eijk, "Sequential Equivalence Checking Based on Structural
///         Similarities", IEEE TCAD 19(7), 2000.
/// Limits: gives up, with nothing shown, when rounds run out.
RegisterClasses register_classes(Cone& cone, const Known& known,
                                 const std::vector<std::uint64_t>& signatures,
                                 const std::vector<AigLit>& goals,
                                 const Deadline& deadline);

}  // namespace rung
