#include "backend/ascii/write.h"

#include <string>
#include <vector>

#include "backend/ascii/canvas.h"
#include "backend/unit/builder.h"
#include "backend/unit/comments.h"
#include "backend/unit/elements_ladder.h"
#include "backend/unit/iec_text.h"
#include "backend/unit/network.h"

namespace rung {
namespace backend {
namespace {

std::string refuse_preset(std::int64_t milliseconds) {
  if (milliseconds <= 2'147'483'647) return {};
  return "the preset " + std::to_string(milliseconds) +
         " ms does not fit a TIME: 24 days";
}

/// A plain name that a coil writes is an output: what the program made itself
/// has an address in the memory.
void name_memory(Unit& unit) {
  std::uint32_t next = 0;
  for (const CellId id : ids_of(unit.variables)) {
    Variable& variable = unit.variables[id];
    const bool made = variable.source.empty() ||
                      variable.source.find('.') != std::string::npos;
    if (!made) continue;
    const std::string name = "%MX" + std::to_string(next++);
    for (StateRelation& relation : unit.relations) {
      for (StateRelation::Name& of : relation.names) {
        if (of.second && of.state == variable.name) of.state = name;
      }
    }
    variable.name = name;
  }
}

class AsciiWriter {
 public:
  AsciiWriter(const Unit& unit, const RungComments& comments)
      : unit_(unit), comments_(comments) {}

  std::string run(const PropertyLines& properties) {
    for (const Variable& variable : unit_.variables) {
      const bool renamed =
          !variable.source.empty() && variable.source != variable.name;
      if (renamed) comment(variable.name + " is " + variable.source);
    }
    for (const std::string& line : properties.lines) {
      text_ += "//@ " + line + '\n';
    }
    for (const std::string& line : properties.comments) {
      comment("of the source: " + line);
    }
    never_written();
    for (const Statement& item : unit_.statements) {
      text_ += '\n';
      open_rung(item.rung.index());
      statement(item);
    }
    open_rung(static_cast<std::uint32_t>(comments_.before.size()));
    for (const std::string& line : comments_.at_end) comment(line);
    return std::move(text_);
  }

 private:
  void comment(const std::string& line) { text_ += iec_comment(line) + '\n'; }

  void open_rung(std::uint32_t rung) {
    for (; next_rung_ <= rung && next_rung_ < comments_.before.size();
         ++next_rung_) {
      for (const std::string& each : comments_.before[next_rung_]) {
        comment(each);
      }
    }
  }

  // Else it were an input.
  void never_written() {
    std::vector<bool> written(unit_.variables.size(), false);
    for (const Statement& item : unit_.statements) {
      if (item.target.has_value()) written[item.target.index()] = true;
    }
    for (const CellId id : ids_of(unit_.variables)) {
      const Variable& variable = unit_.variables[id];
      if (variable.role == CellRole::Input || written[id.index()] ||
          variable.block.has_value()) {
        continue;
      }
      text_ += '\n' + draw_rung({{.kind = Circuit::Kind::Constant}}, unit_,
                                variable.name);
    }
  }

  void statement(const Statement& item) {
    if (item.target.has_value()) {
      text_ += draw_rung(network_of(item.value), unit_,
                         unit_.variables[item.target].name);
      return;
    }
    const Network input = network_of(item.arguments[0].value);
    const std::string preset = *item.preset % 1000 == 0
                                   ? std::to_string(*item.preset / 1000) + "s"
                                   : std::to_string(*item.preset) + "ms";
    for (const CellId id : ids_of(unit_.variables)) {
      const Variable& variable = unit_.variables[id];
      if (variable.block != item.block || variable.pin != "Q") continue;
      text_ += draw_timer(input[0], unit_, unit_.blocks[item.block], preset,
                          variable.name);
    }
  }

  const Unit& unit_;
  const RungComments& comments_;
  std::string text_;
  std::size_t next_rung_ = 0;
};

}  // namespace
}  // namespace backend

std::optional<backend::Written> lower_to_ascii(const Program& program,
                                               const SourceSet& sources,
                                               DiagnosticSink& sink) {
  const backend::Profile profile = {.name = "drawn ladders",
                                    .names = &backend::iec_names(),
                                    .conditions = false,
                                    .first_values = false,
                                    .words = false,
                                    .ladder = true};
  const auto elements =
      backend::ladder_elements({.off_delay = true,
                                .pulse = true,
                                .plain_input = true,
                                .one_call = true,
                                .refuse = backend::refuse_preset},
                               profile.name);
  std::optional<backend::Unit> unit =
      backend::UnitBuilder(program, profile, sink).build(*elements, "");
  if (!unit) return std::nullopt;
  backend::name_memory(*unit);
  backend::Written written = backend::finish_written(*unit, {});
  const backend::RungComments comments =
      backend::place_comments(program, sources);
  written.text = backend::AsciiWriter(*unit, comments)
                     .run(backend::carry_properties(program, written.signals));
  return written;
}

}  // namespace rung
