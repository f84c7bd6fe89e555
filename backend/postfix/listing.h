#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "analysis/program.h"
#include "base/postfix_format.h"

namespace rung::postfix {

/// One step of the machine, before it is spelled as text or as bytes.
struct Instruction {
  enum class Kind : std::uint8_t {
    Plain,     // opcode
    Push,      // value
    ReadBit,   // cell
    ReadWord,  // cell
    Element,   // element, slot, value: its preset
    Skip,      // opcode; joins at the And or Or at `target`
    Joined,    // opcode, And or Or: in a text a token, in a binary no byte
    WriteBit,  // cell; ends the rung
    WriteWord  // cell; ends the rung
  };
  Kind kind = Kind::Plain;
  Opcode opcode = Opcode::End;
  const ElementCode* element = nullptr;
  CellId cell;
  std::uint32_t address = 0;  // of the cell among its type, or of the slot
  std::uint32_t target = 0;   // index in Listing::code
  std::int64_t value = 0;
  SourceRange where;
};

/// A program in the format's terms: everything in it can be expressed.
struct Listing {
  std::size_t dialect = 0;    // index in kDialects
  std::vector<CellId> cells;  // bits, then words
  std::uint16_t bit_count = 0;
  std::vector<std::string_view> notes;
  std::vector<Instruction> code;
};

std::optional<Listing> make_listing(const Program& program,
                                    DiagnosticSink& sink);

/// The code alone. `address` gives each cell's number among its type.
bool list_code(const Program& program,
               const std::vector<std::uint32_t>& address, DiagnosticSink& sink,
               std::vector<Instruction>& code);

void report_inexpressible(DiagnosticSink& sink, SourceRange where,
                          std::string message);

}  // namespace rung::postfix
