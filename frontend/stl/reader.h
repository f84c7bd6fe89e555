#pragma once

#include <string_view>

#include "base/diagnostic.h"
#include "base/source.h"
#include "frontend/ast.h"

namespace rung {

/// Reads a statement list for Siemens S7-300 and S7-400 in German or English
/// mnemonics: OB 1, OB 100 and functions without parameters, or instructions
/// alone (docs/languages/stl.md).
///
/// The result declares everything. The status word and the accumulators are
/// gone; calls are put in their place, jumps are guards. An `__ASSERT` is a
/// property line.
///
/// Errors: what is wrong goes to `sink` (RP00x, RP04x). Linear in the text and
///         in what its calls execute, of which there is a limit.
Ast read_stl(const SourceSet& sources, FileId file, DiagnosticSink& sink);

/// Does the text look like one?
bool is_stl(std::string_view text);

}  // namespace rung
