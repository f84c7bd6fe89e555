#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "smt/invariant.h"
#include "smt/portfolio.h"
#include "smt/target.h"

namespace rung {

/// What the engines say of one group of targets, beside what they wrote into
/// them.
struct GroupAnswer {
  Invariant invariant;    // shows the unreachable ones
  bool overflow = false;  // their terms have no exact encoding
  double milliseconds = 0;
};

/// Lets the engines decide groups of targets that share no state, `jobs` at a
/// time. Every group starts from the same terms, so that its answer depends
/// neither on how many others there are nor on which of them was done first.
///
/// Errors: never throws for an engine's sake: the targets of the group are open
/// then, and Target::failure says why.
std::vector<GroupAnswer> decide_side_by_side(
    TransitionSystem& ts, const std::vector<ExprId>& growth,
    const std::vector<std::vector<Target*>>& groups,
    const PortfolioOptions& options, std::uint32_t jobs,
    const std::function<void(std::size_t)>& progress);

}  // namespace rung
