#pragma once

#include "frontend/recognise.h"

namespace rung {

/// Reads the ladder routines of an export of Logix Designer, an `.L5X` file
/// (docs/languages/rockwell.md).
///
/// Errors: everything wrong in the file goes to `sink` (RP00x, RP05x, RP08x,
///         RP093), in one run. Linear in the text, but for routines that are
///         called several times.
Ast read_l5x(const SourceSet& sources, FileId file, const ReadOptions& options,
             DiagnosticSink& sink);

/// Reads rungs as neutral text, without declarations.
Ast read_rungs_text(const SourceSet& sources, FileId file,
                    const ReadOptions& options, DiagnosticSink& sink);

/// Does the text look like one?
bool is_l5x(std::string_view text);
bool is_rungs_text(std::string_view text);

}  // namespace rung
