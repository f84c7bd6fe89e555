#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace rung::build {

/// Numbers in scripts as exact fractions; numerator and denominator stay
/// within kMaxPart. The denominator is positive, and the two have no common
/// factor.
struct Fraction {
  std::int64_t numerator = 0;
  std::int64_t denominator = 1;
  bool is_whole() const { return denominator == 1; }
};

inline constexpr std::int64_t kMaxPart = std::int64_t{1} << 60;

/// Integers up to here are exact in a double.
inline constexpr std::int64_t kMaxExact = std::int64_t{1} << 53;

/// 128 bits: products of two parts are exact.
__extension__ using Wide = __int128;

/// Reduced; no value when a part is too large or the denominator is 0.
std::optional<Fraction> make_fraction(Wide numerator, Wide denominator);

std::optional<Fraction> add(const Fraction& a, const Fraction& b);
std::optional<Fraction> multiply(const Fraction& a, const Fraction& b);
std::optional<Fraction> divide(const Fraction& a, const Fraction& b);
inline Fraction negate(const Fraction& a) {
  return {-a.numerator, a.denominator};
}

/// The value of a number token: decimal with fraction and exponent, or hex.
std::optional<Fraction> parse_number(std::string_view text);

/// Is it a sum of powers of two, so that a double holds it exactly (below
/// kMaxExact)?
bool is_power_of_two(std::int64_t value);

std::int64_t floor_of(const Fraction& value);
std::int64_t ceiling_of(const Fraction& value);

}  // namespace rung::build
