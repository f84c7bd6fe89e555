#pragma once

#include <cstdint>

#include "analysis/program.h"
#include "analysis/trace.h"
#include "base/diagnostic.h"
#include "base/source.h"

namespace rung {

/// Reads a stimulus from a comma-separated table (docs: `run --stimulus`).
///
///     dt,repeat,I0,IW1
///     10,,1,512
///     ,100,0,
///
/// The first line names the columns: inputs of the program, `dt` (ms a scan
/// takes; `default_dt_ms` where there is no such column or nothing above) and
/// `repeat` (scans the row stands for; 1 when empty). Every further line is a
/// row. An empty cell keeps the input or dt of the row above; in the first row
/// an input is then what it is before the first scan. Empty lines and lines
/// that start with `#` are skipped; cells may stand in double quotes.
///
/// Errors: RP09x to `sink`, all of a file in one run: an unknown or doubled
///         column, a row with more or fewer cells, a value that is no whole
///         number or outside of the input's range. Then the result is not to
///         be used.
/// Limits: linear in the file. Any bytes.
Stimulus read_stimulus(const Program& program, const SourceSet& sources,
                       FileId file, std::int64_t default_dt_ms,
                       DiagnosticSink& sink);

}  // namespace rung
