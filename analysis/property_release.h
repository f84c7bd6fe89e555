#pragma once

#include <optional>
#include <string_view>

#include "analysis/property_terms.h"

namespace rung {

/// Can one scan release a latch? Looks for values of the inputs with which the
/// scan after any state with Q ends without Q: then the returned term, over
/// the state only, is true in every such state. A proof of it as an invariant
/// proves that Q is releasable; where it fails nothing is known.
///
/// The choice is one for all states: the inputs that make `reset` true, the
/// others 0, the scan as short as it may be. No value: none of the choices
/// that are tried fits, or the assumptions may forbid it.
/// Limits: a few times the cone of Q in one scan.
std::optional<ExprId> release_condition(PropertyTerms& terms,
                                        std::string_view latch,
                                        std::string_view reset);

}  // namespace rung
