#pragma once

#include <cstdint>
#include <vector>

#include "backend/unit/unit.h"

namespace rung::backend {

/// An expression of bits as contacts in series and in parallel.
struct Circuit {
  enum class Kind : std::uint8_t { Contact, Series, Parallel, Constant };
  Kind kind = Kind::Contact;
  bool negated = false;              // Contact
  bool value = false;                // Constant: the root, or nowhere
  CellId cell;                       // Contact
  std::vector<std::uint32_t> parts;  // Series, Parallel: two or more
};

/// The root is the first; parts stand behind what they are parts of.
using Network = std::vector<Circuit>;

/// Negations move to the contacts, constants are folded, a series in a series
/// is part of it. Only Not, And, Or, Constant and Read of bits stand in
/// `terms`. Linear, no recursion.
Network network_of(const Terms& terms);

}  // namespace rung::backend
