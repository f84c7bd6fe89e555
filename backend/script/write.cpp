#include "backend/script/write.h"

#include <algorithm>
#include <string>
#include <string_view>

#include "backend/script/elements.h"
#include "backend/unit/builder.h"
#include "backend/unit/comments.h"
#include "backend/unit/iec_text.h"
#include "backend/unit/infix.h"
#include "backend/unit/lower_iec.h"

namespace rung {
namespace backend {
namespace {

constexpr InfixSpelling kScript = {.and_sign = " && ",
                                   .or_sign = " || ",
                                   .xor_sign = " != ",
                                   .not_sign = "!",
                                   .equal = " == ",
                                   .not_equal = " != ",
                                   .true_word = "true",
                                   .false_word = "false"};

// Words of Javascript, and functions of the dialects.
constexpr std::string_view kWords =
    "C CR Cmp Cnt ORN T TOF TR async await break case catch class const "
    "continue debugger default delete do else enum export extends false "
    "finally for function if implements import in instanceof interface let "
    "new null package private protected public return static super switch "
    "this throw true try typeof var void while with yield undefined NaN "
    "Infinity";
constexpr NameRules kNames = {
    .reserved = kWords, .ignores_case = false, .plain_underscores = true};

/// A point of the simulator, or a pin: letters and a number.
struct Point {
  std::string_view letters;
  int number = -1;
};
Point point_of(std::string_view name) {
  const std::size_t digits = name.find_last_not_of("0123456789") + 1;
  const std::string_view number = name.substr(digits);
  if (number.empty() || number.size() > 3) return {};
  return {name.substr(0, digits), std::stoi(std::string(number))};
}

bool is_yun(const Program& program) {
  return program.dialect == "yun" ||
         std::any_of(
             program.instances.begin(), program.instances.end(),
             [](const Instance& it) { return it.kind->dialect == "yun"; });
}

class ScriptWriter {
 public:
  ScriptWriter(const Unit& unit, const RungComments& comments)
      : unit_(unit), comments_(comments) {}

  std::string run(const PropertyLines& properties, bool yun) {
    text_ = yun ? "//@ dialect yun\n" : "//@ dialect sim\n";
    declare(yun);
    for (const std::string& line : properties.lines) {
      // Ranges are declared above.
      if (!line.starts_with("input ")) text_ += "//@ " + line + '\n';
    }
    for (const std::string& line : properties.comments) {
      text_ += "// of the source: " + line + '\n';
    }
    for (const Statement& item : unit_.statements) {
      open_rung(item.rung.index());
      statement(item);
    }
    open_rung(static_cast<std::uint32_t>(comments_.before.size()));
    for (const std::string& line : comments_.at_end) comment(line);
    initials();
    return std::move(text_);
  }

 private:
  // What its name does not say.
  void declare(bool yun) {
    for (const Variable& variable : unit_.variables) {
      const std::string_view letters = point_of(variable.name).letters;
      if (variable.role == CellRole::Input) {
        if (variable.type == Type::Word) {
          text_ += "//@ input " + variable.name + " in " +
                   std::to_string(variable.low) + ".." +
                   std::to_string(variable.high) + '\n';
        } else if (letters != (yun ? "pin" : "I")) {
          text_ += "//@ input " + variable.name + '\n';
        }
      } else if (variable.role == CellRole::Output) {
        const bool known =
            yun ? letters == "pin" : letters == "Q" || letters == "QW";
        if (!known) text_ += "//@ output " + variable.name + '\n';
      }
    }
  }

  void comment(const std::string& line) {
    // A comment that begins a section would begin one here.
    const bool marks = line.starts_with("Var") || line.starts_with("Sim") ||
                       line.starts_with("@");
    text_ += (marks ? "// - " : "// ") + line + '\n';
  }

  void open_rung(std::uint32_t rung) {
    for (; next_rung_ <= rung && next_rung_ < comments_.before.size();
         ++next_rung_) {
      for (const std::string& line : comments_.before[next_rung_]) {
        comment(line);
      }
    }
  }

  void statement(const Statement& item) {
    const Variable& target = unit_.variables[item.target];
    text_ += target.name + " = ";
    const bool word = target.type == Type::Word;
    if (item.guard.empty()) {
      append_infix(text_, unit_, item.value, kScript);
      // A number that is no bit, whatever it is.
      if (word) text_ += " + 0";
    } else {
      const Terms old = read_term(item.target, target.type);
      Terms on = item.guard;
      Terms off = negated(item.guard);
      if (word) {
        push_operator(on, NodeOp::ToWord, Type::Word, 1);
        push_operator(off, NodeOp::ToWord, Type::Word, 1);
      }
      const NodeOp times = word ? NodeOp::Multiply : NodeOp::And;
      append_infix(text_, unit_,
                   joined(word ? NodeOp::Add : NodeOp::Or, target.type,
                          joined(times, target.type, on, item.value),
                          joined(times, target.type, off, old)),
                   kScript);
    }
    text_ += ";\n";
  }

  void initials() {
    std::string lines;
    for (const Variable& variable : unit_.variables) {
      if (variable.initial == 0) continue;
      lines += variable.name + " = ";
      lines += variable.type == Type::Bit ? "true"
                                          : std::to_string(variable.initial);
      lines += ";\n";
    }
    if (!lines.empty()) text_ += "//Var\n" + lines;
  }

  const Unit& unit_;
  const RungComments& comments_;
  std::string text_;
  std::size_t next_rung_ = 0;
};

class NameCheck {
 public:
  NameCheck(const Program& program, DiagnosticSink& sink, bool yun)
      : program_(program), sink_(sink), yun_(yun) {}

  /// Signals whose names say another thing in a script.
  bool run() {
    for (const Cell& cell : program_.cells) {
      const Point point = point_of(cell.name);
      if (cell.made) continue;
      if (yun_ ? !fits_yun(cell, point) : !fits_sim(cell, point)) {
        fail(cell, " cannot be " + std::string(role(cell)) +
                       " of a script of the dialect " + (yun_ ? "yun" : "sim"));
      }
    }
    return good_;
  }

 private:
  void fail(const Cell& cell, const std::string& why) {
    good_ = false;
    sink_.report({.code = "RP084",
                  .severity = Severity::Error,
                  .where = cell.where.has_value()
                               ? cell.where
                               : SourceRange{program_.file, 0, 0},
                  .message = "`" + cell.name + "`" + why});
  }

  static std::string_view role(const Cell& cell) {
    const bool word = cell.type == Type::Word;
    if (cell.role == CellRole::Input)
      return word ? "an input word" : "an input";
    if (cell.role == CellRole::Output) {
      return word ? "an output word" : "an output";
    }
    return word ? "a memory word" : "a memory cell";
  }

  static bool fits_sim(const Cell& cell, Point point) {
    const bool word = cell.type == Type::Word;
    const bool input = cell.role == CellRole::Input;
    if (point.letters == "I") return input && !word && point.number <= 8;
    if (point.letters == "IW") return input && word && point.number <= 1;
    const bool output = cell.role == CellRole::Output;
    if (point.letters == "Q") return output && !word && point.number <= 8;
    if (point.letters == "QW") return output && word && point.number <= 1;
    return !(input && word);
  }

  bool fits_yun(const Cell& cell, Point point) const {
    const bool word = cell.type == Type::Word;
    const bool input = cell.role == CellRole::Input;
    if (cell.initial != 0) return false;
    if (point.letters == "A") return input && word && point.number <= 5;
    if (point.letters == "y") return !input && point.number <= 15;
    return point.letters == "pin" && point.number <= 13 &&
           (input || cell.role == CellRole::Output);
  }

  const Program& program_;
  DiagnosticSink& sink_;
  bool yun_;
  bool good_ = true;
};

}  // namespace
}  // namespace backend

std::optional<backend::Written> lower_to_script(const Program& program,
                                                const SourceSet& sources,
                                                DiagnosticSink& sink) {
  const bool yun = backend::is_yun(program);
  const backend::Profile profile = {.name = "rung scripts",
                                    .names = &backend::kNames,
                                    .conditions = !yun,
                                    .wraps = yun,
                                    .inline_calls = true,
                                    .short_circuits = !yun};
  const bool names = backend::NameCheck(program, sink, yun).run();
  const auto elements = backend::script_elements(yun);
  const std::optional<backend::Unit> unit =
      backend::UnitBuilder(program, profile, sink).build(*elements, "");
  if (!unit || !names) return std::nullopt;
  backend::Written written = backend::finish_written(*unit, {});
  const backend::RungComments comments =
      backend::place_comments(program, sources);
  written.text =
      backend::ScriptWriter(*unit, comments)
          .run(backend::carry_properties(program, written.signals), yun);
  return written;
}

}  // namespace rung
