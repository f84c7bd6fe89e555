#pragma once

#include <cstdint>
#include <map>
#include <string_view>

#include "frontend/ascii/drawing.h"
#include "frontend/error_limit.h"

namespace rung::ascii {

/// A timer that is drawn as a box in a wire: the wire goes in at `IN` and on
/// from `Q` in the same row.
///
///      %T1
///     +-----+
///     | TON |
///     |IN  Q|
/// 5s  |PT ET|
///     +-----+
struct Box {
  std::string_view kind;  // TON, TOF, TP
  std::string_view instance;
  SourceRange instance_where;
  std::int64_t preset_ms = 0;
  std::uint32_t end = 0;  // the column behind its right wall
  SourceRange where;
};

/// By the place of its left wall in the row of the wire. What is drawn of them
/// is taken out of the drawing. Errors: RP051, RP053, RP087.
std::map<Place, Box> take_boxes(Drawing& drawing, ErrorLimit& errors);

}  // namespace rung::ascii
