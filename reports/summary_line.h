#pragma once

#include <string>

#include "reports/paint.h"
#include "reports/report.h"

namespace rung {

/// "checked 1 file, 3 rungs: all 12 obligations proved; no findings": success
/// says what was looked at.
std::string summary_line(const Report& report, const Painter& paint);

}  // namespace rung
