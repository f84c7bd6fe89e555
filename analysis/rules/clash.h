#pragma once

#include <cstdint>

#include "analysis/program.h"

namespace rung {

/// Two operands of a chain of And (or Or) nodes that decide it by themselves.
struct Clash {
  static constexpr std::uint32_t kNone = 0xffff'ffff;
  std::uint32_t first = kNone;
  std::uint32_t second = kNone;
};

/// In the And chain at `root`: a contact and its inverse, or two comparisons of
/// one word with constants that exclude each other. In an Or chain: a contact
/// and its inverse. Exact for what it finds, whatever the state is.
Clash find_clash(const Program& program, std::uint32_t root, NodeOp op);

}  // namespace rung
