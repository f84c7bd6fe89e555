#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace rung {

/// Whether the bytes begin as the binary postfix format does.
bool is_postfix_binary(std::string_view bytes);

/// A binary as its text, or why there is none.
struct Disassembly {
  std::string text;
  std::string refusal;    // empty: `text` is the program
  std::uint8_t code = 0;  // of docs/postfix.md section 5; 0: none of those
  std::uint32_t at = 0;   // the byte that the refusal speaks of
  bool has_value() const { return refusal.empty(); }
};

/// Verifies a binary as the machine's loader does, by code of its own, and
/// spells it as text. What it accepts the loader accepts.
///
/// Accepts: any bytes. Beyond the loader it asks that every operator's
///          operands stand right before it, bits and words together, and that
///          `&&` and `||` skip exactly where their right operand holds an
///          element: else the code is the postfix form of no program.
/// Limits: time and memory linear in the bytes and the text; a text above
///         kMaxFileBytes is refused.
Disassembly disassemble_postfix(std::string_view bytes);

}  // namespace rung
