#include "boards/image.h"

namespace rung::boards {

std::optional<TapePlace> find_tape_place(std::string_view image) {
  constexpr std::string_view kMark = "rungproof tape 1";
  constexpr std::size_t kSizeBytes = 4;
  const std::size_t found = image.find(kMark);
  if (found == std::string_view::npos ||
      image.find(kMark, found + 1) != std::string_view::npos) {
    return std::nullopt;
  }
  TapePlace place;
  place.at = found + kMark.size();
  if (image.size() - place.at < kSizeBytes) return std::nullopt;
  for (std::size_t byte = kSizeBytes; byte-- > 0;) {
    place.size =
        place.size * 256 + static_cast<unsigned char>(image[place.at + byte]);
  }
  place.at += kSizeBytes;
  if (place.size > image.size() - place.at) return std::nullopt;
  return place;
}

}  // namespace rung::boards
