#include "analysis/build_program_number.h"

#include <algorithm>
#include <cassert>
#include <charconv>
#include <utility>

namespace rung::build {
namespace {

Wide greatest_common_divisor(Wide a, Wide b) {
  while (b != 0) a = std::exchange(b, a % b);
  return a < 0 ? -a : a;
}

std::optional<Fraction> parse_hexadecimal(std::string_view digits) {
  std::int64_t value = 0;
  const char* const end = digits.data() + digits.size();
  const auto result = std::from_chars(digits.data(), end, value, 16);
  if (result.ec != std::errc() || result.ptr != end) return std::nullopt;
  return make_fraction(value, 1);
}

/// 0 to 19 as a power; no parts beyond that fit anyway.
Wide power_of_ten(std::int64_t exponent) {
  Wide power = 1;
  for (std::int64_t i = 0; i < exponent; ++i) power *= 10;
  return power;
}

/// The exponent after `e`; anything huge is the same as large.
std::int64_t parse_exponent(std::string_view text) {
  constexpr std::int64_t kHuge = 1'000'000'000'000;
  const bool negative = text.starts_with('-');
  if (negative || text.starts_with('+')) text.remove_prefix(1);
  std::int64_t value = 0;
  for (const char c : text) {
    value = std::min<std::int64_t>(value * 10 + (c - '0'), kHuge);
  }
  return negative ? -value : value;
}

}  // namespace

std::optional<Fraction> make_fraction(Wide numerator, Wide denominator) {
  if (denominator == 0) return std::nullopt;
  if (denominator < 0) {
    numerator = -numerator;
    denominator = -denominator;
  }
  const Wide common = greatest_common_divisor(numerator, denominator);
  numerator /= common;
  denominator /= common;
  if (numerator > kMaxPart || numerator < -kMaxPart || denominator > kMaxPart) {
    return std::nullopt;
  }
  return Fraction{static_cast<std::int64_t>(numerator),
                  static_cast<std::int64_t>(denominator)};
}

std::optional<Fraction> add(const Fraction& a, const Fraction& b) {
  return make_fraction(
      Wide{a.numerator} * b.denominator + Wide{b.numerator} * a.denominator,
      Wide{a.denominator} * b.denominator);
}

std::optional<Fraction> multiply(const Fraction& a, const Fraction& b) {
  return make_fraction(Wide{a.numerator} * b.numerator,
                       Wide{a.denominator} * b.denominator);
}

std::optional<Fraction> divide(const Fraction& a, const Fraction& b) {
  return make_fraction(Wide{a.numerator} * b.denominator,
                       Wide{a.denominator} * b.numerator);
}

std::optional<Fraction> parse_number(std::string_view text) {
  if (text.starts_with("0x") || text.starts_with("0X")) {
    return parse_hexadecimal(text.substr(2));
  }
  // Zeros at the end of the digits are counted first and written out only
  // when a digit follows, so 1000000000000000000000e-20 and 0.50 are read.
  Wide digits = 0;
  std::int64_t exponent = 0;
  std::int64_t zeros = 0;
  bool fraction = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (c == '.') {
      fraction = true;
      continue;
    }
    if (c == 'e' || c == 'E') {
      exponent += parse_exponent(text.substr(i + 1));
      break;
    }
    if (fraction) --exponent;
    ++zeros;
    if (c == '0') continue;
    if (digits != 0 && zeros > 18) return std::nullopt;
    digits = digits * power_of_ten(digits == 0 ? 0 : zeros) + (c - '0');
    zeros = 0;
    if (digits > kMaxPart) return std::nullopt;
  }
  exponent += zeros;
  if (digits == 0) return Fraction{};
  if (exponent > 18 || exponent < -18) return std::nullopt;
  return exponent >= 0 ? make_fraction(digits * power_of_ten(exponent), 1)
                       : make_fraction(digits, power_of_ten(-exponent));
}

bool is_power_of_two(std::int64_t value) {
  return value > 0 && (value & (value - 1)) == 0;
}

std::int64_t floor_of(const Fraction& value) {
  const std::int64_t whole = value.numerator / value.denominator;
  const bool below = value.numerator % value.denominator < 0;
  return below ? whole - 1 : whole;
}

std::int64_t ceiling_of(const Fraction& value) {
  return -floor_of(negate(value));
}

}  // namespace rung::build
