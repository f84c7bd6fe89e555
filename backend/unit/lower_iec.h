#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "backend/unit/comments.h"
#include "backend/unit/unit.h"
#include "base/diagnostic.h"

namespace rung::backend {

/// The last step of a writer: the text of a unit.
using WriteUnit = std::string (*)(const Unit& unit,
                                  const RungComments& comments,
                                  const PropertyLines& properties);

/// The unit that the writers of structured text and of instruction lists
/// spell; no value when the program cannot be expressed (RP084).
std::optional<Unit> iec_unit(const Program& program, const SourceSet& sources,
                             std::string_view language, DiagnosticSink& sink);

std::optional<Written> lower_to_iec(const Program& program,
                                    const SourceSet& sources,
                                    std::string_view language, WriteUnit write,
                                    DiagnosticSink& sink);

/// A name for the program: that of its file, without folders and ending.
std::string program_name(const Program& program, const SourceSet& sources);

}  // namespace rung::backend
