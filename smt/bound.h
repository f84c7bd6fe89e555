#pragma once

#include "analysis/program.h"
#include "analysis/property.h"
#include "analysis/response.h"
#include "smt/verify.h"

namespace rung {

/// The longest and the shortest time from P to Q, over all runs.
///
/// Worst: the least N for which `after P, Q within N` holds. Best: the greatest
/// N for which `after P, no Q for N` does, P's rise standing for P. Both are
/// asked of verify(), so what is said is proved with a checked certificate and
/// shown by a run that the simulator executed. Runs that are found say at once
/// how long their waits are, so a bound is seldom searched for step by step.
///
/// In scans, numbers that follow from the times are taken from there; beyond
/// kMostScans they are not searched for.
inline constexpr std::int64_t kMostScans = 200;

/// `properties`: only its assumptions are read. `options.budget` is for all.
ResponseBounds find_bounds(const Program& program,
                           const PropertySet& properties,
                           const ResponseQuestion& question,
                           const VerifyOptions& options);

}  // namespace rung
