#pragma once

#include <rapidcheck/shrink/Shrink.h>

#include <cstdint>
#include <utility>
#include <vector>

namespace rung {

/// A tape that fails too and has no simpler neighbour that does, or what is
/// found in `attempts`.
template <class Fails>
std::vector<std::uint32_t> shrink_tape(std::vector<std::uint32_t> failing,
                                       const Fails& fails,
                                       int attempts = 20'000) {
  const auto simpler = [&](auto candidates) {
    while (auto candidate = candidates.next()) {
      if (--attempts < 0) return false;
      if (!fails(*candidate)) continue;
      failing = std::move(*candidate);
      return true;
    }
    return false;
  };
  while (simpler(rc::shrink::removeChunks(failing)) ||
         simpler(rc::shrink::eachElement(failing, [](std::uint32_t number) {
           return rc::shrink::integral(number);
         }))) {
  }
  return failing;
}

}  // namespace rung
