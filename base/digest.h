#pragma once

#include <nettle/sha2.h>

#include <array>
#include <compare>
#include <cstdint>
#include <string>
#include <string_view>

namespace rung {

/// A SHA-256: what has the same one is the same.
struct Digest {
  std::array<std::uint8_t, SHA256_DIGEST_SIZE> bytes{};
  friend auto operator<=>(const Digest&, const Digest&) = default;
};

/// 64 lower-case hexadecimal digits.
std::string to_string(const Digest& digest);

/// Makes a digest of a sequence of values. A text is preceded by its length, so
/// no two sequences of the same kinds of values are the same bytes.
class Hasher {
 public:
  Hasher() { sha256_init(&state_); }
  Hasher& add(std::string_view text);
  Hasher& add(std::int64_t value);
  Hasher& add(const Digest& digest);
  /// Ends it; the hasher begins anew.
  Digest finish();

 private:
  sha256_ctx state_;
};

}  // namespace rung
