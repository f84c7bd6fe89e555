#pragma once

#include <vector>

#include "smt/induction.h"
#include "smt/product.h"

namespace rung {

/// Pairs of states that are equal at every scan's end, as far as one joint
/// induction shows it, and outputs that are equal with their help.
struct EqualStates {
  std::vector<StatePair> pairs;
  std::vector<bool> outputs;  // by Product::same
  bool all_outputs = false;
};

/// Candidates are `by_name`, and pairs that stay equal in random runs.
/// Source: van Eijk, "Sequential Equivalence Checking Based on Structural
///         Similarities", IEEE TCAD 19(7), 2000.
EqualStates find_equal_states(const TransitionSystem& a,
                              const TransitionSystem& b, Product& product,
                              const std::vector<StatePair>& by_name,
                              const Deadline& deadline);

}  // namespace rung
