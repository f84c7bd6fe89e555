#pragma once

#include <string>
#include <string_view>

#include "base/diagnostic.h"
#include "base/source.h"
#include "frontend/ast.h"

namespace rung {

/// Whether the content is in the postfix format, text or binary: its first
/// bytes, or the first line that is no comment, say so.
bool is_postfix(std::string_view content);

/// Adds a file in the postfix format to `sources`, so that read_postfix() can
/// read it: a text as it is, a binary as the text that it stands for.
///
/// Errors: a refused binary goes to `sink` (RP082); then the result has no
///         value.
FileId add_postfix(SourceSet& sources, std::string path, std::string content,
                   DiagnosticSink& sink);

/// Reads the text form: docs/postfix.md section 3. Of an element's call the
/// arguments are, in the order of the text, its bits, its index and its
/// preset; `to_bit`, `to_word` and `wrap16` are calls of one argument.
///
/// Accepts: any bytes.
/// Errors: all errors of the file go to `sink`, codes RP080 and RP081; reading
///         resumes at the next line. Names and types are not looked at.
/// Limits: time and memory linear in the text; no recursion.
Ast read_postfix(const SourceSet& sources, FileId file, DiagnosticSink& sink);

}  // namespace rung
