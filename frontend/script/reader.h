#pragma once

#include <string_view>

#include "base/diagnostic.h"
#include "base/source.h"
#include "frontend/ast.h"

namespace rung {

/// Reads a rung script of either dialect.
///
/// `dialect` is "yun", "sim", or empty: then the dialect is recognised by the
/// names that the script uses (and is "sim" when nothing tells).
/// Accepts: any bytes.
/// Errors: all syntax errors of the file go to `sink`, codes RP0xx; reading
///         resumes at the next rung.
/// Limits: time and memory linear in the text; no recursion.
/// Source: the two dialects of docs/scripts.md.
Ast read_script(const SourceSet& sources, FileId file, std::string_view dialect,
                DiagnosticSink& sink);

}  // namespace rung
