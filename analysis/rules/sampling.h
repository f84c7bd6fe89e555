#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "analysis/transition_system.h"

namespace rung {

/// Random runs of `ts`, 64 at a time: which of `conditions` are false at the
/// end of some scan of one of them? A quick refutation of what is plainly not
/// always true, so that the solver is asked about the rest only. It proves
/// nothing, and a flag that it sets comes from a run that it has made.
/// Deterministic: the generator starts from a constant.
/// Limits: about `work` evaluations of terms.
std::vector<bool> sample(const TransitionSystem& ts,
                         const std::vector<ExprId>& conditions,
                         std::uint64_t work);

/// A bit cell that never comes to rest: in a sampled run, with all inputs held
/// from some scan on and no time passing, it changed again and again in the
/// kRestScans scans after as many to settle.
struct Unrest {
  CellId cell;
  std::vector<std::pair<CellId, std::int64_t>> held;  // the inputs
  bool every_scan = false;  // it changed in each of them
};
inline constexpr std::uint32_t kRestScans = 32;

std::vector<Unrest> sample_unrest(const TransitionSystem& ts,
                                  std::uint64_t work);

}  // namespace rung
