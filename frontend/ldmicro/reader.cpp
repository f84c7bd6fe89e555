#include "frontend/ldmicro/reader.h"

#include <utility>

#include "frontend/encoding.h"
#include "frontend/error_limit.h"
#include "frontend/ldmicro/rung_writer.h"

namespace rung {

Ast read_ldmicro(const SourceSet& sources, FileId file,
                 const ReadOptions& options, DiagnosticSink& sink) {
  Ast ast;
  ast.file = file;
  ast.language = "ldmicro";
  ast.dialect = "ldmicro";
  if (auto error = check_text(sources, file)) {
    sink.report(std::move(*error));
    return ast;
  }
  ErrorLimit errors(sink);
  const ldmicro::ProgramText text =
      ldmicro::read_program_text(sources[file].text(), ast, errors);
  const Semantics* const preset =
      options.semantics != nullptr
          ? options.semantics
          : find_semantics(text.first_format ? "ldmicro0.1" : "ldmicro0.2");
  ast.semantics = preset->name;
  ast.scan_min_ms = text.cycle_us / 1000;
  ast.scan_max_ms = ast.scan_min_ms;
  StatementWriter out(ast);
  ldmicro::Names names(text, ast, out, errors,
                       preset->input_image || options.stable_inputs);
  ldmicro::RungWriter writer(text, names, out, errors,
                             ast.semantics == "ldmicro0.1" ? -1 : 0);
  for (const auto& rung : text.rungs) writer.write(rung);
  errors.finish();
  return ast;
}

}  // namespace rung
