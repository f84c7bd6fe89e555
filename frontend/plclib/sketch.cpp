#include "frontend/plclib/sketch.h"

#include <array>
#include <utility>

namespace rung::plclib {
namespace {

constexpr std::size_t kMostTasks = 4;

struct TypeName {
  std::string_view name;
  CType type;
};
constexpr std::array<TypeName, 13> kTypes = {{{"void", CType::Void},
                                              {"bool", CType::Bool},
                                              {"boolean", CType::Bool},
                                              {"char", CType::Char},
                                              {"byte", CType::Byte},
                                              {"uint8_t", CType::Byte},
                                              {"int", CType::Int},
                                              {"long", CType::Long},
                                              {"unsigned", CType::Unsigned},
                                              {"uint32_t", CType::UnsignedLong},
                                              {"int32_t", CType::Long},
                                              {"word", CType::Unsigned},
                                              {"int8_t", CType::Char}}};

std::optional<CType> named_type(std::string_view word) {
  for (const TypeName& row : kTypes) {
    if (row.name == word) return row.type;
  }
  return std::nullopt;
}

class SketchReader {
 public:
  SketchReader(const TokenList& list, Sketch& sketch, ErrorLimit& errors)
      : cursor_(list), sketch_(sketch), errors_(errors) {}

  void run() {
    while (!cursor_.at_end()) item();
    std::stable_sort(
        sketch_.tasks.begin(), sketch_.tasks.end(),
        [](const Task& a, const Task& b) { return a.period_ms > b.period_ms; });
    check_tasks();
    for (const char* const name : {"setup", "loop"}) {
      if (sketch_.find(name) != nullptr) continue;
      errors_.error("RP056", cursor_.here(),
                    "this sketch has no function " + quoted_excerpt(name));
    }
  }

 private:
  void fail(std::string_view code, SourceRange where, std::string message) {
    errors_.error(code, where, std::move(message));
  }

  void expected(std::string_view what) {
    fail("RP056", cursor_.here(),
         "expected " + std::string(what) + " and found " + cursor_.shown());
    cursor_.skip_statement();
  }

  void item() {
    if (cursor_.accept(";")) return;
    if (cursor_.at("}")) {
      expected("a declaration");
      cursor_.take();
      return;
    }
    if (cursor_.at_keyword("extern")) return external();
    if (cursor_.at_keyword("static")) cursor_.take();
    const SourceRange where = cursor_.here();
    if (cursor_.at_word()) {
      if (const auto object = object_kind(cursor_.text())) {
        cursor_.take();
        return variables(CType::Void, object, false);
      }
    }
    bool constant = false;
    if (const auto type = take_type(cursor_, constant)) {
      if (cursor_.at_word() && cursor_.at("(", 1)) return function();
      return variables(*type, std::nullopt, constant);
    }
    fail("RP055", where, cursor_.shown() + " is not supported here");
    cursor_.skip_statement();
  }

  // Of the library's own variables only the accumulator means anything here.
  void external() {
    const SourceRange where = cursor_.here();
    cursor_.take();
    bool constant = false;
    const auto type = take_type(cursor_, constant);
    const bool known = type && cursor_.at_keyword("scanValue");
    if (!known) {
      fail("RP055", where,
           cursor_.at_keyword("timer0_millis")
               ? "`timer0_millis` is the clock of millis(): its wrap is not "
                 "modelled"
               : cursor_.shown() +
                     " is declared elsewhere: what else writes "
                     "it is not known");
      return cursor_.skip_statement();
    }
    cursor_.take();
    if (!cursor_.accept(";")) expected("`;`");
  }

  void variables(CType type, std::optional<ObjectKind> object, bool constant) {
    do {
      if (!cursor_.at_word()) return expected("a name");
      Global global{cursor_.text(), type, object, constant, 0, cursor_.here()};
      cursor_.take();
      if (cursor_.at("[")) {
        fail("RP055", global.where,
             quoted_excerpt(global.name) +
                 " is an array: that is not supported");
        return cursor_.skip_statement();
      }
      if (type == CType::Void && !object) return expected("a function");
      const bool begins = object ? cursor_.at("(") : cursor_.at("=");
      if (begins) {
        cursor_.take();
        global.initialiser = cursor_.position();
        skip_initialiser(object.has_value());
      }
      sketch_.globals.push_back(global);
    } while (cursor_.accept(","));
    if (!cursor_.accept(";")) expected("`;`");
  }

  void skip_initialiser(bool bracket) {
    while (!cursor_.at_end() && !cursor_.at(";") && !cursor_.at("}")) {
      if (cursor_.at("(")) {
        cursor_.skip_brackets();
        continue;
      }
      if (bracket && cursor_.accept(")")) return;
      if (!bracket && cursor_.at(",")) return;
      cursor_.take();
    }
  }

  void function() {
    Function function{cursor_.text(), 0, 0, cursor_.here()};
    cursor_.take();
    cursor_.take();
    std::optional<std::int64_t> period;
    if (cursor_.peek().kind == TokenKind::Number && cursor_.at(")", 1)) {
      period = take_period(function);
    } else if (cursor_.at_keyword("void")) {
      cursor_.take();
    }
    if (!cursor_.at(")")) {
      fail("RP055", function.where,
           quoted_excerpt(function.name) +
               " has parameters: that is not supported");
      while (!cursor_.at_end() && !cursor_.at("{") && !cursor_.at(";")) {
        cursor_.take();
      }
      return cursor_.skip_statement();
    }
    cursor_.take();
    if (cursor_.accept(";")) return;  // a declaration says nothing more
    if (!cursor_.at("{")) return expected("`{`");
    function.begin = cursor_.position() + 1;
    const SourceRange open = cursor_.here();
    const bool closed = cursor_.skip_brackets();
    function.end = cursor_.position() - 1;
    if (!closed) {
      return fail("RP056", open, "this `{` is not closed");
    }
    add(function, period);
  }

  std::optional<std::int64_t> take_period(const Function& function) {
    const auto literal = read_literal(cursor_.text(), 32);
    const std::string_view digits =
        function.name.substr(std::min<std::size_t>(4, function.name.size()));
    const bool named =
        function.name.starts_with("loop") && !digits.empty() &&
        digits.find_first_not_of("0123456789") == std::string_view::npos;
    cursor_.take();
    if (!named || !literal || literal->value == 0) {
      fail("RP055", function.where,
           quoted_excerpt(function.name) +
               " with a number is no task: a task is `loopN(period)`, with a "
               "period of 1 ms or more");
      return std::nullopt;
    }
    return literal->value;
  }

  void add(const Function& function, std::optional<std::int64_t> period) {
    const auto [place, is_new] =
        sketch_.functions.emplace(function.name, function);
    if (!is_new) {
      return fail("RP057", function.where,
                  quoted_excerpt(function.name) + " is defined twice");
    }
    if (period) sketch_.tasks.push_back({&place->second, *period});
  }

  void check_tasks() {
    const std::vector<Task>& tasks = sketch_.tasks;
    if (tasks.size() > kMostTasks) {
      fail("RP059", tasks[kMostTasks].function->where,
           "there are more than " + std::to_string(kMostTasks) + " tasks");
    }
    for (std::size_t i = 1; i < tasks.size(); ++i) {
      if (tasks[i].period_ms != tasks[i - 1].period_ms) continue;
      fail("RP055", tasks[i].function->where,
           "two tasks have the same period: which of them goes first is not "
           "known");
    }
  }

  Cursor cursor_;
  Sketch& sketch_;
  ErrorLimit& errors_;
};

}  // namespace

bool Cursor::skip_brackets() {
  std::size_t depth = 0;
  do {
    if (at("(") || at("{") || at("[")) ++depth;
    if (at(")") || at("}") || at("]")) --depth;
    take();
  } while (depth > 0 && !at_end());
  return depth == 0;
}

void Cursor::skip_statement() {
  while (!at_end() && !at("}")) {
    if (at("{")) {
      skip_brackets();
      return;
    }
    if (at("(") || at("[")) {
      skip_brackets();
      continue;
    }
    if (accept(";")) return;
    take();
  }
}

std::optional<CType> take_type(Cursor& cursor, bool& is_constant) {
  std::optional<CType> type;
  bool has_unsigned = false;
  for (; cursor.at_word(); cursor.take()) {
    const std::string_view word = cursor.text();
    if (word == "const") {
      is_constant = true;
      continue;
    }
    if (word == "volatile" || word == "signed") continue;
    const std::optional<CType> named = named_type(word);
    if (!named) break;
    has_unsigned = has_unsigned || word == "unsigned";
    // `int` behind `long` or `unsigned` adds nothing.
    if (!type || *type == CType::Unsigned || *type == CType::Int) type = *named;
  }
  if (!type || !has_unsigned) return type;
  if (*type == CType::Char) return CType::Byte;
  return *type == CType::Long ? CType::UnsignedLong : CType::Unsigned;
}

std::optional<ObjectKind> object_kind(std::string_view word) {
  if (word == "Counter") return ObjectKind::Counter;
  if (word == "Shift") return ObjectKind::Shift;
  if (word == "Stack") return ObjectKind::Stack;
  if (word == "Pulse") return ObjectKind::Pulse;
  return std::nullopt;
}

Sketch read_sketch(const TokenList& list, const Directives& directives,
                   ErrorLimit& errors) {
  Sketch sketch;
  sketch.no_pin_defs = directives.no_pin_defs;
  SketchReader(list, sketch, errors).run();
  return sketch;
}

}  // namespace rung::plclib
