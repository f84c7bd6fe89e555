#include "backend/plclib/write.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "backend/plclib/bits.h"
#include "backend/plclib/elements.h"
#include "backend/plclib/loop.h"
#include "backend/plclib/names.h"
#include "backend/plclib/wiring.h"
#include "backend/unit/bounds.h"
#include "backend/unit/builder.h"
#include "backend/unit/comments.h"
#include "backend/unit/iec_text.h"

namespace rung {
namespace backend {
namespace {

// What the reader of sketches takes.
constexpr std::size_t kMostStatements = 19'000;
constexpr std::size_t kDeepest = 80;

/// What the board has no pin for: words but inputs of 10 bits.
bool check_words(const Program& program, DiagnosticSink& sink) {
  bool good = true;
  for (const Cell& cell : program.cells) {
    const bool input = cell.role == CellRole::Input;
    if (cell.type == Type::Bit || cell.role == CellRole::Memory) continue;
    if (input && cell.low >= 0 && cell.high <= 1'023) continue;
    good = false;
    sink.report({.code = "RP084",
                 .severity = Severity::Error,
                 .where = cell.where.has_value()
                              ? cell.where
                              : SourceRange{program.file, 0, 0},
                 .message = "`" + cell.name + "`" +
                            (input ? " may be outside of 0..1023, what an "
                                     "analogue pin gives: `//@ input " +
                                         cell.name +
                                         " in 0..1023` says that "
                                         "it is not"
                                   : " is a word: an output pin of the "
                                     "controller has no number")});
  }
  return good;
}

/// The sum of two `long` that is none has no value in C++.
bool check_overflow(const Program& program, DiagnosticSink& sink) {
  const WordBounds bounds = find_bounds(program);
  bool good = true;
  for (const Rung& rung : program.rungs) {
    for (std::uint32_t at = rung.begin; at < rung.end; ++at) {
      if (!bounds.overflows[at]) continue;
      good = false;
      sink.report({.code = "RP084",
                   .severity = Severity::Error,
                   .where = program.nodes[at].where.has_value()
                                ? program.nodes[at].where
                                : rung.where,
                   .message = "this may leave the 32 bits of a `long`"});
    }
  }
  return good;
}

/// The reader of sketches makes use of bits that never change; which these are
/// is for the proof to see.
void relate_constants(Unit& unit, const Program& program) {
  for (const Cell& cell : program.cells) {
    if (cell.type == Type::Word || cell.role == CellRole::Input) continue;
    unit.relations.push_back(
        {cell.initial != 0 ? "c" : "!c", {{"c", cell.name}}});
  }
}

/// Pins of timers have names of their own; those that nothing reads have none.
void name_pins(Unit& unit) {
  for (const CellId id : ids_of(unit.variables)) {
    Variable& variable = unit.variables[id];
    if (variable.block.has_value() && variable.pin == "Q") {
      variable.name =
          unit.names.add(unit.blocks[variable.block].name + "_done");
    }
  }
}

class SketchWriter {
 public:
  SketchWriter(const Unit& unit, const Wiring& wiring, LoopText loop)
      : unit_(unit), wiring_(wiring), loop_(std::move(loop)) {
    for (const CellRole role : {CellRole::Input, CellRole::Output}) {
      for (const CellId id : ids_of(unit.variables)) {
        if (is_pin(id) && unit.variables[id].role == role) pins_.push_back(id);
      }
    }
  }

  std::string run(const PropertyLines& properties) {
    text_ = "#define noPinDefs\n#include <plcLib.h>\n\n";
    for (const std::string& line : properties.lines) {
      text_ += "//@ " + line + '\n';
    }
    for (const std::string& line : properties.comments) {
      text_ += line_comment("of the source: " + line) + '\n';
    }
    const std::string pins = declared_pins();
    if (!pins.empty()) {
      text_ += "// Pins of an Arduino ";
      text_ += wiring_.mega ? "Mega" : "Uno";
      text_ += " or the like: put yours here.\n" + pins + '\n';
    }
    const std::string variables = declared_variables();
    if (!variables.empty()) text_ += variables + '\n';
    return text_ + setup() + "\nvoid loop() {\n" + loop_.text + "}\n";
  }

 private:
  bool is_pin(CellId id) const {
    return id.index() < wiring_.pins.size() &&
           !wiring_.pins[id.index()].empty();
  }

  static std::string with_source(std::string declaration,
                                 const std::string& name,
                                 const std::string& source) {
    const bool renamed = !source.empty() && source != name;
    if (renamed) declaration += "  " + line_comment(source);
    return declaration + '\n';
  }

  std::string declared_pins() const {
    std::string text;
    for (const CellId id : pins_) {
      const Variable& variable = unit_.variables[id];
      text += with_source(
          "const int " + variable.name + " = " + wiring_.pins[id.index()] + ";",
          variable.name, variable.source);
    }
    return text;
  }

  std::string declared_variables() const {
    std::string text;
    for (const CellId id : ids_of(unit_.variables)) {
      const Variable& variable = unit_.variables[id];
      // A memory cell of the source may have a property.
      const bool needed =
          loop_.declared[id.index()] ||
          (!variable.source.empty() && variable.role == CellRole::Memory);
      if (is_pin(id) || !needed || variable.role != CellRole::Memory) continue;
      text += with_source(
          (variable.type == Type::Word ? "long " : "unsigned int ") +
              variable.name + " = " + std::to_string(variable.initial) + ";",
          variable.name, variable.source);
    }
    std::vector<bool> called(unit_.blocks.size(), false);
    for (const Statement& item : unit_.statements) {
      if (item.block.has_value()) called[item.block.index()] = true;
    }
    for (const BlockId id : ids_of(unit_.blocks)) {
      if (!called[id.index()]) continue;
      const Block& block = unit_.blocks[id];
      text += with_source("unsigned long " + block.name + " = 0;", block.name,
                          block.source);
    }
    if (!loop_.stack.empty()) text += "Stack " + loop_.stack + ";\n";
    return text;
  }

  std::string setup() const {
    std::string text = "void setup() {\n";
    for (const CellId id : pins_) {
      const Variable& variable = unit_.variables[id];
      const bool output = variable.role == CellRole::Output;
      text += "  pinMode(" + variable.name +
              (output ? ", OUTPUT);\n" : ", INPUT);\n");
      if (output && variable.initial != 0) {
        text += "  digitalWrite(" + variable.name + ", HIGH);\n";
      }
    }
    return text + "}\n";
  }

  const Unit& unit_;
  const Wiring& wiring_;
  LoopText loop_;
  std::vector<CellId> pins_;  // inputs first
  std::string text_;
};

/// Why the unit cannot be a sketch that is read again; empty: it can.
std::string limit_of(const Unit& unit) {
  for (const Statement& item : unit.statements) {
    if (std::max(depth_of(item.guard), depth_of(item.value)) > kDeepest) {
      return "an expression is nested more than " + std::to_string(kDeepest) +
             " deep";
    }
  }
  return {};
}

}  // namespace
}  // namespace backend

std::optional<backend::Written> lower_to_plclib(const Program& program,
                                                const SourceSet& sources,
                                                DiagnosticSink& sink) {
  const backend::Profile profile = {
      .name = "sketches", .names = &backend::plclib_names(), .wraps = false};
  const auto elements = backend::plclib_elements();
  const bool words = backend::check_words(program, sink);
  const bool sums = backend::check_overflow(program, sink);
  std::optional<backend::Unit> unit =
      backend::UnitBuilder(program, profile, sink).build(*elements, "sketch");
  if (!unit || !words || !sums) return std::nullopt;
  backend::relate_constants(*unit, program);
  backend::name_pins(*unit);
  const std::string stack = unit->names.add("stack");
  const backend::Wiring wiring = backend::wire(*unit);
  std::string error = wiring.error;
  if (error.empty()) error = backend::settle_words(*unit, wiring);
  if (error.empty()) error = backend::limit_of(*unit);
  backend::LoopText loop;
  if (error.empty()) {
    loop = backend::write_loop(
        *unit, wiring, backend::place_comments(program, sources), stack);
    if (loop.statements > backend::kMostStatements) {
      error = std::to_string(loop.statements) +
              " statements: a sketch has up to " +
              std::to_string(backend::kMostStatements);
    }
  }
  if (!error.empty()) {
    sink.report({.code = "RP084",
                 .severity = Severity::Error,
                 .where = {program.file, 0, 0},
                 .message = error});
    return std::nullopt;
  }
  backend::Written written = backend::finish_written(*unit, {});
  written.text = backend::SketchWriter(*unit, wiring, std::move(loop))
                     .run(backend::carry_properties(program, written.signals));
  return written;
}

}  // namespace rung
