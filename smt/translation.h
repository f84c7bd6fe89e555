#pragma once

#include <string>
#include <utility>
#include <vector>

#include "analysis/program.h"
#include "smt/equivalence.h"

namespace rung {

/// What a translator says of its work; nothing in it is believed.
struct TranslationClaim {
  /// Name in the source, name in the result. Signals that are not listed have
  /// one name in both.
  std::vector<std::pair<std::string, std::string>> signals;
  std::vector<std::pair<std::string, std::string>> elements;
  std::vector<StateRelation> relations;
};

struct TranslationCheck {
  std::string lost;  // a declaration that differs; empty: none
  EquivalenceResult result;
};

/// Is `written`, what a translation gave, its source? Every signal that the
/// source's rungs write is there, and every input but those that make no
/// difference, with its direction, its type and its range;
/// and each that a rung writes has the same value at every scan's end. Cells
/// that a reader or the translator made are not compared.
TranslationCheck check_translation(Program source, Program written,
                                   const TranslationClaim& claim,
                                   const EquivalenceOptions& options);

}  // namespace rung
