#include "frontend/il_mitsubishi/reader.h"

#include <algorithm>
#include <array>
#include <utility>

#include "frontend/encoding.h"
#include "frontend/error_limit.h"
#include "frontend/il_mitsubishi/list_reader.h"

namespace rung {
namespace {

/// `language` lines have been obeyed; the others are properties.
void take_comments(melsec::LineList& list, Ast& ast) {
  for (const AstAnnotation& line : list.annotations) {
    const std::string_view word =
        line.text.substr(0, line.text.find_first_of(" \t"));
    if (word != "language") ast.annotations.push_back(line);
  }
  ast.comments = std::move(list.comments);
}

/// Instructions that IEC 61131-3 has, too.
bool is_common(std::string_view name) {
  constexpr std::array<std::string_view, 4> kCommon = {"LD", "AND", "OR",
                                                       "XOR"};
  return std::find(kCommon.begin(), kCommon.end(), name) != kCommon.end();
}

bool looks_like_device(std::string_view word) {
  return word.size() >= 2 &&
         std::string_view("XYMSLTCxymsltc").find(word[0]) !=
             std::string_view::npos &&
         word.find_first_not_of("0123456789", 1) == std::string_view::npos;
}

}  // namespace

Ast read_il_mitsubishi(const SourceSet& sources, FileId file,
                       DiagnosticSink& sink) {
  Ast ast;
  ast.file = file;
  ast.language = "il-mitsubishi";
  ast.dialect = "melsec";
  ErrorLimit errors(sink);
  if (auto error = check_text(sources, file)) {
    sink.report(std::move(*error));
    return ast;
  }
  melsec::LineList list = melsec::split_lines(sources[file].text(), file);
  StatementWriter writer(ast);
  melsec::ListReader(list, ast, writer, errors).run();
  take_comments(list, ast);
  errors.finish();
  return ast;
}

bool is_il_mitsubishi(std::string_view text) {
  const melsec::LineList list = melsec::split_lines(text, {});
  bool first = true;
  for (const melsec::Line& line : list.lines) {
    const std::string name = melsec::upper(list.text_of(line.words[0]));
    const melsec::Operator* const op = melsec::find_operator(name);
    if (op == nullptr) return false;
    const bool contact = op->code == melsec::Code::Contact;
    if (first && (!contact || op->join != melsec::Join::Load)) return false;
    first = false;
    const bool compares = op->compare != AstOp::Name;
    if (contact && !compares &&
        (line.count != 2 || !looks_like_device(list.text_of(line.words[1])))) {
      return false;
    }
    if (!contact || !is_common(name)) return true;
  }
  return !first;
}

}  // namespace rung
