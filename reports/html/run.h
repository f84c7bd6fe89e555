#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "analysis/program.h"
#include "analysis/trace.h"
#include "base/source.h"
#include "reports/locate.h"

namespace rung {

/// A run for the page: its scan table, the rungs that decided it as ladders
/// with their values in the last scan, and the values of every scan for the
/// page's script.
struct HtmlRun {
  const SourceSet& sources;
  const Program& program;
  const Trace& trace;
  std::vector<CellId> signals;
  std::vector<RungId> rungs;    // at most kMaxRungs are drawn
  std::string file_id;          // of the section: "file-1"
  std::string_view end;         // what the last scan is: "violated"
  bool ends_badly = false;      // that is marked as bad
  std::vector<CellId> differs;  // signals that must not be as they end
  bool is_drawn = true;         // else the script draws the rungs
};

/// The script's values: the lines of the table, the signals, and of each rung
/// its nets and symbols, in the order of draw_rung_svg():
///
///     {"scan":[1,2],"repeat":[1,1],
///      "signals":[{"name":"I0","kind":"input","word":false,"initial":0,
///                  "values":[1,0]}],
///      "rungs":[{"rung":3,"power":["11","10"],"values":[[1,0],[1,1]]}]}
///
/// Runs with more values than this have none: they are tables only.
inline constexpr std::size_t kMaxValues = 200'000;

std::string write_html(const HtmlRun& run, Locator& locator);

}  // namespace rung
