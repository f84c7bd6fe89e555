#include "frontend/token_list.h"

#include <cstddef>

namespace rung {

std::string quoted_excerpt(std::string_view text) {
  constexpr std::size_t kLongest = 40;
  if (text.size() <= kLongest) return "`" + std::string(text) + "`";
  std::size_t end = kLongest;
  while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xc0U) == 0x80U) {
    --end;
  }
  return "`" + std::string(text.substr(0, end)) + "...`";
}

}  // namespace rung
