#pragma once

#include <string>
#include <string_view>

#include "analysis/program.h"
#include "analysis/simulator.h"
#include "analysis/trace.h"
#include "reports/text.h"

namespace rung {

/// What `run FILE` shows.
struct RunReport {
  std::string path;
  std::string_view version;
  const Program& program;
  Trace trace;
  bool inputs_rest = false;  // no stimulus: no input changes
};

/// The run with a step for each scan in which something changed, and one for
/// each stretch between them in which nothing did.
Trace changes_of(const Stimulus& stimulus, const Recording& recording);

/// A scan table of every signal that ever changes; at most kMaxRows rows.
inline constexpr std::size_t kMaxRows = 2000;
std::string write_text(const RunReport& report, const TextOptions& options);

/// Schema rungproof.run/1: the trace, as in rungproof.result/1.
std::string write_json(const RunReport& report);

}  // namespace rung
