#pragma once

#include <vector>

#include "smt/induction.h"
#include "smt/product.h"

namespace rung {

/// Guesses, to be proved: pairs of states that stayed equal in random runs of
/// the product in which nothing is merged yet.
struct EqualGuesses {
  std::vector<StatePair> likely;  // at most one for a state of the second
  std::vector<StatePair> more;
};
EqualGuesses guess_equal_states(const TransitionSystem& a,
                                const TransitionSystem& b,
                                const Product& product,
                                const std::vector<StatePair>& by_name);

/// Pairs of states that are equal at every scan's end, as far as one joint
/// induction shows it, and outputs that are equal with their help.
struct EqualStates {
  std::vector<StatePair> pairs;
  bool all_outputs = false;
  std::vector<bool> lemma_holds;  // by lemma
};

/// `lemmas` are further guesses, about states of any kind.
///
/// Source: van Eijk, "Sequential Equivalence Checking Based on Structural
///         Similarities", IEEE TCAD 19(7), 2000.
EqualStates find_equal_states(Product& product,
                              const std::vector<StatePair>& guesses,
                              const std::vector<ExprId>& lemmas,
                              const Deadline& deadline);

}  // namespace rung
