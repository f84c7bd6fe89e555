#include "frontend/ascii/reader.h"

#include <set>
#include <utility>

#include "frontend/ascii/writer.h"
#include "frontend/encoding.h"
#include "frontend/token_list.h"

namespace rung {
namespace {

void check_labels(const ascii::Drawing& drawing, ErrorLimit& errors) {
  std::set<std::string_view> names;
  for (const ascii::Label& label : drawing.labels()) {
    if (names.insert(label.name).second) continue;
    errors.error("RP089", drawing.range(label.row, 0, 1),
                 "the label " + quoted_excerpt(label.name) +
                     " stands further up already");
  }
}

}  // namespace

Ast read_ascii(const SourceSet& sources, FileId file,
               const ReadOptions& /*options*/, DiagnosticSink& sink) {
  Ast ast;
  ast.file = file;
  ast.language = "ascii";
  ast.dialect = "iec";
  ast.semantics = "ladder-logic";
  if (auto error = check_text(sources, file)) {
    sink.report(std::move(*error));
    return ast;
  }
  DiagnosticList found;
  ErrorLimit errors(found);
  ascii::Drawing drawing(sources[file].text(), ast, errors);
  check_labels(drawing, errors);
  const ascii::Wires wires = ascii::trace_wires(drawing, errors);
  if (!found.has_errors()) {
    StatementWriter out(ast);
    ascii::Cells cells(wires, out, errors);
    ascii::Writer(drawing, wires, cells, out, errors).run();
  }
  errors.finish();
  for (Diagnostic& diagnostic : found.take())
    sink.report(std::move(diagnostic));
  return ast;
}

// The first line that is neither a comment nor a pragma begins with the rail.
bool is_ascii_ladder(std::string_view text) {
  Ast ast;
  DiagnosticList ignored;
  ErrorLimit errors(ignored);
  const ascii::Drawing drawing(text, ast, errors);
  for (std::uint32_t row = 0; row < drawing.rows(); ++row) {
    if (drawing.columns(row) == 0) continue;
    std::uint32_t begin = 0;
    while (drawing.at(row, begin) == ' ') ++begin;
    const char c = drawing.at(row, begin);
    const char next = drawing.at(row, begin + 1);
    return c == '|' || (c == '+' && next == '-');
  }
  return false;
}

}  // namespace rung
