#pragma once

#include <string>
#include <string_view>

#include "analysis/program.h"
#include "base/source.h"
#include "reports/ladder/layout.h"
#include "reports/ladder/power.h"

namespace rung {

/// The program as a ladder, an SVG file of its own: every rung with its number,
/// its place and the start of its text. Colours follow the reader's light or
/// dark setting; nothing is loaded from elsewhere.
std::string draw_ladder_svg(const SourceSet& sources, const Program& program);

/// One rung as an <svg> element for a page that has kLadderStyle. With a
/// state, the value of each symbol stands under it, and what has power is
/// drawn thicker. `label` is what a reader who does not see it is told.
///
/// For the page's script there is a path for each net (`data-net`) and a group
/// for each symbol, in the order of the layout, the coil last: `data-kind`, the
/// nets at its ends (`data-from`, `data-to`), `data-behind` of a box whose
/// input is what stands left of it. A group's second text is the value.
std::string draw_rung_svg(const LadderRung& rung, const RungState* state,
                          std::string_view label);

/// The rung's text as far as it stands on its first line; for captions.
std::string_view first_line(const SourceSet& sources, const Rung& rung);

}  // namespace rung
