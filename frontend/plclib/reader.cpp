#include "frontend/plclib/reader.h"

#include <array>
#include <string>
#include <utility>

#include "frontend/encoding.h"
#include "frontend/error_limit.h"
#include "frontend/plclib/machine.h"

namespace rung {
namespace {

using plclib::Estimates;
using plclib::Machine;
using plclib::Reading;
using plclib::Sketch;
using plclib::TokenKind;
using plclib::TokenList;

// Estimates widen long before.
constexpr int kMostPasses = 12;

constexpr std::array<std::string_view, 10> kThesisCalls = {
    "load",  "loadInv",    "andLogic", "andInv",  "orLogic",
    "orInv", "timerDelay", "m8013",    "counter", "counterState"};

/// The library whose calls the sketch makes; those that both have say nothing.
bool is_thesis(const TokenList& list) {
  for (std::size_t i = 0; i + 1 < list.tokens.size(); ++i) {
    if (list.tokens[i].kind != TokenKind::Word ||
        list.text_of(list.tokens[i + 1]) != "(") {
      continue;
    }
    for (const std::string_view name : kThesisCalls) {
      if (list.text_of(list.tokens[i]) == name) return true;
    }
  }
  return false;
}

std::string_view first_word(std::string_view line) {
  return line.substr(0, line.find_first_of(" \t"));
}

/// `inputs stable` is for the reader; `language` lines have been obeyed.
bool asks_for_stable_inputs(const TokenList& list, ErrorLimit& errors) {
  bool stable = false;
  for (const AstAnnotation& line : list.annotations) {
    if (first_word(line.text) != "inputs") continue;
    std::string_view rest = line.text.substr(6);
    while (!rest.empty() && (rest[0] == ' ' || rest[0] == '\t')) {
      rest.remove_prefix(1);
    }
    if (rest == "stable") {
      stable = true;
    } else {
      errors.error(
          "RP056", line.where,
          "expected `inputs stable` and found " + quoted_excerpt(line.text));
    }
  }
  return stable;
}

void take_comments(TokenList& list, Ast& ast) {
  for (const AstAnnotation& line : list.annotations) {
    const std::string_view word = first_word(line.text);
    if (word != "language" && word != "inputs") {
      ast.annotations.push_back(line);
    }
  }
  ast.comments = std::move(list.comments);
}

Ast new_ast(FileId file, const Reading& reading) {
  Ast ast;
  ast.file = file;
  ast.language = "plclib";
  ast.dialect = reading.thesis ? "plclib" : "plclib14";
  ast.semantics = ast.dialect;
  return ast;
}

/// Passes until nothing new is learned of the variables' values; only the last
/// one says what is wrong.
Ast execute(const TokenList& list, const Sketch& sketch, const Reading& reading,
            FileId file, ErrorLimit& errors) {
  Estimates estimates;
  for (; estimates.pass < kMostPasses; ++estimates.pass) {
    DiagnosticList unheard;
    ErrorLimit muted(unheard);
    Ast ast = new_ast(file, reading);
    estimates.grown = false;
    Machine(list, sketch, reading, estimates, ast, muted).run();
    if (!estimates.grown) break;
  }
  Ast ast = new_ast(file, reading);
  Machine machine(list, sketch, reading, estimates, ast, errors);
  estimates.grown = false;
  machine.run();
  if (estimates.grown) {
    errors.error("RP059", sketch.find("loop")->where,
                 "the values of the variables depend on each other in too "
                 "many steps");
  }
  // A scan lasts as much longer as the program waits in it.
  ast.scan_min_ms += machine.blocked_ms();
  ast.scan_max_ms += machine.blocked_ms();
  return ast;
}

}  // namespace

Ast read_plclib(const SourceSet& sources, FileId file,
                const ReadOptions& options, DiagnosticSink& sink) {
  ErrorLimit errors(sink);
  if (auto error = check_text(sources, file)) {
    sink.report(std::move(*error));
    return new_ast(file, {});
  }
  TokenList list = plclib::tokenize(sources[file].text(), file);
  if (list.open_comment.has_value()) {
    errors.error("RP007", list.open_comment, "this comment is not closed");
  }
  const plclib::Directives directives = plclib::preprocess(list, errors);
  Reading reading;
  reading.thesis = options.semantics != nullptr
                       ? options.semantics->name == "plclib"
                       : is_thesis(list);
  reading.stable_inputs =
      asks_for_stable_inputs(list, errors) || options.stable_inputs;
  const Sketch sketch = plclib::read_sketch(list, directives, errors);
  Ast ast = sketch.find("loop") != nullptr && sketch.find("setup") != nullptr
                ? execute(list, sketch, reading, file, errors)
                : new_ast(file, reading);
  take_comments(list, ast);
  errors.finish();
  return ast;
}

}  // namespace rung
