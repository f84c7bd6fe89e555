#pragma once

#include <optional>
#include <string>

#include "smt/equivalence.h"

namespace rung {

/// One change of the second program that makes it equivalent to the first: a
/// contact negated, `&&` for `||`, a number or a preset of the first, two rungs
/// in the other order.
struct Blame {
  SourceRange where;    // in the second program
  std::string message;  // "with this contact negated the programs are the same"
};

/// `different` is what check_equivalence() said. Changes that the run found
/// does not tell from the first program are proved; the first in the order of
/// the program that holds is returned, nothing when none does within `seconds`.
std::optional<Blame> find_blame(const Program& a, const Program& b,
                                const EquivalenceOptions& options,
                                const EquivalenceResult& different,
                                double seconds);

}  // namespace rung
