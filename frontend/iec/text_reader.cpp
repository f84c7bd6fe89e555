#include "frontend/iec/text_reader.h"

#include <algorithm>
#include <string>
#include <utility>

#include "frontend/encoding.h"
#include "frontend/iec/bodies.h"
#include "frontend/iec/cursor.h"
#include "frontend/iec/declarations.h"
#include "frontend/iec/types.h"

namespace rung::iec {
namespace {

bool begins_unit(std::string_view word) {
  return word == "PROGRAM" || word == "FUNCTION_BLOCK" || word == "FUNCTION";
}

class UnitReader {
 public:
  UnitReader(std::shared_ptr<const TokenList> list, Project& project,
             ErrorLimit& errors)
      : list_(std::move(list)),
        cursor_(*list_),
        project_(project),
        errors_(errors) {}

  void run() {
    bool any = false;
    while (true) {
      skip_pragmas();
      if (cursor_.at(TokenKind::End)) break;
      const std::string word = cursor_.word();
      if (begins_unit(word)) {
        unit(word);
      } else if (word == "CONFIGURATION") {
        configuration();
      } else if (word == "TYPE") {
        skip_to("END_TYPE");
      } else if (word == "VAR_GLOBAL") {
        globals();
      } else if (!any) {
        return bare();
      } else {
        return error("RP042", cursor_.here(),
                     "expected PROGRAM, FUNCTION_BLOCK, FUNCTION or "
                     "CONFIGURATION and found " +
                         cursor_.shown());
      }
      any = true;
    }
  }

 private:
  void error(std::string_view code, SourceRange where, std::string message) {
    errors_.error(code, where, std::move(message));
  }

  // Between units a pragma is an attribute, but for one that stands for text.
  void skip_pragmas() {
    while (true) {
      cursor_.skip_line_ends();
      if (cursor_.accept(TokenKind::Semicolon)) continue;
      if (!cursor_.at(TokenKind::Pragma)) return;
      const Token token = cursor_.take();
      if (upper(cursor_.text(token)).find("INCLUDE") == std::string::npos) {
        continue;
      }
      error("RP041", cursor_.range(token),
            "an include is not supported: the file would be read in part");
    }
  }

  /// Behind the next such word; the error is at `begin`.
  bool skip_to(std::string_view word) {
    const SourceRange begin = cursor_.here();
    while (!cursor_.at(TokenKind::End)) {
      if (cursor_.word() == word) {
        cursor_.take();
        return true;
      }
      cursor_.take();
    }
    error("RP042", begin, "this has no " + std::string(word));
    return false;
  }

  std::string_view name(std::string_view what) {
    cursor_.skip_line_ends();
    if (cursor_.at(TokenKind::Word)) return cursor_.text(cursor_.take());
    error("RP042", cursor_.here(),
          "expected " + std::string(what) + " and found " + cursor_.shown());
    return {};
  }

  void unit(const std::string& word) {
    const SourceRange begin = cursor_.here();
    cursor_.take();
    Pou pou;
    pou.kind = word == "PROGRAM"    ? PouKind::Program
               : word == "FUNCTION" ? PouKind::Function
                                    : PouKind::FunctionBlock;
    cursor_.skip_line_ends();
    pou.where = cursor_.here();
    pou.name = name("a name");
    cursor_.skip_line_ends();
    if (pou.kind == PouKind::Function) {
      if (cursor_.accept(TokenKind::Colon)) {
        pou.result = name("the type of the result");
      } else {
        error("RP042", cursor_.here(),
              "expected `:` and the type of the function's result and found " +
                  cursor_.shown());
      }
    }
    read_declarations(cursor_, pou.variables, errors_);
    const std::size_t body = cursor_.position();
    const std::string end_word = "END_" + word;
    while (!cursor_.at(TokenKind::End) && cursor_.word() != end_word) {
      if (begins_unit(cursor_.word())) break;
      cursor_.take();
    }
    if (cursor_.word() != end_word) {
      return error("RP042", begin, "this has no " + end_word);
    }
    pou.body = body_of(body, cursor_.position());
    cursor_.take();
    cursor_.accept(TokenKind::Semicolon);
    project_.pous.push_back(std::move(pou));
  }

  Body body_of(std::size_t begin, std::size_t end) const {
    return looks_like_list(*list_, begin, end)
               ? instruction_list(list_, begin, end)
               : structured_text(list_, begin, end);
  }

  /// A body without a unit around it.
  void bare() {
    Pou pou;
    pou.where = cursor_.here();
    pou.name = "the program";
    const bool declared = read_declarations(cursor_, pou.variables, errors_);
    const std::size_t begin = cursor_.position();
    const std::size_t end = list_->tokens.size() - 1;
    pou.by_use = !declared && looks_like_list(*list_, begin, end);
    pou.body = body_of(begin, end);
    project_.pous.push_back(std::move(pou));
  }

  void globals() {
    const std::size_t first = project_.globals.size();
    read_declarations(cursor_, project_.globals, errors_);
    for (std::size_t i = first; i < project_.globals.size(); ++i) {
      if (project_.globals[i].role == Role::Global) continue;
      error("RP042", project_.globals[i].where,
            "this block of variables belongs to no unit");
    }
  }

  // --- CONFIGURATION ---------------------------------------------------------

  void configuration() {
    const SourceRange begin = cursor_.here();
    cursor_.take();
    name("a name");
    while (true) {
      cursor_.skip_line_ends();
      const std::string word = cursor_.word();
      if (word == "END_CONFIGURATION") {
        cursor_.take();
        cursor_.accept(TokenKind::Semicolon);
        return;
      }
      if (word == "VAR_GLOBAL") {
        globals();
      } else if (word == "RESOURCE") {
        cursor_.take();
        name("a name");
        if (cursor_.accept_word("ON")) name("a name");
      } else if (word == "TASK") {
        task();
      } else if (word == "PROGRAM") {
        instance();
      } else if (word == "END_RESOURCE" || cursor_.at(TokenKind::Semicolon)) {
        cursor_.take();
      } else {
        error(cursor_.at(TokenKind::End) ? "RP042" : "RP041",
              cursor_.at(TokenKind::End) ? begin : cursor_.here(),
              cursor_.at(TokenKind::End)
                  ? "this has no END_CONFIGURATION"
                  : cursor_.shown() + " in a configuration is not supported");
        if (!cursor_.at(TokenKind::End)) skip_to("END_CONFIGURATION");
        return;
      }
    }
  }

  // TASK name (INTERVAL := T#20ms, PRIORITY := 0);
  void task() {
    cursor_.take();
    Task task;
    task.name = upper(name("a name"));
    while (!cursor_.at(TokenKind::End) && !cursor_.at(TokenKind::Semicolon)) {
      const SourceRange where = cursor_.here();
      const std::string word = cursor_.word();
      cursor_.take();
      if (word == "SINGLE") {
        error("RP041", where,
              "a task that an event starts (SINGLE) is not supported");
      }
      if (word != "INTERVAL" || !cursor_.accept(TokenKind::Assign)) continue;
      cursor_.skip_line_ends();
      const Token value = cursor_.take();
      const auto time = value.kind == TokenKind::Time
                            ? milliseconds_of(cursor_.text(value))
                            : std::nullopt;
      if (time && *time > 0) {
        task.interval_ms = *time;
      } else {
        error("RP043", cursor_.range(value),
              quoted_excerpt(cursor_.text(value)) +
                  " is no interval that is supported: whole milliseconds, "
                  "such as T#20ms");
      }
    }
    tasks_.push_back(std::move(task));
  }

  // PROGRAM instance [WITH task] : type;
  void instance() {
    cursor_.take();
    ProgramInstance instance;
    instance.where = cursor_.here();
    instance.name = name("a name");
    if (cursor_.accept_word("WITH")) {
      const std::string task = upper(name("a task"));
      for (const Task& it : tasks_) {
        if (it.name == task) instance.interval_ms = it.interval_ms;
      }
    }
    if (!cursor_.accept(TokenKind::Colon)) {
      error("RP042", cursor_.here(),
            "expected `:` and a program and found " + cursor_.shown());
    } else {
      instance.type = name("a program");
    }
    if (cursor_.at(TokenKind::Open)) {
      error("RP041", cursor_.here(),
            "connections of a program's variables are not supported");
    }
    while (!cursor_.at(TokenKind::End) &&
           !cursor_.accept(TokenKind::Semicolon)) {
      cursor_.take();
    }
    project_.instances.push_back(instance);
  }

  struct Task {
    std::string name;
    std::optional<std::int64_t> interval_ms;
  };

  std::shared_ptr<const TokenList> list_;
  Cursor cursor_;
  Project& project_;
  ErrorLimit& errors_;
  std::vector<Task> tasks_;
};

}  // namespace

void take_comments(const TokenList& list, Ast& ast) {
  for (const AstAnnotation& line : list.annotations) {
    const std::string_view word =
        line.text.substr(0, line.text.find_first_of(" \t"));
    if (word != "language") ast.annotations.push_back(line);
  }
  ast.comments.insert(ast.comments.end(), list.comments.begin(),
                      list.comments.end());
}

void read_units(std::shared_ptr<const TokenList> list, Project& project,
                ErrorLimit& errors) {
  UnitReader(std::move(list), project, errors).run();
}

void note_mentions(const TokenList& list, Project& project) {
  constexpr std::size_t kLongest = 3;  // ENO
  for (const Token& token : list.tokens) {
    if (token.kind != TokenKind::Word || token.end - token.begin > kLongest) {
      continue;
    }
    project.mentioned.insert(upper(list.text_of(token)));
  }
  for (const AstAnnotation& line : list.annotations) {
    note_mentions(line.text, project);
  }
}

void note_mentions(std::string_view property, Project& project) {
  for (const std::string_view pin : {"ET", "CV", "QD", "ENO"}) {
    if (upper(property).find("." + std::string(pin)) != std::string::npos) {
      project.mentioned.insert(std::string(pin));
    }
  }
}

ExpandOptions expand_options(const ReadOptions& options, Ast& ast) {
  const Semantics* preset = options.semantics;
  if (preset == nullptr) preset = find_semantics("iec");
  ast.semantics = preset->name;
  ast.dialect = preset->elements;
  return {.dialect = preset->elements,
          .separate_sizes = preset->name == "openplc",
          .pou = options.pou};
}

void take_interval(const Project& project, const Pou& main, Ast& ast) {
  for (const ProgramInstance& instance : project.instances) {
    if (upper(instance.type) != upper(main.name)) continue;
    if (!instance.interval_ms) continue;
    ast.scan_min_ms = *instance.interval_ms;
    ast.scan_max_ms = *instance.interval_ms;
  }
}

Ast read_text(const SourceSet& sources, FileId file, std::string_view language,
              const ReadOptions& options, DiagnosticSink& sink) {
  Ast ast;
  ast.file = file;
  ast.language = language;
  ExpandOptions expansion = expand_options(options, ast);
  ErrorLimit errors(sink);
  if (auto error = check_text(sources, file)) {
    sink.report(std::move(*error));
    return ast;
  }
  auto list =
      std::make_shared<const TokenList>(tokenize(sources[file].text(), file));
  if (list->open_comment.has_value()) {
    errors.error("RP007", list->open_comment, "this comment is not closed");
  }
  Project project;
  note_mentions(*list, project);
  read_units(list, project, errors);
  const SourceRange begin = {file, 0, 0};
  const Pou* const main = errors.has_errors()
                              ? nullptr
                              : main_pou(project, expansion, errors, begin);
  if (main != nullptr) {
    expand(project, *main, expansion, ast, errors);
    take_interval(project, *main, ast);
  }
  take_comments(*list, ast);
  errors.finish();
  return ast;
}

Looks looks_like(std::string_view text) {
  auto list = std::make_shared<const TokenList>(tokenize(text, {}));
  DiagnosticList ignored;
  ErrorLimit errors(ignored);
  Cursor cursor(*list);
  while (cursor.at(TokenKind::LineEnd) || cursor.at(TokenKind::Pragma)) {
    cursor.take();
  }
  const std::string word = cursor.word();
  const bool unit = begins_unit(word) || word == "CONFIGURATION" ||
                    word == "TYPE" || word == "VAR" || word.starts_with("VAR_");
  // `TYPE = I0;` is a script.
  if (unit && cursor.at(TokenKind::Equal, 1)) return Looks::Neither;
  if (!unit) {
    const std::size_t end = list->tokens.size() - 1;
    return looks_like_list(*list, cursor.position(), end) ? Looks::List
                                                          : Looks::Neither;
  }
  std::vector<Variable> variables;
  while (!cursor.at(TokenKind::End)) {
    const std::string here = cursor.word();
    const bool begins = begins_unit(here);
    if (begins) {
      cursor.take();
      cursor.take();
      if (cursor.accept(TokenKind::Colon)) cursor.take();
    }
    if (begins || here.starts_with("VAR")) {
      if (!read_declarations(cursor, variables, errors) && !begins) {
        cursor.take();
      }
      if (cursor.at(TokenKind::End) || cursor.word().starts_with("END_") ||
          (!begins && cursor.word() == "CONFIGURATION")) {
        continue;
      }
      return looks_like_list(*list, cursor.position(), list->tokens.size() - 1)
                 ? Looks::List
                 : Looks::StructuredText;
    }
    cursor.take();
  }
  return Looks::StructuredText;
}

}  // namespace rung::iec
