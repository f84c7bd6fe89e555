#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "analysis/program.h"
#include "base/diagnostic.h"
#include "frontend/ast.h"

namespace rung::test {

/// A script with all that was made of it; the texts stay alive with it.
struct Read {
  SourceSet sources;
  Ast ast;
  std::vector<Diagnostic> diagnostics;
};
struct Built {
  Read read;
  Program program;
  std::vector<Diagnostic> diagnostics;  // of both stages
};

void read(std::string_view text, std::string_view dialect, Read& out);
void build(std::string_view text, std::string_view dialect, Built& out);

/// Codes in order, "RP010 RP010"; each with the text that its range covers
/// when `with_text`: "RP010[Q0]".
std::string codes(const SourceSet& sources,
                  const std::vector<Diagnostic>& diagnostics, bool with_text);

/// "(|| I0 (! Q1))": an expression as its operators nest.
std::string dump(const Ast& ast, const AstExpression& expression);

/// The nodes of a rung in execution order: "I0 Q1 ! ||". Names of cells,
/// constants, operators; `?` is a branch marker with the distance to its
/// target, as in "?+3".
std::string dump(const Program& program, RungId rung);

/// Of all rungs: "Q0 = I0 Q1 ! ||\n..."; what every other test looks at.
std::string dump_rungs(const Program& program);

/// "I0:in Q0:out M0:memory=1 IW0:word in -5..5": cells in order.
std::string dump_cells(const Program& program);

}  // namespace rung::test
