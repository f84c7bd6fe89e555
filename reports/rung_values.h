#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "analysis/program.h"
#include "analysis/simulator.h"
#include "analysis/trace.h"
#include "base/source.h"
#include "reports/locate.h"
#include "reports/paint.h"

namespace rung {

/// A simulator that has run `trace`, for pictures of its last scan. Null when
/// the run is too long to be executed again for that, or is none of `program`.
std::unique_ptr<Simulator> run_again(const Program& program,
                                     const Trace& trace);

/// The same, and `at_step` is called behind the last scan of each step, with
/// the step's index.
using StepVisitor = std::function<void(std::size_t, const Simulator&)>;
bool run_again(const Program& program, const Trace& trace,
               const StepVisitor& at_step);

/// Rungs with the value of each operand under it, as the simulator has them in
/// the last scan of `trace`:
///
///     3 | Q0 = (I0 || Q0) && !I1;
///       | 1     0     1       0
///
/// An operand that was skipped (short-circuit) has a `-`. At most kMaxRungs
/// rungs are drawn. Empty when the run is too long to be executed again for a
/// picture, or the trace is not a run of the program.
inline constexpr std::size_t kMaxRungs = 6;
struct RungValues {
  const SourceSet& sources;
  const Program& program;
  const Trace& trace;
  std::vector<RungId> rungs;
};
std::string draw_rung_values(const RungValues& values, const Painter& paint,
                             Locator& locator);

}  // namespace rung
