#include "analysis/property.h"

#include <algorithm>
#include <cstddef>
#include <unordered_map>
#include <utility>

#include "analysis/property_builtin.h"
#include "analysis/property_check.h"
#include "analysis/property_line.h"
#include "base/text.h"

namespace rung {
namespace {

class PropertyReader {
 public:
  PropertyReader(Program& program, const SourceSet& sources,
                 DiagnosticSink& sink)
      : program_(program),
        sources_(sources),
        sink_(sink),
        names_(program),
        checker_(program, names_, sink),
        written_(program.cells.size(), false) {
    for (const Rung& rung : program.rungs) written_[rung.target.index()] = true;
  }

  PropertySet read(const std::vector<AstAnnotation>& extra) {
    parse(program_.annotations);
    parse(extra);
    // Declarations first: the types and roles of all other lines rest on them.
    for (const Statement& statement : statements_) declare(statement);
    for (const Statement& statement : statements_) add(statement);
    std::vector<Property> built_in = builtin_properties(program_, sources_);
    set_.properties.reserve(set_.properties.size() + built_in.size());
    names_taken_.reserve(names_taken_.size() + built_in.size());
    for (Property& property : built_in) {
      take_names(property);
      set_.properties.push_back(std::move(property));
    }
    for (const Statement& statement : statements_) expect(statement);
    return std::move(set_);
  }

 private:
  void fail(std::string_view code, SourceRange where, std::string message,
            std::vector<Label> labels = {}) {
    sink_.report({.code = code,
                  .severity = Severity::Error,
                  .where = where,
                  .message = std::move(message),
                  .labels = std::move(labels)});
  }

  void parse(const std::vector<AstAnnotation>& annotations) {
    statements_.reserve(statements_.size() + annotations.size());
    for (const AstAnnotation& annotation : annotations) {
      auto statement =
          parse_statement({annotation.text, annotation.where}, sink_);
      if (statement) statements_.push_back(std::move(*statement));
    }
  }

  void declare(const Statement& statement) {
    switch (statement.kind) {
      case Statement::Kind::Input:
        return declare_input(statement);
      case Statement::Kind::Output:
        return declare_output(statement);
      case Statement::Kind::Scan:
        program_.scan = {.min_ms = statement.low, .max_ms = statement.high};
        return;
      case Statement::Kind::Property:
      case Statement::Kind::Assume:
      case Statement::Kind::Expect:
      case Statement::Kind::Ignored:
        return;
    }
  }

  CellId find(const Slice& name) {
    const PropertyName found = names_.find(name.text);
    if (found.kind == PropertyName::Kind::Cell) return found.cell;
    const bool known = found.kind != PropertyName::Kind::Unknown;
    fail("RP062", name.where,
         known ? "`" + std::string(name.text) + "` is no signal"
               : "the program has no `" + std::string(name.text) + "`" +
                     names_.suggestion(name.text));
    return {};
  }

  void declare_input(const Statement& statement) {
    const CellId id = find(statement.subject);
    if (!id.has_value()) return;
    Cell& cell = program_.cells[id];
    if (written_[id.index()]) {
      return fail("RP067", statement.subject.where,
                  "`" + cell.name + "` is no input: a rung assigns it",
                  {{cell.where, "first used here"}});
    }
    cell.role = CellRole::Input;
    cell.declared = true;
    if (statement.has_range) set_range(statement, cell);
    set_wiring(statement, id);
  }

  void set_wiring(const Statement& statement, CellId id) {
    Wiring wiring = statement.wiring;
    if (!wiring.normally_closed && !wiring.trip && !wiring.reset) return;
    const Cell& cell = program_.cells[id];
    if (cell.type != Type::Bit) {
      return fail("RP067", statement.line.where,
                  "`" + cell.name + "` is a word: only a bit is wired so");
    }
    wiring.cell = id;
    wiring.where = statement.line.where;
    set_.wirings.push_back(wiring);
  }

  void set_range(const Statement& statement, Cell& cell) {
    if (cell.type == Type::Bit) {
      return fail("RP067", statement.line.where,
                  "`" + cell.name + "` is a bit and has no range");
    }
    // Only narrower: where arithmetic wraps or is refused was decided when the
    // program was built, by the range that the cell had then.
    if (statement.low < cell.low || statement.high > cell.high) {
      return fail("RP065", statement.line.where,
                  "the range leaves " + std::to_string(cell.low) + ".." +
                      std::to_string(cell.high) + ", the range of `" +
                      cell.name + "`");
    }
    cell.low = statement.low;
    cell.high = statement.high;
    cell.initial = std::clamp(cell.initial, cell.low, cell.high);
  }

  void declare_output(const Statement& statement) {
    const CellId id = find(statement.subject);
    if (!id.has_value()) return;
    Cell& cell = program_.cells[id];
    if (!written_[id.index()]) {
      return fail("RP067", statement.subject.where,
                  "`" + cell.name + "` is no output: no rung assigns it",
                  {{cell.where, "first used here"}});
    }
    cell.role = CellRole::Output;
    cell.declared = true;
  }

  void add(const Statement& statement) {
    const bool assumption = statement.kind == Statement::Kind::Assume;
    if (!assumption && statement.kind != Statement::Kind::Property) return;
    bool good = true;
    for (const Slice& formula : statement.formulas) {
      if (formula.empty()) continue;  // the time of a pattern
      good = (assumption ? checker_.check_assumption(formula)
                         : checker_.check(formula)) &&
             good;
    }
    if (!good) return;
    if (assumption) {
      set_.assumptions.emplace_back(statement.formulas[0].text);
      return;
    }
    Property property = statement.property;
    property.text = statement.line.text;
    property.where = statement.line.where;
    property.formulas = formulas_of(statement);
    // A pattern's `begin(%1)` has rules of its own.
    for (const std::string& formula : property.formulas) {
      if (statement.templates.empty()) break;
      if (!checker_.check_made(formula, statement.line.where)) return;
    }
    if (property.form == Property::Form::Settles && !name_outputs(property)) {
      return;
    }
    name(statement, property);
    set_.properties.push_back(std::move(property));
  }

  bool name_outputs(Property& property) {
    for (const Cell& cell : program_.cells) {
      if (cell.role != CellRole::Output) continue;
      property.formulas.push_back(cell.name);
    }
    if (!property.formulas.empty()) return true;
    fail("RP067", property.where,
         "the program has no output that could settle; an `output NAME` line "
         "makes one");
    return false;
  }

  static std::vector<std::string> formulas_of(const Statement& statement) {
    std::vector<std::string> result;
    if (statement.templates.empty()) {
      for (const Slice& slice : statement.formulas) {
        result.emplace_back(slice.text);
      }
      return result;
    }
    for (const std::string& text : statement.templates) {
      std::string made;
      for (std::size_t i = 0; i < text.size(); ++i) {
        if (text[i] != '%') {
          made += text[i];
          continue;
        }
        ++i;
        made +=
            statement.formulas[static_cast<std::size_t>(text[i] - '1')].text;
      }
      result.push_back(std::move(made));
    }
    return result;
  }

  void name(const Statement& statement, Property& property) {
    if (!statement.name.empty()) {
      property.name = statement.name.text;
    } else {
      const LineColumn at =
          sources_[property.where.file].position(property.where.begin);
      property.name =
          std::string(to_string(property.form)) + "@" + std::to_string(at.line);
      // A --props file has a line of that number too.
      const std::string base = property.name;
      for (int n = 2; names_taken_.count(property.name) != 0; ++n) {
        property.name = base + "#" + std::to_string(n);
      }
    }
    take_names(property);
  }

  /// The names of all obligations of `property`; each only once.
  void take_names(const Property& property) {
    if (!take_name(property, property.name) ||
        property.form != Property::Form::Latch) {
      return;
    }
    for (const std::string_view part : kLatchParts) {
      if (!take_name(property, property.name + "." + std::string(part))) return;
    }
  }

  bool take_name(const Property& property, std::string name) {
    const auto [entry, is_new] =
        names_taken_.emplace(std::move(name), property.where);
    if (is_new) return true;
    fail("RP066", property.where,
         "a second property is called `" + entry->first + "`",
         {{entry->second, "the first one"}});
    return false;
  }

  void expect(const Statement& statement) {
    if (statement.kind != Statement::Kind::Expect) return;
    std::string name(statement.subject.text);
    if (names_taken_.count(name) == 0) {
      std::vector<std::string_view> known;
      for (const auto& [taken, where] : names_taken_) known.push_back(taken);
      std::sort(known.begin(), known.end());
      return fail(
          "RP062", statement.subject.where,
          "no property is called `" + name + "`" + did_you_mean(name, known));
    }
    set_.expectations.push_back({.obligation = std::move(name),
                                 .verdict = std::string(statement.verdict.text),
                                 .where = statement.line.where});
  }

  Program& program_;
  const SourceSet& sources_;
  DiagnosticSink& sink_;
  PropertyNames names_;
  FormulaChecker checker_;
  std::vector<bool> written_;  // by CellId: a rung assigns it
  std::vector<Statement> statements_;
  std::unordered_map<std::string, SourceRange> names_taken_;
  PropertySet set_;
};

}  // namespace

std::string_view to_string(Property::Form form) {
  switch (form) {
    case Property::Form::Always:
      return "always";
    case Property::Form::Never:
      return "never";
    case Property::Form::Interlock:
      return "interlock";
    case Property::Form::Latch:
      return "latch";
    case Property::Form::Reach:
      return "reach";
    case Property::Form::Recoverable:
      return "recoverable";
    case Property::Form::After:
      return "after";
    case Property::Form::For:
      return "for";
    case Property::Form::OnlyAfter:
      return "only-after";
    case Property::Form::Settles:
      return "settles";
    case Property::Form::Eventually:
      return "eventually";
  }
  return {};
}

PropertySet read_properties(Program& program,
                            const std::vector<AstAnnotation>& extra,
                            const SourceSet& sources, DiagnosticSink& sink) {
  return PropertyReader(program, sources, sink).read(extra);
}

}  // namespace rung
