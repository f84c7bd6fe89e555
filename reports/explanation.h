#pragma once

#include <string>

#include "analysis/explanation.h"
#include "reports/locate.h"
#include "reports/paint.h"
#include "reports/report.h"

namespace rung {

/// Why a run ends as it does, below the trace:
///
///     why: in scan 1 I0 = 1, I1 = 1: without any of these it does not happen
///       scan 1: Q0 = 1 by line 2, for I0 = 1
///     repair: line 2 with `&& !I1` in series with the rung: proved, ...
std::string explanation_text(const FileReport& file, const Explanation& why,
                             const Painter& paint, Locator& locator);

/// Of this obligation; null when there is none.
const Explanation* explanation_of(const FileReport& file,
                                  const Obligation& obligation);

}  // namespace rung
