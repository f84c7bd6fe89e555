#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "analysis/program.h"
#include "analysis/trace.h"
#include "reports/paint.h"

namespace rung {

/// "100 ms", "60.0 s", "1.25 s", "2 h 05 min": as short as it is exact.
std::string duration(std::int64_t milliseconds);

/// A run as a table: a line a step, a column a signal. Steps between which no
/// signal of the table changes are one line. A value that is not
/// what it was a line before has a star:
///
///      scan    time |  I0  I1  Q0
///     start         |   -   -   0
///         1  100 ms |  1*   0  1*
///    2-3601  60.1 s |   1   0   1   x 3600 scans, 60.0 s
///
/// More signals than fit beside each other continue in a table below.
struct ScanTable {
  const Program& program;
  const Trace& trace;
  std::vector<CellId> signals;
  std::string indent;
};
std::string draw_scan_table(const ScanTable& table, const Painter& paint);

/// The texts of a scan table, for other writers: a header, a line before the
/// first scan, then the table's lines.
struct ScanGrid {
  /// What stands left of the bar and right of the signals.
  struct Line {
    std::string scan;
    std::string time;
    std::string remark;  // "x 3600 scans, 60.0 s", or that a loop begins
  };
  std::vector<Line> lines;
  /// A column a signal, as many texts as lines; printable. A value that is not
  /// what it was a line before ends with a star.
  std::vector<std::vector<std::string>> columns;
};
ScanGrid scan_grid(const Program& program, const Trace& trace,
                   const std::vector<CellId>& signals);

/// The trace with a step for each line of the table behind the start.
Trace scan_lines(const Trace& trace, const std::vector<CellId>& signals);

/// Those of `cone` that are worth a column: all when they are few, else
/// `named` and those that are not 0 somewhere in the trace.
std::vector<CellId> relevant_signals(const Program& program, const Trace& trace,
                                     const std::vector<CellId>& cone,
                                     const std::vector<CellId>& named);

}  // namespace rung
