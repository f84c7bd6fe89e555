#pragma once

#include <string_view>

#include "base/diagnostic.h"
#include "base/source.h"
#include "frontend/ast.h"
#include "frontend/recognise.h"

namespace rung {

/// Reads a project in the XML of PLCopen TC6: ladder diagrams and function
/// block diagrams, and units in the textual languages between them.
///
/// The semantics say in which order the coils of a drawing are written and
/// what modifiers mean where tools differ; the elements are theirs too.
/// Errors: RP093..RP099 (docs/languages/plcopen.md), and those of the units'
///         own languages.
Ast read_plcopen(const SourceSet& sources, FileId file,
                 const ReadOptions& options, DiagnosticSink& sink);

bool is_plcopen(std::string_view text);

}  // namespace rung
