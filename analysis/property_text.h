#pragma once

#include <string_view>
#include <vector>

#include "analysis/property_line.h"

namespace rung {

inline constexpr auto kNowhere = std::string_view::npos;

inline bool is_space(char c) {
  return c == ' ' || c == '\t' || c == '\r' || c == '\n';
}
inline bool is_digit(char c) { return c >= '0' && c <= '9'; }
/// Of a word in a property line.
bool is_word_part(char c);

/// The first place of `word` as a whole word outside of parentheses, where
/// something stands before it.
std::size_t find_word(std::string_view text, std::string_view word);
std::size_t find_last_word(std::string_view text, std::string_view word);

/// Splits at `separator` outside of parentheses.
std::vector<Slice> split(const Slice& slice, char separator);

}  // namespace rung
