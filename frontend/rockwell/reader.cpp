#include "frontend/rockwell/reader.h"

#include <algorithm>
#include <memory>
#include <string>
#include <utility>

#include "frontend/encoding.h"
#include "frontend/rockwell/writer.h"

namespace rung {
namespace {

using rockwell::Project;

Ast begin(std::string_view language, FileId file) {
  Ast ast;
  ast.file = file;
  ast.language = language;
  ast.dialect = "logix";
  ast.semantics = "logix";
  return ast;
}

void write(const Project& project, bool declared, Ast& ast,
           const DiagnosticList& found, ErrorLimit& errors) {
  if (found.has_errors()) return;
  StatementWriter out(ast);
  rockwell::Tags tags(project, declared, ast, out, errors);
  // Timers and counters first: rungs above theirs look at them, too.
  for (const bool blocks : {true, false}) {
    for (const rockwell::Routine& routine : project.routines) {
      for (const rockwell::Instruction& it : routine.texts.instructions) {
        const bool block = it.kind->op == rockwell::Op::Timer ||
                           it.kind->op == rockwell::Op::Counter;
        if (block == blocks) tags.survey(it);
      }
    }
  }
  tags.declare();
  if (found.has_errors()) return;
  rockwell::Writer(project, tags, out, errors).run();
}

/// Comments of a text without declarations are lines that begin with `//`.
std::string without_comments(std::string_view text, Ast& ast) {
  std::string blanked(text);
  if (text.starts_with("\xef\xbb\xbf")) std::fill_n(blanked.begin(), 3, ' ');
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end =
        std::min(text.find_first_of("\r\n", at), text.size());
    const std::string_view line = plcopen::trimmed(text.substr(at, end - at));
    if (line.starts_with("//")) {
      std::fill(blanked.begin() + static_cast<std::ptrdiff_t>(at),
                blanked.begin() + static_cast<std::ptrdiff_t>(end), ' ');
      const bool property = line.starts_with("//@");
      const std::string_view inside =
          plcopen::trimmed(line.substr(property ? 3 : 2));
      const auto from =
          inside.empty()
              ? at
              : static_cast<std::size_t>(inside.data() - text.data());
      const SourceRange where = {
          ast.file, static_cast<std::uint32_t>(from),
          static_cast<std::uint32_t>(from + inside.size())};
      const bool names_language =
          inside.substr(0, inside.find(' ')) == "language";
      if (!property) ast.comments.push_back({inside, where});
      if (property && !names_language)
        ast.annotations.push_back({inside, where});
    }
    at = end + 1;
  }
  return blanked;
}

}  // namespace

Ast read_l5x(const SourceSet& sources, FileId file,
             const ReadOptions& /*options*/, DiagnosticSink& sink) {
  Ast ast = begin("l5x", file);
  if (auto error = check_text(sources, file)) {
    sink.report(std::move(*error));
    return ast;
  }
  DiagnosticList found;
  ErrorLimit errors(found);
  const plcopen::Xml xml(sources[file].text(), file, errors);
  ast.made_names.push_back(xml.readable());
  if (xml.root()) {
    const std::optional<Project> project =
        rockwell::read_project(xml, ast, errors);
    if (project) write(*project, true, ast, found, errors);
  }
  errors.finish();
  for (Diagnostic& diagnostic : found.take())
    sink.report(std::move(diagnostic));
  return ast;
}

Ast read_rungs_text(const SourceSet& sources, FileId file,
                    const ReadOptions& /*options*/, DiagnosticSink& sink) {
  Ast ast = begin("rungs", file);
  if (auto error = check_text(sources, file)) {
    sink.report(std::move(*error));
    return ast;
  }
  DiagnosticList found;
  ErrorLimit errors(found);
  const auto text = std::make_shared<const std::string>(
      without_comments(sources[file].text(), ast));
  ast.made_names.push_back(text);
  Project project;
  rockwell::Routine& routine = project.routines.emplace_back();
  routine.name = "main";
  routine.type = "RLL";
  routine.where = {file, 0, 0};
  rockwell::read_rungs({*text, file, 0}, routine.texts, errors);
  rockwell::finish_routine(routine, errors);
  write(project, false, ast, found, errors);
  errors.finish();
  for (Diagnostic& diagnostic : found.take())
    sink.report(std::move(diagnostic));
  return ast;
}

bool is_l5x(std::string_view text) {
  const std::string_view head = text.substr(0, 4096);
  return plcopen::trimmed(head).find('<') != head.npos &&
         head.find("<RSLogix5000Content") != head.npos;
}

/// The first word is an instruction with a bracket, or `SOR`.
bool is_rungs_text(std::string_view text) {
  Ast ast;
  const std::string blanked = without_comments(text.substr(0, 65536), ast);
  std::string_view rest = plcopen::trimmed(blanked);
  const std::size_t number = rest.find_first_not_of("0123456789");
  if (number != 0 && number < rest.size() && rest[number] == ':') {
    rest = plcopen::trimmed(rest.substr(number + 1));
  }
  while (rest.starts_with("[")) rest = plcopen::trimmed(rest.substr(1));
  if (rest.starts_with("SOR ") || rest.starts_with("SOR[")) return true;
  for (const std::string_view name :
       {"XIC(", "XIO(", "OTE(", "OTL(", "OTU(", "TON(", "EQU(", "GRT(", "LES(",
        "GEQ(", "LEQ(", "NEQ(", "ONS(", "MOV("}) {
    if (rest.starts_with(name)) return true;
  }
  return false;
}

}  // namespace rung
