#pragma once

#include <array>

#include "check/elements.h"

namespace rung::check {

/// What the function blocks of IEC 61131-3 have in common, whoever wrote them.

/// Is it true, and was not at the last execution? `state` remembers it.
inline Value rises(Element& e, std::size_t state, Value input) {
  const Value before = e[state];
  e[state] = input;
  return input & ~before;
}

inline std::int64_t least_int(std::int64_t) { return -32768; }
inline std::int64_t most_int(std::int64_t) { return 32767; }
inline std::int64_t nought(std::int64_t) { return 0; }

inline constexpr std::size_t kCount = 0;
inline constexpr std::size_t kUpEdge = 1;
inline constexpr std::size_t kUpOut = 2;
inline constexpr std::size_t kDownEdge = 2;
inline constexpr std::size_t kBothOut = 3;

inline constexpr std::array<ElementState, 3> kUpCounterStates = {
    {{"value", StateShape::Count, nought, most_int}, {"last"}, {"out"}}};
inline constexpr std::array<ElementState, 3> kDownCounterStates = {
    {{"value", StateShape::Count, least_int, most_int}, {"last"}, {"out"}}};
inline constexpr std::array<ElementState, 4> kBothCounterStates = {
    {{"value", StateShape::Count, least_int, most_int},
     {"last_up"},
     {"last_down"},
     {"out"}}};

inline Value count_value(Element& e) { return e[kCount]; }
inline Value count_is_zero(Element& e) { return e[kCount] <= 0; }
inline Value up_is_out(Element& e) { return e[kUpOut]; }
inline Value both_is_out(Element& e) { return e[kBothOut]; }

}  // namespace rung::check
