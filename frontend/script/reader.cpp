#include "frontend/script/reader.h"

#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>

#include "frontend/encoding.h"
#include "frontend/error_limit.h"
#include "frontend/script/dialect.h"
#include "frontend/script/parser.h"
#include "frontend/script/token.h"

namespace rung {
namespace {

using script::Token;
using script::TokenKind;

bool is_section(const Token& token) {
  return token.kind == TokenKind::VarSection ||
         token.kind == TokenKind::SimSection ||
         token.kind == TokenKind::DoubtfulSection;
}

/// Only the sim dialect has sections: in the other one the markers are plain
/// comments.
void drop_sections(script::TokenList& list) {
  for (const Token& token : list.tokens) {
    if (!is_section(token)) continue;
    list.comments.push_back(
        {list.text_of(token).substr(2), list.range_of(token)});
  }
  std::erase_if(list.tokens, is_section);
  std::sort(list.comments.begin(), list.comments.end(),
            [](const AstComment& a, const AstComment& b) {
              return a.where.begin < b.where.begin;
            });
}

void refuse_doubtful_sections(script::TokenList& list, ErrorLimit& errors) {
  const auto doubtful = [](const Token& token) {
    return token.kind == TokenKind::DoubtfulSection;
  };
  for (const Token& token : list.tokens) {
    if (!doubtful(token)) continue;
    errors.error("RP015", list.range_of(token),
                 quoted_excerpt(list.text_of(token)) +
                     " is nearly a section marker: write `//Var` or `//Sim` "
                     "alone or with a comma before the text, or other words");
  }
  std::erase_if(list.tokens, doubtful);
}

/// `//@ language` and `//@ dialect` have been obeyed; the other lines are
/// properties.
void take_annotations(script::TokenList& list, Ast& ast) {
  for (const AstAnnotation& line : list.annotations) {
    const std::string_view word =
        line.text.substr(0, line.text.find_first_of(" \t"));
    if (word != "language" && word != "dialect") {
      ast.annotations.push_back(line);
    }
  }
}

/// About as many tokens as nodes will be made of.
std::size_t count_operands(const script::TokenList& list) {
  const auto count = std::count_if(
      list.tokens.begin(), list.tokens.end(), [](const Token& token) {
        return token.kind >= TokenKind::Name && token.kind <= TokenKind::Not;
      });
  return static_cast<std::size_t>(count);
}

void read_sections(script::Cursor& cursor, Ast& ast, ErrorLimit& errors) {
  using script::PlantParser;
  bool seen_var = false;
  bool seen_sim = false;
  while (!cursor.at(TokenKind::End)) {
    const Token& marker = cursor.take();
    const bool is_var = marker.kind == TokenKind::VarSection;
    bool& seen = is_var ? seen_var : seen_sim;
    if (seen || seen_sim) {
      errors.error("RP015", cursor.range(marker),
                   seen ? "this section stands here a second time"
                        : "`//Var` must stand before `//Sim`");
    }
    seen = true;
    PlantParser(cursor, ast, errors,
                is_var ? PlantParser::Section::Var : PlantParser::Section::Sim)
        .run();
  }
}

}  // namespace

Ast read_script(const SourceSet& sources, FileId file, std::string_view dialect,
                DiagnosticSink& sink) {
  Ast ast;
  ast.file = file;
  ast.language = "script";
  ErrorLimit errors(sink);
  if (auto error = check_text(sources, file)) {
    ast.dialect = dialect == "yun" ? "yun" : "sim";
    sink.report(std::move(*error));
    return ast;
  }
  script::TokenList list = script::tokenize(sources, file);
  if (list.open_comment.has_value()) {
    errors.error("RP007", list.open_comment, "this comment is not closed");
  }
  ast.dialect = script::find_dialect(list, dialect, errors);
  if (ast.dialect == "sim") {
    refuse_doubtful_sections(list, errors);
  } else {
    drop_sections(list);
  }
  take_annotations(list, ast);
  ast.comments = std::move(list.comments);
  ast.nodes.reserve(count_operands(list));
  script::Cursor cursor(list);
  script::RungParser(cursor, ast, errors).run();
  read_sections(cursor, ast, errors);
  errors.finish();
  return ast;
}

}  // namespace rung
