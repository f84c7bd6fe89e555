#pragma once

#include <cstdint>
#include <cstdlib>

namespace rung {

/// How many of something random a test makes: the environment's number.
inline std::uint64_t setting(const char* name, std::uint64_t otherwise) {
  const char* const text = std::getenv(name);
  return text == nullptr ? otherwise : std::strtoull(text, nullptr, 10);
}

}  // namespace rung
