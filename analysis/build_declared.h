#pragma once

#include "analysis/program.h"

namespace rung {

/// build_program() for languages that declare every cell and element: nothing
/// is inferred and nothing converted.
///
/// The scan interval is the file's own. Inputs and outputs count as declared.
/// Errors: RP083 to `sink`, all of them in one run.
/// Limits: linear in the size of `ast`.
Program build_declared(const Ast& ast, DiagnosticSink& sink);

}  // namespace rung
