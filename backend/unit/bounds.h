#pragma once

#include <cstdint>
#include <vector>

#include "analysis/program.h"

namespace rung::backend {

/// The bounds of a word.
struct Bounds {
  std::int64_t low = 0;
  std::int64_t high = 1;
  bool within(std::int64_t least, std::int64_t most) const {
    return low >= least && high <= most;
  }
  friend bool operator==(const Bounds&, const Bounds&) = default;
};

/// The bounds of a word operator's result. The operands' are 32-bit; `right`
/// is ignored where there is one operand.
Bounds bounds_of(NodeOp op, Bounds left, Bounds right);

/// Bounds of every word of a program, in every scan from power-up.
struct WordBounds {
  std::vector<Bounds> cells;    // by CellId
  std::vector<Bounds> nodes;    // by node
  std::vector<bool> overflows;  // by node: it may leave 32 bits
};

/// Limits: linear in the program; a word that keeps growing has the bounds of
///         its type.
WordBounds find_bounds(const Program& program);

}  // namespace rung::backend
