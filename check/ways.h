#pragma once

#include <string>
#include <vector>

#include "check/script.h"

namespace rung::check {

/// A certificate that some run leads to `goal` from everywhere: regions, each
/// with a choice of inputs, as docs/certificates.md has them ("Q0 && T(0).x >=
/// 4900: I1 = 1, dt = 100"). What is to be shown of them, made anew:
struct Ways {
  Value arrives;  // every scan ends with the goal or in a region
  /// From each region the chosen inputs lead to the goal, or to a region
  /// before it, or to itself with a clock that grows, and cannot for ever. The
  /// assumptions are not assumed: the inputs have to meet them.
  std::vector<Claim> leads_on;
  std::string error;  // a text that is no region
};

Ways read_ways(const std::vector<std::string>& texts, Value goal, Model& model);

}  // namespace rung::check
