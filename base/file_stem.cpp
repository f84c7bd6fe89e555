#include "base/file_stem.h"

namespace rung {

std::string file_stem(std::string_view name) {
  constexpr std::size_t kLongest = 200;
  std::string stem;
  for (const char c : name.substr(0, kLongest)) {
    const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
                       (c >= '0' && c <= '9') || c == '-' || c == '_' ||
                       (c == '.' && !stem.empty());
    stem += plain ? c : '_';
  }
  return stem.empty() ? "unnamed" : stem;
}

}  // namespace rung
