#pragma once

#include <cstdint>
#include <vector>

#include "smt/cone.h"
#include "smt/region.h"
#include "smt/sat.h"
#include "smt/slice_state.h"

namespace rung {

/// Bounds of `state` that no scan leaves once they hold, whatever its inputs,
/// and while they hold none ends with `bad`, a term; as few as will do. Empty:
/// there are none that are found by dropping what a scan breaks.
///
/// Source: Flanagan, Leino, "Houdini, an Annotation Assistant for ESC/Java",
///         FME 2001.
std::vector<Bound> trap_around(TransitionSystem& ts, Cone& cone, ExprId bad,
                               const SliceState& state,
                               const Deadline& deadline);

/// Every bound that holds of `state` alone, over the states of the cone.
std::vector<Bound> exactly(const Cone& cone, const SliceState& state);

}  // namespace rung
