#pragma once

#include <cstdint>
#include <vector>

#include "smt/signals.h"

namespace rung {

/// What a claim of equality by structure speaks of: two systems, the inputs
/// and states that are taken as equal, and what is to be shown.
struct TwoSystems {
  const TransitionSystem& a;
  const TransitionSystem& b;
  const SharedSignals& shared;
};

/// Terms of the second system with an equal term of the first: the same
/// operator over equal operands, down to inputs that both share and states
/// that are equal. With `states` it is its own proof, by induction over scans:
/// each pair has one initial value, and equal next terms.
struct Correspondence {
  std::vector<StatePair> states;
  std::vector<ExprId> image;  // by term of the second; no value: none is known
  bool outputs_equal = false;
  bool faults_equal = false;  // every fault of one side is one of the other
};

/// The largest correspondence within `candidates`: pairs whose next terms
/// differ are taken out until the rest stands.
/// Source: van Eijk, "Sequential Equivalence Checking Based on Structural
///         Similarities", IEEE TCAD 19(7), 2000, without its solver.
/// Limits: linear in the terms for each round; pairs may be lost when rounds
///         run out (never added).
Correspondence correspond(const TwoSystems& systems,
                          std::vector<StatePair> candidates);

/// Choices of the second system that are one of the first: those of elements of
/// which every state is in `states`, a right correspondence.
std::vector<ChoicePair> shared_choices(const TwoSystems& systems,
                                       const std::vector<StatePair>& states);

/// Checks a correspondence pair by pair, without search or hashing: all that
/// has to be believed of it. Empty when it is right, else what is wrong.
std::string check_correspondence(const TwoSystems& systems,
                                 const Correspondence& claim);

}  // namespace rung
