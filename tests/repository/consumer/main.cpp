#include <cstdio>

#include "analysis/property.h"
#include "frontend/script/reader.h"
#include "smt/verify.h"

/// Proves an interlock through the library; exit status 0 when it is proved.
int main() {
  rung::SourceSet sources;
  const rung::FileId file =
      sources.add("interlock.rung",
                  "//@ never Q0 && Q1\nQ0 = I0 && !Q1;\nQ1 = I1 && !Q0;\n");
  rung::DiagnosticList diagnostics;
  const rung::Ast ast = rung::read_script(sources, file, "", diagnostics);
  rung::Program program = rung::build_program(ast, {}, diagnostics);
  const rung::PropertySet properties =
      rung::read_properties(program, {}, sources, diagnostics);
  if (diagnostics.has_errors()) return 2;
  const rung::VerifyReport report = rung::verify(program, properties, {});
  const rung::ObligationResult& first = report.results.front();
  std::printf("%s: %s\n", first.obligation.name.c_str(),
              first.verdict == rung::Verdict::Proved ? "proved" : "open");
  return first.verdict == rung::Verdict::Proved ? 0 : 1;
}
