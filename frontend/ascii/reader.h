#pragma once

#include "frontend/recognise.h"

namespace rung {

/// Reads a ladder that is drawn with characters (docs/languages/ascii.md).
///
/// Errors: everything wrong in the file goes to `sink` (RP00x, RP05x), in one
///         run. Linear in the text, but for sorting the elements by place.
Ast read_ascii(const SourceSet& sources, FileId file,
               const ReadOptions& options, DiagnosticSink& sink);

/// Does the text look like one?
bool is_ascii_ladder(std::string_view text);

}  // namespace rung
