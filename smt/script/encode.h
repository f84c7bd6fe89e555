#pragma once

#include <string>
#include <unordered_map>
#include <vector>

#include "smt/script/gates.h"
#include "smt/script/syntax.h"

namespace rung::script {

/// A script as clauses.
struct Encoded {
  Gates gates;
  std::unordered_map<std::string_view, int> bools;  // literal of each symbol
  std::string error;  // not empty: no encoding, and why
};

/// A word that nothing bounds has no encoding; the states of the first frame
/// are bounded by what `initial` and `hypothesis` imply.
/// Precondition: every question assumes one of these two.
Encoded encode(const Script& script);

}  // namespace rung::script
