#pragma once

#include <string_view>

#include "frontend/recognise.h"

namespace rung {

/// Reads IEC 61131-3 instruction lists: units with their declarations, or
/// instructions alone (docs/languages/il-iec.md).
///
/// The result declares everything: cells with their types and roles, and the
/// function blocks. Jumps and the accumulator are gone: what they mean is in
/// the assignments.
///
/// Errors: everything wrong in the file goes to `sink` (RP00x, RP04x), in one
///         run; reading goes on at the next line. Linear in the text, but for
///         units that are called more than once.
Ast read_il_iec(const SourceSet& sources, FileId file,
                const ReadOptions& options, DiagnosticSink& sink);

/// Does the text look like one?
bool is_il_iec(std::string_view text);

}  // namespace rung
