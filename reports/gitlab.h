#pragma once

#include <string>

#include "reports/report.h"

namespace rung {

/// GitLab Code Quality: an array of findings, input errors and what is not
/// proved. What is allowed or in the baseline is left out: the format has no
/// word for it. Fingerprints are those of SARIF, and unique.
std::string write_gitlab(const Report& report);

}  // namespace rung
