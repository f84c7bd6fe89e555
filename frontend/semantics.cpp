#include "frontend/semantics.h"

#include <algorithm>
#include <array>

namespace rung {
namespace {

constexpr std::array kPresets = {
    Semantics{.name = "yun",
              .elements = "yun",
              .summary = "Rung scripts as the controller on the Yun executes "
                         "them: every operand is evaluated."},
    Semantics{.name = "sim",
              .elements = "sim",
              .summary = "Rung scripts as the browser simulator executes them: "
                         "`&&` and `||` short-circuit."},
    Semantics{.name = "iec",
              .elements = "iec",
              .summary = "IEC 61131-3, second edition, as it is written."},
    Semantics{.name = "melsec",
              .elements = "melsec",
              .summary = "Instruction lists as controllers of the FX family "
                         "execute them."},
};

}  // namespace

std::span<const Semantics> semantics_presets() { return kPresets; }

const Semantics* find_semantics(std::string_view name) {
  const auto* const found = std::find_if(
      kPresets.begin(), kPresets.end(),
      [&](const Semantics& preset) { return preset.name == name; });
  return found == kPresets.end() ? nullptr : found;
}

}  // namespace rung
