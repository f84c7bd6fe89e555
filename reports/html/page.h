#pragma once

#include <string>

#include "reports/report.h"

namespace rung {

/// The report as one page that loads nothing: counts, files, findings, and each
/// obligation with its verdict; a run with one cursor over its scan table, its
/// timing diagram and the rungs that decide it; a proof with its lemmas; the
/// program as a ladder. HTML 5, well-formed as XML too. It can be read without
/// its script (script). Deterministic, but for the times.
std::string write_html(const Report& report);

}  // namespace rung
