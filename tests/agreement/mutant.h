#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "analysis/program.h"
#include "comparison.h"

namespace rung {

/// The encoding with one mistake in it.
struct Mutant {
  std::string name;
  /// What the engines would be given in place of the program; no value where
  /// the program has nothing that the mistake is about.
  std::function<std::optional<Encoding>(const Program&)> encode;
};

/// One place of one formula of element_kinds(), changed.
std::vector<Mutant> element_mutants();

/// One rule by which rungs, calls and cells are encoded, changed: the program
/// that is encoded is made to differ from the one that is meant.
std::vector<Mutant> program_mutants();

/// One state or term of the finished transition system, changed.
std::vector<Mutant> system_mutants();

/// `text` with one operator, operand or constant changed, in every way.
/// Names of `bits` are also negated.
std::vector<std::string> mutated_formulas(
    std::string_view text, const std::vector<std::string_view>& bits);

}  // namespace rung
