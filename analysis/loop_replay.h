#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "analysis/property.h"
#include "analysis/trace.h"

namespace rung {

/// A run for ever: the stem, then the loop again and again.
struct Lasso {
  Stimulus stem;
  Stimulus loop;
};

/// What the outcome of a property depends on, and so has to be back when the
/// loop comes round.
struct Returning {
  std::vector<CellId> cells;
  std::vector<InstanceId> instances;
};

/// Executes a lasso on the simulator, three rounds of its loop, and reads the
/// `eventually` line of `property` anew. Does the loop keep away from the goal
/// (unless `may_meet_goal`), is each of what is given as fair true in every
/// round, do the assumptions hold, and is every round the same as the one
/// before? Empty: yes; else what is wrong.
std::string refuted_loop(const Program& program, const PropertySet& properties,
                         std::uint32_t property, const Lasso& lasso,
                         const Returning& returning, bool may_meet_goal);

/// The run of a lasso up to the end of its first round, as simulate_changes()
/// has it.
Trace trace_of(const Program& program, const Lasso& lasso);

}  // namespace rung
