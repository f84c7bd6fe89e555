#pragma once

#include <optional>

#include "analysis/program.h"
#include "backend/unit/unit.h"
#include "base/diagnostic.h"
#include "base/source.h"

namespace rung {

/// The program as a ladder of LDmicro, in its second format
/// (docs/lowering.md).
/// Errors: what it cannot express goes to `sink` (RP084), all of it; then the
///         result is empty. Limits: linear in the program; no recursion.
std::optional<backend::Written> lower_to_ldmicro(const Program& program,
                                                 const SourceSet& sources,
                                                 DiagnosticSink& sink);

}  // namespace rung
