#pragma once

#include <string_view>

#include "base/diagnostic.h"
#include "base/source.h"
#include "frontend/ast.h"

namespace rung {

/// Reads an IEC 61131-3 instruction list: one PROGRAM or FUNCTION_BLOCK with
/// its declarations, or instructions alone (docs/il-iec.md).
///
/// The result declares everything: cells with their types and roles, and the
/// function blocks. Jumps and the accumulator are gone: what they mean is in
/// the assignments (frontend/il_iec/writer.h).
///
/// Errors: everything wrong in the file goes to `sink` (RP00x, RP04x), in one
///         run; reading goes on at the next line. Linear in the text.
Ast read_il_iec(const SourceSet& sources, FileId file, DiagnosticSink& sink);

/// Does the text look like one?
bool is_il_iec(std::string_view text);

}  // namespace rung
