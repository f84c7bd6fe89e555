#include "base/digest.h"

namespace rung {
namespace {

/// Little-endian, on every machine.
std::array<std::uint8_t, 8> bytes_of(std::uint64_t value) {
  std::array<std::uint8_t, 8> bytes{};
  for (std::uint8_t& byte : bytes) {
    byte = static_cast<std::uint8_t>(value & 0xffU);
    value >>= 8U;
  }
  return bytes;
}

}  // namespace

std::string to_string(const Digest& digest) {
  constexpr std::string_view kDigits = "0123456789abcdef";
  std::string text;
  for (const std::uint8_t byte : digest.bytes) {
    text += kDigits[byte >> 4U];
    text += kDigits[byte & 0xfU];
  }
  return text;
}

Hasher& Hasher::add(std::int64_t value) {
  const auto bytes = bytes_of(static_cast<std::uint64_t>(value));
  sha256_update(&state_, bytes.size(), bytes.data());
  return *this;
}

Hasher& Hasher::add(std::string_view text) {
  add(static_cast<std::int64_t>(text.size()));
  sha256_update(&state_, text.size(),
                reinterpret_cast<const std::uint8_t*>(text.data()));
  return *this;
}

Hasher& Hasher::add(const Digest& digest) {
  sha256_update(&state_, digest.bytes.size(), digest.bytes.data());
  return *this;
}

Digest Hasher::finish() {
  Digest digest;
  sha256_digest(&state_, digest.bytes.size(), digest.bytes.data());
  return digest;
}

}  // namespace rung
