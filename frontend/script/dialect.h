#pragma once

#include <string_view>

#include "frontend/error_limit.h"
#include "frontend/script/token.h"

namespace rung::script {

/// The dialect of a script: "yun" or "sim". `given` (may be empty) decides,
/// then a `//@ dialect` line, then the names that the rungs use; a script with
/// no such name is "sim".
/// Errors: an unknown dialect, and names of both, are reported (RP004); the
///         result is then the first of the two.
std::string_view find_dialect(const TokenList& list, std::string_view given,
                              ErrorLimit& errors);

}  // namespace rung::script
