#pragma once

#include <string_view>

#include "frontend/recognise.h"

namespace rung {

/// Reads structured text of IEC 61131-3: units with their declarations, or
/// statements alone (docs/languages/st.md). Conditions, loops and calls are
/// gone in the result: what they mean is in the assignments.
///
/// Errors: everything wrong in the file goes to `sink` (RP00x, RP04x); reading
///         goes on at the next statement. Linear in the text, but for units
///         that are called and loops that are passed more than once (RP050).
Ast read_structured_text(const SourceSet& sources, FileId file,
                         const ReadOptions& options, DiagnosticSink& sink);

/// Does the text look like one?
bool is_structured_text(std::string_view text);

}  // namespace rung
