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
              .order = CoilOrder::Snapshot,
              .summary = "IEC 61131-3, second edition, as it is written: a "
                         "network is evaluated as a whole, then the next."},
    Semantics{.name = "melsec",
              .elements = "melsec",
              .summary = "Instruction lists as controllers of the FX family "
                         "execute them."},
    Semantics{.name = "s7",
              .elements = "s7",
              .summary = "Statement lists as S7-300 and S7-400 execute them."},
    Semantics{.name = "openplc",
              .elements = "matiec",
              .summary = "Drawings as the OpenPLC Editor and Beremiz on Python "
                         "3 compile them: coils as they stand in the file, "
                         "every wire evaluated anew for each coil."},
    Semantics{.name = "beremiz-py2",
              .elements = "matiec",
              .order = CoilOrder::Position,
              .summary = "Drawings as Beremiz on Python 2 compiles them: coils "
                         "by row and column, every wire evaluated anew for "
                         "each coil."},
    Semantics{.name = "esbmc",
              .elements = "esbmc",
              .order = CoilOrder::Snapshot,
              .summary = "Drawings as ESBMC-PLC reads them: the contacts of a "
                         "network see the values from before it."},
    Semantics{.name = "ladder-logic",
              .elements = "iec",
              .order = CoilOrder::Position,
              .summary = "Drawn ladders as vdorr's ladder-logic executes them: "
                         "row by row, each row from left to right."},
    Semantics{.name = "logix",
              .elements = "logix",
              .summary = "Ladder routines as Logix controllers execute them; "
                         "inputs do not change in a scan."},
    Semantics{.name = "ldmicro0.1",
              .elements = "ldmicro",
              .input_image = false,
              .summary = "LDmicro, files of its first format: a timer without "
                         "an adjustment counts one cycle less than its delay."},
    Semantics{.name = "ldmicro0.2",
              .elements = "ldmicro",
              .input_image = false,
              .summary = "LDmicro, files of its second format: a timer without "
                         "an adjustment counts the cycles of its delay."},
    Semantics{.name = "plclib",
              .elements = "plclib",
              .input_image = false,
              .summary = "plcLib sketches as the library of the 2018 thesis "
                         "executes them, on an Arduino Due with ARTe tasks."},
    Semantics{.name = "plclib14",
              .elements = "plclib14",
              .input_image = false,
              .summary = "plcLib sketches as the published library, version "
                         "1.4, executes them on an Arduino Uno."},
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
