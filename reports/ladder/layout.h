#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "analysis/program.h"

namespace rung {

/// What a ladder is drawn of. Positions are on a grid: x in characters, y in
/// rows of a contact each; every writer scales them as it likes.
struct LadderShape {
  enum class Kind : std::uint8_t {
    Wire,     // from (x, y) to (x + width, y)
    Riser,    // from (x, y) down to (x, y + height)
    Contact,  // -| |-, `text` above; centred in [x, x + width)
    Negated,  // -|/|-
    Box,      // -[text]-
    Coil,     // -( )-
  };
  Kind kind = Kind::Wire;
  int x = 0;
  int y = 0;
  int width = 0;
  int height = 0;
  std::string text;
};

/// A rung laid out between the left rail (x = 0) and the right one (x = width).
struct LadderRung {
  std::vector<LadderShape> shapes;
  int width = 0;
  int height = 1;  // rows
};

/// Lays a rung out: series contacts for `&&`, branches for `||`, a box for what
/// has no contact: comparisons, elements, arithmetic, constants.
///
/// An element or a negation with a network of its own is drawn behind that
/// network only where the network starts at the left rail; elsewhere its text
/// is in the box, because the power in front of it would be part of its input.
/// Rungs with more than kMaxNodes nodes, or wider or higher than kMaxColumns
/// and kMaxRows, are one box with the expression's text.
inline constexpr std::uint32_t kMaxNodes = 400;
inline constexpr int kMaxColumns = 200;
inline constexpr int kMaxLadderRows = 100;
LadderRung lay_out_rung(const Program& program, const Rung& rung);

}  // namespace rung
