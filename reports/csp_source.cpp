#include <cstdint>

#include "reports/assets.h"

namespace rung {
namespace {

std::uint32_t digit_value(char digit) {
  return static_cast<std::uint32_t>(digit <= '9' ? digit - '0'
                                                 : digit - 'a' + 10);
}

/// Three hexadecimal digits are two of base 64.
std::string base64_of_hex(std::string_view hex) {
  constexpr std::string_view kDigits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  for (std::size_t at = 0; at < hex.size(); at += 3) {
    std::uint32_t bits = 0;
    for (std::size_t i = at; i < at + 3; ++i) {
      bits = bits << 4U | (i < hex.size() ? digit_value(hex[i]) : 0U);
    }
    out += kDigits[bits >> 6U];
    if (hex.size() - at > 1) out += kDigits[bits & 63U];
  }
  while (out.size() % 4 != 0) out += '=';
  return out;
}

}  // namespace

std::string csp_source(const Asset& asset) {
  return "'sha256-" + base64_of_hex(asset.sha256) + "'";
}

}  // namespace rung
