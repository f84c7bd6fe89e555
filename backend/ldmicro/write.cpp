#include "backend/ldmicro/write.h"

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "backend/ldmicro/names.h"
#include "backend/ldmicro/rungs.h"
#include "backend/unit/builder.h"
#include "backend/unit/comments.h"
#include "backend/unit/elements_ladder.h"
#include "backend/unit/iec_text.h"

namespace rung {
namespace backend {
namespace {

/// Where the source leaves open how long a scan takes; in ms.
constexpr std::int64_t kUsualScan = 10;
constexpr std::int64_t kLongestScan = 1'000'000;
/// A timer's count is a number of 16 bits.
constexpr std::int64_t kMostScans = 32'767;
/// Of the tool: rungs, and letters of a comment that stay below its own line.
constexpr std::size_t kMostRungs = 9999;
constexpr std::size_t kLongestComment = 300;

using ldmicro::Rungs;

class LdmicroWriter {
 public:
  LdmicroWriter(const Unit& unit, const Rungs& rungs,
                const RungComments& comments)
      : unit_(unit), rungs_(rungs), comments_(comments) {}

  std::string run(std::int64_t cycle, const PropertyLines& properties) {
    text_ = "LDmicro0.2\nCYCLE=" + std::to_string(cycle * 1000) +
            " us at Timer1, YPlcCycleDuty:0\n\n";
    variables();
    text_ += "PROGRAM\n";
    notes(properties);
    for (const ldmicro::Rung& rung : rungs_.rungs) {
      if (rung.source.has_value()) open_rung(rung.source.index());
      write(rung);
    }
    open_rung(static_cast<std::uint32_t>(comments_.before.size()));
    for (const std::string& line : comments_.at_end) comment(line);
    return std::move(text_);
  }

  std::size_t count() const { return count_; }

 private:
  void variables() {
    std::string numbers;
    std::string pins;
    for (const Variable& variable : unit_.variables) {
      if (variable.type == Type::Word) {
        numbers += "    2 bytes " + variable.name + '\n';
      } else if (variable.role != CellRole::Memory) {
        pins += "    " + variable.name + " at 0\n";
      }
    }
    if (!numbers.empty()) text_ += "VAR LIST\n" + numbers + "END\n\n";
    if (!pins.empty()) text_ += "IO LIST\n" + pins + "END\n\n";
  }

  // --- comments --------------------------------------------------------------

  void notes(const PropertyLines& properties) {
    for (const std::string& line : properties.lines) {
      if (line.starts_with("scan")) continue;  // CYCLE says it
      rung({"COMMENT @ " + line});
    }
    for (const std::string& line : properties.comments) {
      comment("of the source: " + line);
    }
    for (const Variable& variable : unit_.variables) {
      // Where more was changed than the first letter.
      if (variable.source.empty() || variable.name.ends_with(variable.source)) {
        continue;
      }
      comment(variable.name + " is " + variable.source);
    }
    for (const Block& block : unit_.blocks) {
      if (block.name.ends_with(block.source)) continue;
      comment(block.name + " is " + block.source);
    }
  }

  /// As it is, but for what would be a property line, or two lines.
  void comment(std::string line) {
    if (line.starts_with("@") || line.starts_with("//@")) line.insert(0, "- ");
    for (std::size_t at; (at = line.find("\\r\\n")) != std::string::npos;) {
      line.replace(at, 4, "\\r \\n");
    }
    for (std::size_t at = 0; at < line.size(); at += kLongestComment) {
      std::string part = line.substr(at, kLongestComment);
      if (part.starts_with("@") || part.starts_with("//@")) {
        part.insert(0, "- ");
      }
      rung({"COMMENT " + part});
    }
  }

  void open_rung(std::uint32_t rung) {
    for (; next_rung_ <= rung && next_rung_ < comments_.before.size();
         ++next_rung_) {
      for (const std::string& each : comments_.before[next_rung_]) {
        comment(each);
      }
    }
  }

  // --- rungs -----------------------------------------------------------------

  void rung(const std::vector<std::string>& lines) {
    ++count_;
    text_ += "RUNG\n";
    for (const std::string& line : lines) text_ += "    " + line + '\n';
    text_ += "END\n";
  }

  void write(const ldmicro::Rung& it) {
    std::vector<std::string> lines = power(it.power);
    lines.insert(lines.end(), it.outputs.begin(), it.outputs.end());
    rung(lines);
  }

  std::string contact(const Circuit& circuit) const {
    const auto found = rungs_.comparisons.find(circuit.cell);
    if (found != rungs_.comparisons.end()) {
      return circuit.negated ? found->second.closed : found->second.open;
    }
    return "CONTACTS " + unit_.variables[circuit.cell].name +
           (circuit.negated ? " 1" : " 0");
  }

  std::vector<std::string> power(const Network& network) const {
    struct Todo {
      std::uint32_t part = 0;
      std::size_t depth = 0;
      bool end = false;
    };
    std::vector<std::string> lines;
    const auto line = [&](std::size_t depth, const std::string& text) {
      // Lines stay short however deep they stand.
      constexpr std::size_t kDeepest = 16;
      lines.push_back(std::string(std::min(depth, kDeepest) * 4, ' ') + text);
    };
    std::vector<Todo> todo = {{}};
    while (!todo.empty()) {
      const Todo next = todo.back();
      todo.pop_back();
      const Circuit& circuit = network[next.part];
      if (next.end) {
        line(next.depth, "END");
      } else if (circuit.kind == Circuit::Kind::Constant) {
        if (!circuit.value) line(0, "OPEN");
      } else if (circuit.kind == Circuit::Kind::Contact) {
        line(next.depth, contact(circuit));
      } else {
        const bool series = circuit.kind == Circuit::Kind::Series;
        // The rung itself is one.
        const bool bare = series && next.part == 0;
        if (!bare) {
          line(next.depth, series ? "SERIES" : "PARALLEL");
          todo.push_back({next.part, next.depth, true});
        }
        for (auto it = circuit.parts.rbegin(); it != circuit.parts.rend();
             ++it) {
          todo.push_back({*it, next.depth + (bare ? 0 : 1), false});
        }
      }
    }
    return lines;
  }

  const Unit& unit_;
  const Rungs& rungs_;
  const RungComments& comments_;
  std::string text_;
  std::size_t next_rung_ = 0;
  std::size_t count_ = 0;
};

bool is_fixed(const Program& program) {
  return program.scan.min_ms == program.scan.max_ms;
}

std::int64_t cycle_of(const Program& program) {
  return std::clamp<std::int64_t>(kUsualScan, program.scan.min_ms,
                                  program.scan.max_ms);
}

/// Timers count scans, and the file says how long one takes.
std::string refuse_delay(const Program& program, std::int64_t milliseconds) {
  if (!is_fixed(program)) {
    return "a delay: LDmicro counts scans of a fixed time, and those of this "
           "program are not fixed; say `//@ scan 10 ms`, or --scan 10..10";
  }
  const std::int64_t cycle = cycle_of(program);
  if ((milliseconds + cycle - 1) / cycle <= kMostScans) return {};
  return "a delay of " + std::to_string(milliseconds) + " ms: more than " +
         std::to_string(kMostScans) + " scans of " + std::to_string(cycle) +
         " ms";
}

/// A delay that is no whole number of scans: the clock of the source passes it
/// within one, and is a multiple of scans until then.
void relate_delays(Unit& unit, std::int64_t cycle) {
  constexpr std::int64_t kMost = 1000;  // multiples that are listed
  for (const Statement& statement : unit.statements) {
    if (!statement.preset || unit.blocks[statement.block].type == "CTU") {
      continue;
    }
    const std::int64_t delay = *statement.preset;
    if (delay % cycle == 0 || delay / cycle > kMost) continue;
    const std::string elapsed =
        unit.blocks[statement.block].source + ".elapsed";
    const StateRelation::Name source = {"e", elapsed};
    std::string multiples = "e >= " + std::to_string(delay);
    for (std::int64_t at = 0; at < delay; at += cycle) {
      multiples += " || e == " + std::to_string(at);
    }
    unit.relations.push_back({std::move(multiples), {source}});
    const std::int64_t end = (delay / cycle + 1) * cycle;
    unit.relations.push_back({"e < " + std::to_string(delay) +
                                  " ? e == f : f >= " + std::to_string(end),
                              {source, {"f", elapsed, true}}});
  }
}

/// Numbers are inside of the program: pins are bits.
bool check_pins(const Program& program, DiagnosticSink& sink) {
  bool good = true;
  const auto fail = [&](SourceRange where, std::string message) {
    if (!where.has_value()) where = {program.file, 0, 0};
    good = false;
    sink.report({.code = "RP084",
                 .severity = Severity::Error,
                 .where = where,
                 .message = std::move(message)});
  };
  for (const Cell& cell : program.cells) {
    if (cell.role == CellRole::Memory) continue;
    if (cell.type == Type::Word) {
      fail(cell.where, "`" + cell.name +
                           "` is a word: inputs and outputs of LDmicro are "
                           "bits");
    } else if (cell.made && cell.role == CellRole::Input) {
      fail(cell.where,
           "`" + cell.name + "` is another look at an input within one scan");
    }
  }
  if (cycle_of(program) > kLongestScan) {
    fail({}, "a scan takes more than 1000 s");
  }
  return good;
}

}  // namespace
}  // namespace backend

std::optional<backend::Written> lower_to_ldmicro(const Program& program,
                                                 const SourceSet& sources,
                                                 DiagnosticSink& sink) {
  const backend::Profile profile = {.name = "LDmicro's ladders",
                                    .names = &backend::ldmicro::name_rules(),
                                    .ladder = true};
  const auto elements = backend::ladder_elements(
      {.off_delay = true,
       .counters = true,
       .resets = true,
       .one_call = true,
       .refuse =
           [&](std::int64_t preset) {
             return backend::refuse_delay(program, preset);
           }},
      profile.name);
  const bool pins = backend::check_pins(program, sink);
  std::optional<backend::Unit> unit =
      backend::UnitBuilder(program, profile, sink).build(*elements, "");
  if (!unit || !pins) return std::nullopt;
  backend::ldmicro::assign_names(*unit);
  const std::int64_t cycle = backend::cycle_of(program);
  backend::relate_delays(*unit, cycle);
  const backend::ldmicro::Rungs rungs =
      backend::ldmicro::make_rungs(*unit, cycle);
  backend::Written written = backend::finish_written(*unit, {});
  const backend::RungComments comments =
      backend::place_comments(program, sources);
  backend::LdmicroWriter writer(*unit, rungs, comments);
  written.text =
      writer.run(cycle, backend::carry_properties(program, written.signals));
  if (writer.count() > backend::kMostRungs) {
    sink.report({.code = "RP084",
                 .severity = Severity::Error,
                 .where = {program.file, 0, 0},
                 .message = "more than 9999 rungs: there are no more"});
    return std::nullopt;
  }
  return written;
}

}  // namespace rung
