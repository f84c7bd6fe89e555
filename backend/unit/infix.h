#pragma once

#include <string>
#include <string_view>

#include "backend/unit/unit.h"

namespace rung::backend {

/// How a language spells expressions with operators between their operands.
struct InfixSpelling {
  std::string_view and_sign = " AND ";
  std::string_view or_sign = " OR ";
  std::string_view xor_sign = " XOR ";
  std::string_view not_sign = "NOT ";
  std::string_view equal = " = ";
  std::string_view not_equal = " <> ";
  std::string_view true_word = "TRUE";
  std::string_view false_word = "FALSE";
};

/// Appends the expression, with parentheses around comparisons and wherever
/// a reader could ask. Linear, no recursion.
void append_infix(std::string& text, const Unit& unit, const Terms& terms,
                  const InfixSpelling& spelling);

}  // namespace rung::backend
