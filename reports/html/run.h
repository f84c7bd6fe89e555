#pragma once

#include <string>
#include <vector>

#include "analysis/program.h"
#include "analysis/trace.h"
#include "base/source.h"
#include "reports/locate.h"

namespace rung {

/// A run of a program on a page: the scan table, and beside it `rungs` (at most
/// kMaxRungs, see rung_values.h) as ladders with the values of the last scan.
struct HtmlRun {
  const SourceSet& sources;
  const Program& program;
  const Trace& trace;
  std::vector<CellId> signals;
  std::vector<RungId> rungs;
};
std::string write_html(const HtmlRun& run, Locator& locator);

}  // namespace rung
