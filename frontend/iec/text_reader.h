#pragma once

#include <memory>

#include "frontend/error_limit.h"
#include "frontend/iec/project.h"
#include "frontend/iec/token.h"
#include "frontend/recognise.h"

namespace rung::iec {

/// The units of a text: PROGRAM, FUNCTION_BLOCK, FUNCTION, whose bodies may be
/// structured text or instruction lists; VAR_GLOBAL; CONFIGURATION. A text
/// without any of these is one body, with declarations above it or none.
void read_units(std::shared_ptr<const TokenList> list, Project& project,
                ErrorLimit& errors);

/// Adds comments and property lines; lines `language` have been obeyed.
void take_comments(const TokenList& list, Ast& ast);

/// The preset that is asked for, `iec` where none is; it is set in `ast` too.
ExpandOptions expand_options(const ReadOptions& options, Ast& ast);
/// The scan takes what the program's task says, if there is one.
void take_interval(const Project& project, const Pou& main, Ast& ast);

/// A whole file, read by either language.
Ast read_text(const SourceSet& sources, FileId file, std::string_view language,
              const ReadOptions& options, DiagnosticSink& sink);

/// What the first body of a text that is not empty looks like; Neither: the
/// text begins with no unit and with no instruction.
enum class Looks : std::uint8_t { Neither, List, StructuredText };
Looks looks_like(std::string_view text);

}  // namespace rung::iec
