#pragma once

#include <string>
#include <utility>
#include <vector>

#include "analysis/transition_system.h"

namespace rung {

/// A cell of the first program and the one of the second that is the same
/// signal; one of them may be missing.
struct SignalPair {
  CellId a;
  CellId b;
};

/// What two programs share, by name or as a map says.
struct SharedSignals {
  std::vector<SignalPair> inputs;   // all of both: one side may lack it
  std::vector<SignalPair> outputs;  // to be compared
  std::vector<SignalPair> cells;    // all others that have a partner
  std::vector<std::string> alone;   // outputs of one side only: "a.y3"
  std::string error;                // why they cannot be compared
};

/// `map` holds signals of the first program and of the second.
/// Errors: names that do not exist or are used twice, an input that the other
///         program writes, inputs or outputs of two types, ranges or scan
///         intervals, no output in common: in `error`.
SharedSignals share_signals(
    const Program& a, const Program& b,
    const std::vector<std::pair<std::string, std::string>>& map);

/// Copies of both programs in which elapsed times saturate at values that
/// follow from the presets alone, whatever their properties compare them with.
std::pair<Program, Program> with_common_caps(const Program& a,
                                             const Program& b);

/// State variables of two systems that may be equal in every scan.
struct StatePair {
  std::uint32_t a = 0;
  std::uint32_t b = 0;
};

/// Choices of two systems (VarRole::Choice) that stand for the same.
struct ChoicePair {
  VarId a;
  VarId b;
};

/// States of the same cell or of the same element by name, with equal types
/// and initial values.
std::vector<StatePair> states_by_name(const Program& a, const Program& b,
                                      const TransitionSystem& ts_a,
                                      const TransitionSystem& ts_b,
                                      const SharedSignals& shared);

}  // namespace rung
