#pragma once

#include <string>

#include "reports/report.h"

namespace rung {

/// The report as one page that loads nothing: counts, files, findings, and each
/// obligation with its verdict; a violation with its run as a table and the
/// rungs at its end as ladders, a proof with its lemmas. HTML 5, well-formed as
/// XML too; no script. Deterministic, but for the times.
std::string write_html(const Report& report);

}  // namespace rung
