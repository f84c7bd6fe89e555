#include <string>

#include "backend/postfix/listing.h"
#include "backend/postfix/lower.h"

namespace rung {
namespace {

using postfix::ElementCode;
using postfix::Instruction;

std::string header(const Program& program, const postfix::Listing& listing) {
  std::string text = "postfix 1\ndialect ";
  text += postfix::kDialects[listing.dialect];
  text += program.evaluation == Evaluation::Strict
              ? "\nevaluation strict\n"
              : "\nevaluation short-circuit\n";
  text += "scan " + std::to_string(program.scan.min_ms) + ".." +
          std::to_string(program.scan.max_ms) + " ms\n";
  return text;
}

void append_cell(std::string& text, const Cell& cell) {
  text += postfix::kRoles[static_cast<std::size_t>(cell.role)];
  text += cell.type == Type::Bit ? " bit " : " word ";
  postfix::append_name(text, cell.name);
  if (cell.type == Type::Word) {
    text +=
        " in " + std::to_string(cell.low) + ".." + std::to_string(cell.high);
  }
  if (cell.initial != 0) text += " = " + std::to_string(cell.initial);
  text += '\n';
}

void append_slot(std::string& text, const Instance& instance) {
  const ElementCode& kind =
      *postfix::find_kind(instance.kind->operations.front().opcode);
  text += "element ";
  text += kind.letter;
  text += '(' + std::to_string(instance.index) + ") ";
  text += kind.kind_id;
  text += '\n';
}

void append_element(std::string& text, const Program& program,
                    const Instruction& instruction) {
  text += instruction.element->name;
  text += '(' + std::to_string(
                    program.instances[InstanceId(instruction.address)].index);
  if (instruction.element->preset != ElementCode::Preset::None) {
    text += ',' + std::to_string(instruction.value);
  }
  if (instruction.element->preset == ElementCode::Preset::Milliseconds) {
    text += "ms";
  }
  text += ')';
}

void append_instruction(std::string& text, const Program& program,
                        const Instruction& instruction) {
  using Kind = Instruction::Kind;
  switch (instruction.kind) {
    case Kind::Skip:
      return;  // the evaluation says it
    case Kind::Plain:
    case Kind::Joined:
      text +=
          postfix::find_operator(static_cast<std::uint8_t>(instruction.opcode))
              ->token;
      break;
    case Kind::Push:
      text += std::to_string(instruction.value);
      break;
    case Kind::ReadBit:
    case Kind::ReadWord:
      postfix::append_name(text, program.cells[instruction.cell].name);
      break;
    case Kind::Element:
      append_element(text, program, instruction);
      break;
    case Kind::WriteBit:
    case Kind::WriteWord:
      text += '=';
      postfix::append_name(text, program.cells[instruction.cell].name);
      text += '\n';
      return;
  }
  text += ' ';
}

}  // namespace

std::optional<std::string> lower_to_postfix_text(const Program& program,
                                                 DiagnosticSink& sink) {
  const auto listing = postfix::make_listing(program, sink);
  if (!listing) return std::nullopt;
  std::string text = header(program, *listing);
  for (const CellId id : listing->cells) append_cell(text, program.cells[id]);
  for (const Instance& instance : program.instances) {
    append_slot(text, instance);
  }
  for (const std::string_view note : listing->notes) {
    text += "//@ ";
    text += note;
    text += '\n';
  }
  text += "rungs\n";
  for (const Instruction& instruction : listing->code) {
    append_instruction(text, program, instruction);
  }
  return text;
}

}  // namespace rung
