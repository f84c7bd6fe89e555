#pragma once

#include <string>
#include <vector>

#include "reports/html/run.h"
#include "reports/ladder/layout.h"
#include "reports/ladder/power.h"

namespace rung {

/// A rung as it is drawn, and what it was in each line of the scan table.
struct RungStates {
  RungId rung;
  LadderRung drawn;
  std::vector<RungState> states;
};

/// The run executed again, of its first kMaxRungs rungs. Nothing where that
/// takes too long. `lines` is scan_lines() of the run.
std::vector<RungStates> states_of(const HtmlRun& run, const Trace& lines);

/// The data island's text: JSON in ASCII, without a character that has a
/// meaning in markup. Empty for more than kMaxValues values.
std::string data_of(const HtmlRun& run, const Trace& lines,
                    const std::vector<RungStates>& rungs);

}  // namespace rung
