#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "base/diagnostic.h"

namespace rung {

/// Sorts them, and takes those away that are there twice. False: two of them
/// overlap or insert at one place, so that their order would matter.
bool make_disjoint(std::vector<Edit>& edits);

/// Precondition: make_disjoint(edits), all within the text.
std::string apply_edits(std::string_view text, const std::vector<Edit>& edits);

}  // namespace rung
