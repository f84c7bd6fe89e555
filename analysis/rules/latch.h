#pragma once

#include <cstdint>
#include <vector>

#include "analysis/rules/program_index.h"

namespace rung {

/// A rung that may hold itself: its target is read in it through And and Or
/// only, e.g. Q0 in Q0 = (Q0 || I0) && !I1.
struct Latch {
  RungId rung;
  CellId cell;
  std::uint32_t read = 0;  // the node that reads the target
  /// Operands in series with that read: when one is false it does not hold.
  std::vector<std::uint32_t> breaks;
  /// Operands in parallel with it: when one is true (and the breaks further
  /// out are) it is set.
  std::vector<std::uint32_t> sets;
  /// sets[i] goes around breaks[0 .. bypassed[i]): there the start wins.
  std::vector<std::size_t> bypassed;
};

/// The rungs that hold themselves, in scan order. Of a rung with several such
/// reads (the first few count) the one with the fewest breaks. Linear in the
/// program.
std::vector<Latch> find_latches(const Program& program,
                                const ProgramIndex& index);

/// The rung's value is true only when its target was: Q = Q && ... .
bool only_resets(const Latch& latch);

}  // namespace rung
