#pragma once

#include "base/diagnostic.h"
#include "base/source.h"
#include "frontend/ast.h"
#include "frontend/recognise.h"

namespace rung {

/// Reads an Arduino sketch for plcLib, the thesis's or the published one
/// (docs/languages/plclib.md). `options.semantics` says which; where it is
/// null, the calls of the sketch do.
///
/// The result declares everything. Calls, loops and tasks are gone: what they
/// mean is in the assignments (frontend/plclib/machine.h).
///
/// Errors: everything wrong in the file goes to `sink` (RP00x, RP05x), in one
///         run. Linear in the text times the size of what is put in for calls,
///         loops and tasks, which is limited (RP059).
Ast read_plclib(const SourceSet& sources, FileId file,
                const ReadOptions& options, DiagnosticSink& sink);

}  // namespace rung
