#include "frontend/il_iec/reader.h"

#include <algorithm>
#include <string>
#include <utility>

#include "frontend/encoding.h"
#include "frontend/error_limit.h"
#include "frontend/il_iec/parser.h"

namespace rung {
namespace {

using il_iec::Cursor;
using il_iec::TokenKind;
using il_iec::TokenList;

/// `language` lines have been obeyed; the others are properties.
void take_comments(TokenList& list, Ast& ast) {
  for (const AstAnnotation& line : list.annotations) {
    const std::string_view word =
        line.text.substr(0, line.text.find_first_of(" \t"));
    if (word != "language") ast.annotations.push_back(line);
  }
  ast.comments = std::move(list.comments);
}

/// Which outputs of blocks the text speaks of; others have no cell.
void note_outputs(const TokenList& list, il_iec::Writer& writer) {
  for (const il_iec::Token& token : list.tokens) {
    if (token.kind != TokenKind::Word || token.end - token.begin > 2) continue;
    writer.mention(il_iec::upper(list.text_of(token)));
  }
  for (const AstAnnotation& line : list.annotations) {
    for (const std::string_view pin : {"ET", "CV", "QD"}) {
      if (line.text.find("." + std::string(pin)) != std::string_view::npos) {
        writer.mention(std::string(pin));
      }
    }
  }
}

/// The end word of the unit that begins here; empty: instructions alone.
std::string take_unit(Cursor& cursor, ErrorLimit& errors) {
  const std::string word = cursor.word();
  if (word != "PROGRAM" && word != "FUNCTION_BLOCK") return {};
  cursor.take();
  if (cursor.at(TokenKind::Word)) {
    cursor.take();
  } else {
    errors.error("RP042", cursor.range(cursor.peek()),
                 "expected a name and found " + cursor.shown());
  }
  return "END_" + word;
}

void check_end(Cursor& cursor, const std::string& end_word, SourceRange begin,
               ErrorLimit& errors) {
  if (!end_word.empty()) {
    if (cursor.word() != end_word) {
      errors.error("RP042", begin, "this has no " + end_word);
      return;
    }
    cursor.take();
    cursor.accept(TokenKind::Semicolon);
  }
  cursor.skip_line_ends();
  if (cursor.at(TokenKind::End)) return;
  errors.error("RP041", cursor.range(cursor.peek()),
               cursor.shown() +
                   " is not supported: a file holds one PROGRAM or "
                   "FUNCTION_BLOCK");
}

void read_file(const TokenList& list, Ast& ast, ErrorLimit& errors) {
  Cursor cursor(list);
  il_iec::Names names(ast);
  il_iec::Writer writer(ast, names, errors);
  note_outputs(list, writer);
  cursor.skip_line_ends();
  const SourceRange begin = cursor.range(cursor.peek());
  const std::string word = cursor.word();
  if (word == "FUNCTION" || word == "CONFIGURATION" || word == "TYPE") {
    errors.error("RP041", begin,
                 cursor.shown() +
                     " is not supported: a file holds one PROGRAM or "
                     "FUNCTION_BLOCK");
    return;
  }
  const std::string end_word = take_unit(cursor, errors);
  const bool declared = il_iec::read_declarations(cursor, names, errors);
  il_iec::read_instructions(cursor, names, writer, errors, end_word,
                            end_word.empty() && !declared);
  names.finish();
  check_end(cursor, end_word, begin, errors);
}

/// To the first instruction, behind the declarations if there are any.
void skip_declarations(Cursor& cursor) {
  cursor.skip_line_ends();
  const std::string unit = cursor.word();
  if (unit == "PROGRAM" || unit == "FUNCTION_BLOCK" || unit == "FUNCTION") {
    cursor.skip_line();
  }
  cursor.skip_line_ends();
  while (cursor.word().starts_with("VAR")) {
    while (!cursor.at(TokenKind::End) && cursor.word() != "END_VAR") {
      cursor.take();
    }
    cursor.take();
    cursor.accept(TokenKind::Semicolon);
    cursor.skip_line_ends();
  }
  if (cursor.at(TokenKind::Word) && cursor.at(TokenKind::Colon, 1)) {
    cursor.take();
    cursor.take();
    cursor.skip_line_ends();
  }
}

}  // namespace

Ast read_il_iec(const SourceSet& sources, FileId file, DiagnosticSink& sink) {
  Ast ast;
  ast.file = file;
  ast.language = "il-iec";
  ast.dialect = "iec";
  ast.evaluation = Evaluation::ShortCircuit;
  ErrorLimit errors(sink);
  if (auto error = check_text(sources, file)) {
    sink.report(std::move(*error));
    return ast;
  }
  TokenList list = il_iec::tokenize(sources[file].text(), file);
  if (list.open_comment.has_value()) {
    errors.error("RP007", list.open_comment, "this comment is not closed");
  }
  read_file(list, ast, errors);
  take_comments(list, ast);
  errors.finish();
  return ast;
}

bool is_il_iec(std::string_view text) {
  const TokenList list = il_iec::tokenize(text, {});
  Cursor cursor(list);
  skip_declarations(cursor);
  if (!il_iec::is_operator(cursor.word())) return false;
  // `LD := x;` is structured text, `R = I0;` a script.
  return !cursor.at(TokenKind::Assign, 1) &&
         !cursor.at(TokenKind::Unknown, 1) && !cursor.at(TokenKind::Dot, 1) &&
         !cursor.at(TokenKind::Open, 1);
}

}  // namespace rung
