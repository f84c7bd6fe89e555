#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace rung {

/// What a lowered program takes on a controller.
struct PostfixCost {
  std::size_t bytes = 0;  // of the program, in flash
  std::size_t code_bytes = 0;
  std::size_t instructions = 0;
  std::size_t bit_stack = 0;   // the most that ever stand on it
  std::size_t word_stack = 0;  // likewise
  /// No scan takes more, on any AVR; without the pins (docs/controllers.md).
  std::uint64_t avr_cycles = 0;
};

/// Of a binary that lower_to_postfix_binary() has written. The cycles come from
/// a table that was measured on emulated boards (tests/boards/cycles_test.cpp);
/// they are added up over all instructions, as if no skip were taken.
PostfixCost cost_of_postfix(std::string_view binary);

/// Cycles of one instruction in the worst case; `wide`: with a prefix. A bit
/// that is pushed is popped, so only sums can be measured: reading a bit is
/// taken from the machine's listing.
std::uint32_t avr_cycles(std::uint8_t opcode, bool wide);

}  // namespace rung
