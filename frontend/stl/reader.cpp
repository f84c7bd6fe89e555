#include "frontend/stl/reader.h"

#include <set>
#include <string>
#include <utility>

#include "frontend/encoding.h"
#include "frontend/error_limit.h"
#include "frontend/stl/machine.h"

namespace rung {
namespace {

/// `language` lines have been obeyed; the others are properties.
void take_comments(stl::Source& source, Ast& ast) {
  for (const AstAnnotation& line : source.annotations) {
    const std::string_view word =
        line.text.substr(0, line.text.find_first_of(" \t"));
    if (word != "language") ast.annotations.push_back(line);
  }
  ast.comments = std::move(source.comments);
}

class NoDiagnostics : public DiagnosticSink {
 public:
  void report(Diagnostic /*diagnostic*/) override {}
};

/// A function that nothing calls would not be looked at.
void check_calls(const stl::Source& source, ErrorLimit& errors) {
  std::set<std::string> called;
  for (const stl::Block& block : source.blocks) {
    for (const stl::Statement& statement : block.body) {
      for (const stl::Operand& operand : statement.operands) {
        called.insert(operand.text);
      }
    }
  }
  for (const stl::Block& block : source.blocks) {
    const std::string name = "FC" + std::to_string(block.number);
    if (block.kind == stl::BlockKind::Function && !called.contains(name)) {
      errors.error("RP041", block.where,
                   quoted_excerpt(name) +
                       " is called nowhere: what it does would not be looked "
                       "at");
    }
  }
}

bool is_only_here(std::string_view name) {
  for (const std::string_view known :
       {"U", "UN", "U(", "UN(", "A", "AN", "A(", "AN(", "SPA", "SPB", "SPBN",
        "JU", "JC", "JCN", "__STWRST"}) {
    if (name == known) return true;
  }
  return false;
}

}  // namespace

Ast read_stl(const SourceSet& sources, FileId file, DiagnosticSink& sink) {
  Ast ast;
  ast.file = file;
  ast.language = "stl";
  ast.dialect = "s7";
  ErrorLimit errors(sink);
  if (auto error = check_text(sources, file)) {
    sink.report(std::move(*error));
    return ast;
  }
  const std::string_view text = sources[file].text();
  const std::size_t begin = text.find_first_not_of(" \t\r\n");
  if (begin != std::string_view::npos && text[begin] == '<') {
    const auto at = static_cast<std::uint32_t>(begin);
    errors.error("RP041", {file, at, at + 1},
                 "this is XML, as awlsim's projects are: the sources inside of "
                 "it can be read when each is saved as a file");
    return ast;
  }
  StatementWriter writer(ast);
  stl::Source source = stl::split(sources[file].text(), file, errors);
  check_calls(source, errors);
  take_comments(source, ast);
  stl::Machine(source, ast, writer, errors).run();
  errors.finish();
  return ast;
}

bool is_stl(std::string_view text) {
  NoDiagnostics nothing;
  ErrorLimit errors(nothing);
  const stl::Source source = stl::split(text, {}, errors);
  for (const stl::Block& block : source.blocks) {
    if (block.where.end != 0) {
      const std::string head = stl::squeezed(
          text.substr(block.where.begin, block.where.end - block.where.begin));
      return head.starts_with("ORGANIZATION_BLOCK") ||
             head.starts_with("FUNCTIONFC");
    }
    for (const stl::Statement& statement : block.body) {
      if (is_only_here(statement.name)) {
        return statement.operands.empty() ||
               !statement.operands[0].text.starts_with("=");
      }
      // `L 30`, but not `L = I0`.
      if (statement.name == "L" && !statement.operands.empty()) {
        return !statement.operands[0].text.starts_with("=");
      }
      const bool anywhere = statement.name == "CALL" ||
                            statement.name == "SET" || statement.name == "CLR";
      if (!anywhere) return false;
    }
  }
  return false;
}

}  // namespace rung
