#pragma once

#include "analysis/program.h"

namespace rung {

/// build_program() for what read_postfix() has read: names, types and elements
/// are declared there, so nothing is inferred and nothing converted.
///
/// The scan interval is the file's own. Inputs and outputs count as declared.
/// Errors: RP083 to `sink`, all of them in one run.
/// Limits: linear in the size of `ast`.
Program build_postfix(const Ast& ast, DiagnosticSink& sink);

}  // namespace rung
