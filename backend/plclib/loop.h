#pragma once

#include <string>

#include "backend/plclib/wiring.h"
#include "backend/unit/comments.h"
#include "backend/unit/unit.h"

namespace rung::backend {

/// `// text`, which does not go on in the next line.
std::string line_comment(std::string_view text);

/// The body of loop().
struct LoopText {
  std::string text;
  std::size_t statements = 0;
  std::string stack;           // its name, where one is needed
  std::vector<bool> declared;  // by variable: those that are used
};
LoopText write_loop(const Unit& unit, const Wiring& wiring,
                    const RungComments& comments, std::string_view stack);

}  // namespace rung::backend
