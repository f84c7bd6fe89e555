#include "frontend/plcopen/reader.h"

#include <algorithm>
#include <string>
#include <utility>

#include "frontend/encoding.h"
#include "frontend/error_limit.h"
#include "frontend/iec/bodies.h"
#include "frontend/iec/text_reader.h"
#include "frontend/plcopen/project.h"
#include "frontend/plcopen/xml.h"

namespace rung {
namespace {

void read_file(const SourceSet& sources, FileId file,
               const ReadOptions& options, Ast& ast, ErrorLimit& errors) {
  const std::string_view text = sources[file].text();
  const plcopen::Xml xml(text, file, errors);
  if (!xml.root()) return;
  ast.made_names.push_back(xml.readable());
  const iec::ExpandOptions expansion = iec::expand_options(options, ast);
  iec::Project project = plcopen::read_project(xml, *options.semantics, ast);
  plcopen::read_comments(xml, ast);
  for (const AstAnnotation& line : ast.annotations) {
    iec::note_mentions(line.text, project);
  }
  if (errors.has_errors()) return;
  const iec::Pou* const main =
      iec::main_pou(project, expansion, errors, {file, 0, 0});
  if (main == nullptr) return;
  iec::expand(project, *main, expansion, ast, errors);
  iec::take_interval(project, *main, ast);
}

constexpr std::string_view kBlanks = " \t\r\n\f";

}  // namespace

/// Behind a byte order mark and line comments of ours: a tag.
bool is_plcopen(std::string_view text) {
  if (text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);
  for (;;) {
    const std::size_t begin = text.find_first_not_of(kBlanks);
    if (begin == std::string_view::npos) return false;
    text.remove_prefix(begin);
    if (!text.starts_with("//")) break;
    text.remove_prefix(std::min(text.find_first_of("\r\n"), text.size()));
  }
  return text.starts_with("<?xml") || text.starts_with("<project") ||
         text.starts_with("<!--") || text.starts_with("<!DOCTYPE");
}

Ast read_plcopen(const SourceSet& sources, FileId file,
                 const ReadOptions& options, DiagnosticSink& sink) {
  ReadOptions chosen = options;
  if (chosen.semantics == nullptr) chosen.semantics = find_semantics("openplc");
  Ast ast;
  ast.file = file;
  ast.language = "plcopen";
  if (auto error = check_text(sources, file)) {
    sink.report(std::move(*error));
    return ast;
  }
  ErrorLimit errors(sink);
  read_file(sources, file, chosen, ast, errors);
  std::stable_sort(ast.annotations.begin(), ast.annotations.end(),
                   [](const AstAnnotation& a, const AstAnnotation& b) {
                     return a.where.begin < b.where.begin;
                   });
  errors.finish();
  return ast;
}

}  // namespace rung
