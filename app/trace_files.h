#pragma once

#include <optional>
#include <string>

#include "reports/report.h"

namespace rung {

/// Writes the runs of a report (of violations, and of what a `reach` asks for)
/// into `directory`, three files an obligation: NAME.vcd, NAME.json (WaveJSON)
/// and NAME.csv (`run --stimulus`). Of several input files each has a directory
/// of its own. An empty directory: none are wanted. The first error, or
/// nothing.
[[nodiscard]] std::optional<std::string> write_traces(
    const Report& report, const std::string& directory);

}  // namespace rung
