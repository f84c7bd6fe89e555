#include "frontend/stl/literals.h"

#include <algorithm>
#include <array>
#include <charconv>

namespace rung::stl {
namespace {

std::optional<std::int64_t> number_of(std::string_view digits, int base,
                                      std::int64_t low, std::int64_t high) {
  std::int64_t value = 0;
  const char* const end = digits.data() + digits.size();
  const auto read = std::from_chars(digits.data(), end, value, base);
  const bool whole = read.ec == std::errc{} && read.ptr == end;
  if (digits.empty() || !whole || value < low || value > high) return {};
  return value;
}

/// A number of three decimal digits as four bits each.
std::uint32_t bcd_of(std::int64_t number) {
  return static_cast<std::uint32_t>(number + 6 * (number / 10) +
                                    96 * (number / 100));
}

struct Unit {
  std::string_view name;
  std::int64_t milliseconds;
};
// In the order in which they stand in a time.
constexpr std::array<Unit, 4> kUnits = {
    {{"H", 3'600'000}, {"M", 60'000}, {"S", 1'000}, {"MS", 1}}};

std::optional<std::int64_t> milliseconds_of(std::string_view text) {
  std::int64_t total = 0;
  std::size_t next_unit = 0;
  if (text.empty()) return std::nullopt;
  while (!text.empty()) {
    const std::size_t digits =
        std::min(text.find_first_not_of("0123456789"), text.size());
    const auto number = number_of(text.substr(0, digits), 10, 0, 9'990'000);
    text.remove_prefix(digits);
    const std::size_t letters =
        std::min(text.find_first_of("0123456789"), text.size());
    std::size_t unit = next_unit;
    while (unit < kUnits.size() &&
           kUnits.at(unit).name != text.substr(0, letters)) {
      ++unit;
    }
    if (!number || unit == kUnits.size()) return std::nullopt;
    total += *number * kUnits.at(unit).milliseconds;
    next_unit = unit + 1;
    text.remove_prefix(letters);
  }
  return total;
}

/// A time that the format has exactly.
std::optional<std::uint32_t> s5_word(std::string_view text) {
  const auto time = milliseconds_of(text);
  if (!time) return std::nullopt;
  std::int64_t base = 10;
  for (std::uint32_t code = 0; code < 4; ++code, base *= 10) {
    if (*time > 999 * base) continue;
    if (*time % base != 0) return std::nullopt;
    return (code << 12U) | bcd_of(*time / base);
  }
  return std::nullopt;
}

std::optional<std::uint32_t> bits_of(std::optional<std::int64_t> value) {
  if (!value) return std::nullopt;
  return static_cast<std::uint32_t>(*value);
}

}  // namespace

std::optional<std::uint32_t> literal_of(std::string_view text) {
  struct Prefix {
    std::string_view name;
    int base;
    std::int64_t low;
    std::int64_t high;
  };
  constexpr std::array<Prefix, 5> kPrefixes = {{
      {"2#", 2, 0, 0xffff'ffff},
      {"B#16#", 16, 0, 0xff},
      {"W#16#", 16, 0, 0xffff},
      {"DW#16#", 16, 0, 0xffff'ffff},
      {"L#", 10, -2'147'483'648, 2'147'483'647},
  }};
  for (const Prefix& prefix : kPrefixes) {
    if (!text.starts_with(prefix.name)) continue;
    return bits_of(number_of(text.substr(prefix.name.size()), prefix.base,
                             prefix.low, prefix.high));
  }
  if (text.starts_with("C#") || text.starts_with("Z#")) {
    const auto count = number_of(text.substr(2), 10, 0, 999);
    if (!count) return std::nullopt;
    return bcd_of(*count);
  }
  if (text.starts_with("S5T#")) return s5_word(text.substr(4));
  if (text.starts_with("S5TIME#")) return s5_word(text.substr(7));
  // An INT: the upper half is 0.
  const bool plus = text.starts_with("+") && !text.starts_with("+-");
  const auto number =
      number_of(plus ? text.substr(1) : text, 10, -32'768, 32'767);
  if (!number) return std::nullopt;
  return static_cast<std::uint32_t>(*number) & 0xffffU;
}

std::optional<std::int64_t> count_of(std::uint32_t word) {
  std::int64_t value = 0;
  for (int digit = 2; digit >= 0; --digit) {
    const std::uint32_t bits =
        (word >> (4U * static_cast<unsigned>(digit))) & 0xfU;
    if (bits > 9) return std::nullopt;
    value = 10 * value + bits;
  }
  if ((word & 0xffffU) > 0x999) return std::nullopt;
  return value;
}

std::optional<std::int64_t> s5time_of(std::uint32_t word) {
  const auto count = count_of(word & 0xfffU);
  if (!count || (word & 0xc000U) != 0) return std::nullopt;
  std::int64_t base = 10;
  for (std::uint32_t code = (word >> 12U) & 3U; code > 0; --code) base *= 10;
  return *count * base;
}

}  // namespace rung::stl
