#pragma once

#include <optional>

#include "analysis/program.h"
#include "backend/unit/unit.h"
#include "base/diagnostic.h"
#include "base/source.h"

namespace rung {

/// The program as a ladder diagram in the XML of PLCopen TC6, with all of its
/// geometry, as the OpenPLC Editor and Beremiz keep it (docs/lowering.md).
/// Errors: what it cannot express goes to `sink` (RP084), all of it; then the
///         result is empty. Limits: linear in the program; no recursion.
std::optional<backend::Written> lower_to_plcopen(const Program& program,
                                                 const SourceSet& sources,
                                                 DiagnosticSink& sink);

}  // namespace rung
