#include "backend/il_mitsubishi/write.h"

#include <string>
#include <string_view>
#include <vector>

#include "backend/il_mitsubishi/devices.h"
#include "backend/unit/builder.h"
#include "backend/unit/comments.h"
#include "backend/unit/elements_ladder.h"
#include "backend/unit/iec_text.h"
#include "backend/unit/network.h"

namespace rung {
namespace backend {
namespace {

std::string refuse_preset(std::int64_t milliseconds) {
  const bool whole = milliseconds % timer_base(milliseconds) == 0 &&
                     milliseconds / timer_base(milliseconds) <= 32'767;
  if (whole) return {};
  return "a delay of " + std::to_string(milliseconds) +
         " ms: timers of the controller count 100 ms or 10 ms, up to 32767 "
         "times";
}

/// Cells that begin with true are so from the first scan on. `first.1` is what
/// the reader of lists makes for M8002.
void relate_first_values(Unit& unit) {
  const StateRelation::Name first = {"f", "first.1", true};
  for (const Variable& variable : unit.variables) {
    if (variable.initial == 0 || variable.source.empty()) continue;
    const StateRelation::Name cell = {"c", variable.source};
    unit.relations.push_back({"!f || c", {first, cell}});
    unit.relations.push_back(
        {"f || (c <-> d)", {first, cell, {"d", variable.name, true}}});
  }
}

class MitsubishiWriter {
 public:
  MitsubishiWriter(const Unit& unit, const RungComments& comments)
      : unit_(unit), comments_(comments) {}

  std::string run(const PropertyLines& properties) {
    for (const Variable& variable : unit_.variables) {
      const bool renamed =
          !variable.source.empty() && variable.source != variable.name;
      if (renamed) comment(variable.name + " is " + variable.source);
    }
    for (const Block& block : unit_.blocks) {
      comment(block.name + " is " + block.source);
    }
    for (const std::string& line : properties.lines) {
      text_ += ";@ " + line + '\n';
    }
    for (const std::string& line : properties.comments) {
      comment("of the source: " + line);
    }
    first_values();
    never_written();
    for (const Statement& item : unit_.statements) {
      open_rung(item.rung.index());
      statement(item);
    }
    open_rung(static_cast<std::uint32_t>(comments_.before.size()));
    for (const std::string& line : comments_.at_end) comment(line);
    return std::move(text_) + "END\n";
  }

 private:
  void comment(const std::string& line) { text_ += "; " + line + '\n'; }

  void line(std::string_view code, std::string_view operand = {}) {
    text_ += code;
    if (!operand.empty()) {
      text_.append(5 - code.size(), ' ');
      text_ += operand;
    }
    text_ += '\n';
  }

  void open_rung(std::uint32_t rung) {
    for (; next_rung_ <= rung && next_rung_ < comments_.before.size();
         ++next_rung_) {
      for (const std::string& each : comments_.before[next_rung_]) {
        comment(each);
      }
    }
  }

  // M8002 is on in the first scan.
  void first_values() {
    bool any = false;
    for (const Variable& variable : unit_.variables) {
      if (variable.initial == 0) continue;
      if (!any) line("LD", "M8002");
      any = true;
      line("SET", variable.name);
    }
  }

  // Else the list might not name it at all.
  void never_written() {
    std::vector<bool> written(unit_.variables.size(), false);
    for (const Statement& item : unit_.statements) {
      if (item.target.has_value()) written[item.target.index()] = true;
    }
    for (const CellId id : ids_of(unit_.variables)) {
      const Variable& variable = unit_.variables[id];
      if (variable.role != CellRole::Output || written[id.index()] ||
          variable.initial != 0) {
        continue;
      }
      line("LD", "M8001");
      line("OUT", variable.name);
    }
  }

  void statement(const Statement& item) {
    if (item.target.has_value()) {
      load(network_of(item.value));
      return line("OUT", unit_.variables[item.target].name);
    }
    load(network_of(item.arguments[0].value));
    line("OUT", unit_.blocks[item.block].name + " K" +
                    std::to_string(*item.preset / timer_base(*item.preset)));
  }

  struct Todo {
    std::uint32_t at = 0;
    std::string_view code;  // "ANB": an instruction alone
  };

  /// A block of its own: begins with LD.
  void load(const Network& network) {
    std::vector<Todo> todo = {{0, {}}};
    while (!todo.empty()) {
      const Todo next = todo.back();
      todo.pop_back();
      if (next.code == "ANB" || next.code == "ORB") {
        line(next.code);
        continue;
      }
      const Circuit& circuit = network[next.at];
      const std::string code(next.code.empty() ? "LD" : next.code);
      if (circuit.kind == Circuit::Kind::Constant) {
        line("LD", circuit.value ? "M8000" : "M8001");
      } else if (circuit.kind == Circuit::Kind::Contact) {
        line(circuit.negated ? code + "I" : code,
             unit_.variables[circuit.cell].name);
      } else {
        join(network, circuit, todo);
      }
    }
  }

  static void join(const Network& network, const Circuit& circuit,
                   std::vector<Todo>& todo) {
    const bool series = circuit.kind == Circuit::Kind::Series;
    for (std::size_t i = circuit.parts.size(); i-- > 0;) {
      const std::uint32_t part = circuit.parts[i];
      if (i == 0) {
        todo.push_back({part, {}});
      } else if (network[part].kind == Circuit::Kind::Contact) {
        // ANI and ORI, AND and OR.
        todo.push_back({part, network[part].negated ? (series ? "AN" : "OR")
                                                    : (series ? "AND" : "OR")});
      } else {
        todo.push_back({0, series ? "ANB" : "ORB"});
        todo.push_back({part, {}});
      }
    }
  }

  const Unit& unit_;
  const RungComments& comments_;
  std::string text_;
  std::size_t next_rung_ = 0;
};

}  // namespace
}  // namespace backend

std::optional<backend::Written> lower_to_il_mitsubishi(const Program& program,
                                                       const SourceSet& sources,
                                                       DiagnosticSink& sink) {
  static constexpr backend::NameRules kNames = {.plain_underscores = true};
  const backend::Profile profile = {.name = "lists of the FX family",
                                    .names = &kNames,
                                    .conditions = false,
                                    .words = false,
                                    .ladder = true};
  const auto elements = backend::ladder_elements(
      {.refuse = backend::refuse_preset}, profile.name);
  std::optional<backend::Unit> unit =
      backend::UnitBuilder(program, profile, sink).build(*elements, "");
  if (!unit) return std::nullopt;
  const std::string why = backend::assign_devices(*unit);
  if (!why.empty()) {
    sink.report({.code = "RP084",
                 .severity = Severity::Error,
                 .where = {program.file, 0, 0},
                 .message = why});
    return std::nullopt;
  }
  backend::relate_first_values(*unit);
  backend::Written written = backend::finish_written(*unit, {});
  const backend::RungComments comments =
      backend::place_comments(program, sources);
  written.text = backend::MitsubishiWriter(*unit, comments)
                     .run(backend::carry_properties(program, written.signals));
  return written;
}

}  // namespace rung
