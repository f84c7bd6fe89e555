#include "reports/fingerprint.h"

#include <fmt/format.h>

#include <cstdint>

namespace rung {
namespace {

/// FNV-1a, 64 bits: the same on every machine and for ever.
class Hash {
 public:
  void add(char byte) {
    value_ = (value_ ^ static_cast<unsigned char>(byte)) * 0x100000001b3ULL;
  }
  void add(std::string_view text) {
    for (const char byte : text) add(byte);
    add('\0');
  }
  std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_ = 0xcbf29ce484222325ULL;
};

}  // namespace

std::string Fingerprints::next(std::string_view rule, std::string_view path,
                               std::string_view line) {
  Hash hash;
  hash.add(rule);
  hash.add(path);
  for (const char byte : line) {
    if (byte != ' ' && byte != '\t' && byte != '\r') hash.add(byte);
  }
  std::string key = fmt::format("{:016x}", hash.value());
  const int occurrence = ++seen_[key];
  return fmt::format("{}:{}", key, occurrence);
}

}  // namespace rung
