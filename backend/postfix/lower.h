#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "analysis/program.h"
#include "base/diagnostic.h"

namespace rung {

/// The program in the postfix format, version 1 (docs/postfix.md), as text to
/// read or as the bytes that a controller executes. Both say the same, and
/// frontend/postfix reads both.
///
/// Bit cells are written before word cells; what the format does not hold (the
/// `//Sim` plant, comments, source ranges) is left out, the plant with a note.
/// Errors: what the format cannot express goes to `sink` (RP084), all of it;
///         then the result is empty.
/// Limits: linear in the program; no recursion.
std::optional<std::string> lower_to_postfix_text(const Program& program,
                                                 DiagnosticSink& sink);
std::optional<std::string> lower_to_postfix_binary(const Program& program,
                                                   DiagnosticSink& sink);

/// A binary as an array that a sketch includes: `NAME_program`, and
/// `NAME_words`, the memory that a controller needs for it. What an identifier
/// cannot hold is `_` in NAME.
std::string postfix_header(std::string_view bytes, std::uint32_t memory_words,
                           std::string_view name);

}  // namespace rung
