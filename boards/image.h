#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

namespace rung::boards {

/// The part of a firmware image that is kept free for the tape: behind the mark
/// "rungproof tape 1" and the part's size in 4 bytes. Found in ELF files and in
/// flash alike; no value when the mark is not there exactly once.
struct TapePlace {
  std::size_t at = 0;
  std::size_t size = 0;
};
std::optional<TapePlace> find_tape_place(std::string_view image);

}  // namespace rung::boards
