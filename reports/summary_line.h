#pragma once

#include <string>

#include "reports/paint.h"
#include "reports/report.h"

namespace rung {

/// "checked 1 file, 3 rungs: all 12 obligations proved; no findings": success
/// says what was looked at.
std::string summary_line(const Report& report, const Painter& paint);

/// "by rule: 28 double-coil, 3 zero-preset" and a line end, where there are so
/// many findings that one wants to know which rules they come from.
std::string rule_counts(const Report& report);

}  // namespace rung
