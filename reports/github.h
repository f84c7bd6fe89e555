#pragma once

#include <string>

#include "reports/report.h"

namespace rung {

/// GitHub workflow commands: an annotation a finding, a verdict that is not
/// `proved`, a note; then a notice that says what was checked.
std::string write_github(const Report& report);

}  // namespace rung
