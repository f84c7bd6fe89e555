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
  static constexpr std::uint32_t kNoNode = 0xffff'ffff;

  Kind kind = Kind::Wire;
  int x = 0;
  int y = 0;
  int width = 0;
  int height = 0;
  std::string text;
  /// The node that a contact or box stands for, by its distance from
  /// Rung::begin. Of a negated contact it is the negation.
  std::uint32_t node = kNoNode;
  /// The nets at its left and right end: what is connected without a symbol in
  /// between is one net. A wire or a riser has one.
  int from = 0;
  int to = 0;
  /// A box behind the network that is its input: its value is what goes on to
  /// the right, whatever comes in from the left.
  bool behind_input = false;
};

/// A rung laid out between the left rail (x = 0) and the right one (x = width).
///
/// Invariant: the last shape is the coil, and a symbol stands behind those that
/// feed it: power is one pass over `shapes`.
struct LadderRung {
  static constexpr int kLeftRail = 0;  // the nets of the rails
  static constexpr int kRightRail = 1;

  std::vector<LadderShape> shapes;
  int width = 0;
  int height = 1;  // rows
  int nets = 2;
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

/// All rungs of a program. Those of up to kMaxAlignedWidth are as wide as the
/// widest of them: their coils stand in one column.
inline constexpr int kMaxAlignedWidth = 100;
std::vector<LadderRung> lay_out_ladder(const Program& program);

}  // namespace rung
