#pragma once

#include "frontend/recognise.h"

namespace rung {

/// Reads an LDmicro program, a `.ld` file with any of its three headers
/// (docs/languages/ldmicro.md).
///
/// Errors: everything wrong in the file goes to `sink` (RP00x, RP05x), in one
///         run; reading goes on at the next element. Linear in the text.
Ast read_ldmicro(const SourceSet& sources, FileId file,
                 const ReadOptions& options, DiagnosticSink& sink);

}  // namespace rung
