#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "base/source.h"
#include "reports/locate.h"
#include "reports/paint.h"

namespace rung {

/// A place in a frame: `^` for what a report is about, `-` for places that
/// have something to do with it.
struct Mark {
  SourceRange where;
  std::string_view text;  // behind the marks; may be empty
  bool primary = true;
};

/// Source lines with marks under them, as compilers draw them:
///
///      --> motor.rung:3:6
///       |
///     3 | Q0 = (I0 || Q0;
///       |      ^ this parenthesis is not closed
///
/// The lines of each file of `marks` are drawn in order, those of the first
/// mark's file first. A range over many lines shows its first two and its
/// last. Lines wider than kFrameWidth are cut around the mark.
inline constexpr std::size_t kFrameWidth = 120;
std::string draw_frame(const SourceSet& sources, const std::vector<Mark>& marks,
                       Ink ink, const Painter& paint, Locator& locator);

}  // namespace rung
