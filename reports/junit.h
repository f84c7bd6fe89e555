#pragma once

#include <string>

#include "reports/report.h"

namespace rung {

/// JUnit XML: a suite a file; a case an obligation, a finding, an input error.
/// Whatever is not proved is a failure (its type is the verdict), an input
/// error or a failed self-check an error: nothing bad is green or skipped. A
/// finding below `fail_on` is a passed case that says it in system-out; one
/// that is allowed, or in the baseline, a skipped one.
std::string write_junit(const Report& report);

}  // namespace rung
