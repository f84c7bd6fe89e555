#pragma once

#include <optional>
#include <string>
#include <vector>

#include "analysis/program.h"
#include "analysis/trace.h"

namespace rung {

/// A run as a WaveJSON file, for WaveDrom: a lane a signal, in groups of
/// inputs, outputs and memory, and one with the time. A character stands for a
/// line of the scan table, a gap (`|`) for one of several scans.
std::string write_wavejson(const Program& program, const Trace& trace,
                           const std::vector<CellId>& signals,
                           const std::string& title);

/// The inputs of a run as a table for `run --stimulus`. Nothing when an input's
/// name cannot be a column there: it has a comma or a line end, or is `dt` or
/// `repeat`.
std::optional<std::string> write_stimulus(const Program& program,
                                          const Trace& trace);

}  // namespace rung
