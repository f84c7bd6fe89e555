#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "analysis/transition_system.h"

namespace rung {

/// What is asked: is `goal` true at infinitely many scan ends of every infinite
/// run on which `fair` is? Terms of a scan's end; no `fair`: of every run.
struct Recurrence {
  ExprId goal;
  ExprId fair;
  std::int64_t counts = 0;  // that counters below count to, all together
};

/// A copy of the system with monitors, and what is asked of it: where no scan
/// ends with `bad`, the goal comes again and again.
struct LivenessQuestion {
  TransitionSystem ts;
  ExprId bad;
  VarId save;  // of a loop: the scan that it begins with
  std::string engine;
};

/// Does the goal come within `time` ms of `fair`, or of the goal before?
LivenessQuestion ask_response(const TransitionSystem& ts,
                              const Recurrence& asked, std::int64_t time);

/// Are there no more than `most` moments between two goals? A moment is a
/// scan's end with `fair` and `time` ms or more after the goal or the last
/// moment. A scan takes time, so they come again and again if `fair` does.
LivenessQuestion ask_count(const TransitionSystem& ts, const Recurrence& asked,
                           std::int64_t time, std::int64_t most);

/// Is there no loop: a state that comes again, with `fair` and without the goal
/// on the way? Words are bounded and clocks saturate, so every run is caught in
/// one at last.
///
/// Exactly: all of the state is written down when the loop begins, and is there
/// again when it ends; what is found is a run for ever.
///
/// OfBits: only its bits are. Of numbers that are the same again it is only
/// noted that what went up also went down, and of a clock that it stopped or
/// was set back on the way, or is at its cap, for else time has moved it. So
/// nothing is said by what is found, and a proof does not depend on presets.
/// Preconditions: a scan takes 1 ms or more.
enum class Loops : std::uint8_t { Exactly, OfBits };
LivenessQuestion ask_loop(const TransitionSystem& ts, const Recurrence& asked,
                          Loops loops);

/// The variables that `asked` depends on, by VarId index.
std::vector<bool> cone_of(const TransitionSystem& ts, const Recurrence& asked);

}  // namespace rung
