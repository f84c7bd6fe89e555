#pragma once

#include <cstdint>
#include <vector>

#include "smt/invariant.h"
#include "smt/signals.h"

namespace rung {

/// When outputs have to be equal.
struct Comparison {
  /// Those of the second are compared with those of the first that many scans
  /// ago; before the first scan these have their initial values.
  std::uint32_t delay = 0;
  /// Only in scans that begin and end in the same state, on inputs that were
  /// there in the scan before: nothing moves any more, no timer runs.
  bool settled = false;
};

/// Two systems in lock-step, on the same inputs and dt, as one. Variables of
/// one side are named `a.x` and `b.x`; shared inputs keep their name. The cell
/// of an input is its index in SharedSignals::inputs.
struct Product {
  TransitionSystem ts;
  std::vector<std::uint32_t> state_a;  // by state of the first: its index here
  std::vector<std::uint32_t> state_b;
  std::vector<std::uint32_t> history;  // states that only the product has
  std::vector<ExprId> same;  // by shared output: equal at a scan's end
};

/// Pairs that are one variable in a product, that of the first system: sound
/// where they are known to be equal in every scan.
struct Merged {
  std::vector<StatePair> states;
  std::vector<ChoicePair> choices;
};

Product make_product(const TransitionSystem& a, const TransitionSystem& b,
                     const SharedSignals& shared, const Merged& merged,
                     const Comparison& comparison = {});

/// An invariant of `reduced`, a product with merged states, over the variables
/// of `whole`, the product of the same systems without: its lemmas, and its k.
Invariant widen_invariant(const Product& reduced, const Invariant& invariant,
                          Product& whole);

}  // namespace rung
