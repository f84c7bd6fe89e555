#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "base/diagnostic.h"

namespace rung {

enum class Ink : std::uint8_t {
  Error,
  Warning,
  Note,
  Good,
  Frame,    // line numbers and bars
  Changed,  // a cell of a scan table that is not what it was
  Strong,
};

/// Colours text for a terminal, or leaves it alone. Nothing is said by colour
/// only: every report reads the same without.
class Painter {
 public:
  explicit Painter(bool colour) : colour_(colour) {}
  std::string operator()(Ink ink, std::string_view text) const;

 private:
  bool colour_;
};

Ink ink_of(Severity severity);

}  // namespace rung
