#pragma once

#include <optional>
#include <string>

#include "analysis/program.h"
#include "backend/unit/comments.h"
#include "backend/unit/unit.h"
#include "base/diagnostic.h"
#include "base/source.h"

namespace rung {

/// The program as structured text of IEC 61131-3: one PROGRAM
/// (docs/lowering.md).
/// Errors: what it cannot express goes to `sink` (RP084), all of it; then the
///         result is empty. Limits: linear in the program; no recursion.
std::optional<backend::Written> lower_to_st(const Program& program,
                                            const SourceSet& sources,
                                            DiagnosticSink& sink);

namespace backend {
/// The last step: the text of a unit.
std::string write_st(const Unit& unit, const RungComments& comments,
                     const PropertyLines& properties);
}  // namespace backend

}  // namespace rung
