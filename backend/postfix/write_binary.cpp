#include <algorithm>
#include <string>

#include "backend/postfix/listing.h"
#include "backend/postfix/lower.h"

namespace rung {
namespace {

using postfix::append_number;
using postfix::ElementCode;
using postfix::Instruction;
using postfix::Opcode;

void append(std::string& bytes, Opcode opcode) {
  bytes += static_cast<char>(opcode);
}

void put(std::string& bytes, std::size_t at, std::uint64_t value, int size) {
  std::string field;
  append_number(field, value, size);
  bytes.replace(at, field.size(), field);
}

std::uint64_t as_bits(std::int64_t value) {
  return static_cast<std::uint64_t>(value);
}

// Writes the code and measures its stacks: the machine's claim is what the
// longest of both ways through a skip needs, which is the one that does not.
class CodeWriter {
 public:
  CodeWriter(const postfix::Listing& listing, DiagnosticSink& sink)
      : listing_(listing), sink_(sink) {}

  bool run() {
    for (const Instruction& instruction : listing_.code) {
      const std::size_t most = most_bits + most_words + most_open;
      write(instruction);
      if (most_bits + most_words + most_open > most) {
        deepest_ = instruction.where;
      }
    }
    append(code, Opcode::End);
    if (most_bits > 0xffff || most_words > 0xffff || most_open > 0xffff) {
      fail(deepest_, "an expression is nested more than 65535 deep");
    }
    return !failed_;
  }

  std::string code;
  std::size_t most_bits = 0;
  std::size_t most_words = 0;
  std::size_t most_open = 0;

 private:
  void fail(SourceRange where, std::string message) {
    failed_ = true;
    postfix::report_inexpressible(sink_, where, std::move(message));
  }

  void write(const Instruction& instruction) {
    using Kind = Instruction::Kind;
    switch (instruction.kind) {
      case Kind::Plain: {
        append(code, instruction.opcode);
        const postfix::Operator& entry = *postfix::find_operator(
            static_cast<std::uint8_t>(instruction.opcode));
        return take(entry.bits_in, entry.words_in, entry.word_out ? 0 : 1,
                    entry.word_out ? 1 : 0);
      }
      case Kind::Push:
        write_push(instruction.value);
        return take(0, 0, 0, 1);
      case Kind::ReadBit:
        write_addressed(Opcode::ReadBit, instruction.address);
        return take(0, 0, 1, 0);
      case Kind::ReadWord:
        write_addressed(Opcode::ReadWord, instruction.address);
        return take(0, 0, 0, 1);
      case Kind::WriteBit:
        write_addressed(Opcode::WriteBit, instruction.address);
        return take(1, 0, 0, 0);
      case Kind::WriteWord:
        write_addressed(Opcode::WriteWord, instruction.address);
        return take(0, 1, 0, 0);
      case Kind::Element:
        return write_element(instruction);
      case Kind::Skip:
        append(code, instruction.opcode);
        append_number(code, 0, 2);  // filled in where it lands
        open_.push_back(code.size());
        return take(1, 0, 0, 0);
      case Kind::Joined:
        return land(instruction);
    }
  }

  // Skips nest as the operators do, so the innermost one lands first.
  void land(const Instruction& instruction) {
    const std::size_t distance = code.size() - open_.back();
    if (distance > 0xffff) {
      fail(instruction.where, "the right operand takes " +
                                  std::to_string(distance) +
                                  " bytes: the format skips 65535 at most");
    } else {
      put(code, open_.back() - 2, distance, 2);
    }
    open_.pop_back();
  }

  void write_element(const Instruction& instruction) {
    write_addressed(static_cast<Opcode>(instruction.element->opcode),
                    instruction.address);
    if (instruction.element->preset != ElementCode::Preset::None) {
      append_number(code, as_bits(instruction.value), 4);
    }
    take(instruction.element->bits_in, 0, 1, 0);
  }

  void write_addressed(Opcode opcode, std::uint32_t address) {
    const bool wide = address > 0xff;
    if (wide) append(code, Opcode::Wide);
    append(code, opcode);
    append_number(code, address, wide ? 2 : 1);
  }

  void write_push(std::int64_t value) {
    const bool byte = value >= -0x80 && value < 0x80;
    const bool two = value >= -0x8000 && value < 0x8000;
    append(code, byte ? Opcode::Push8 : two ? Opcode::Push16 : Opcode::Push32);
    append_number(code, as_bits(value), byte ? 1 : two ? 2 : 4);
  }

  void take(std::size_t bits_in, std::size_t words_in, std::size_t bits_out,
            std::size_t words_out) {
    bits_ = bits_ - bits_in + bits_out;
    words_ = words_ - words_in + words_out;
    most_bits = std::max(most_bits, bits_);
    most_words = std::max(most_words, words_);
    most_open = std::max(most_open, open_.size());
  }

  const postfix::Listing& listing_;
  DiagnosticSink& sink_;
  std::vector<std::size_t> open_;  // where each open skip's instruction ends
  std::size_t bits_ = 0;
  std::size_t words_ = 0;
  SourceRange deepest_;  // where a stack was last deeper than before
  bool failed_ = false;
};

void append_tables(std::string& file, const Program& program,
                   const postfix::Listing& listing) {
  for (const CellId id : listing.cells) {
    const Cell& cell = program.cells[id];
    const bool set = cell.type == Type::Bit && cell.initial != 0;
    append_number(
        file,
        static_cast<unsigned>(cell.role) | (set ? postfix::kInitialBit : 0U),
        1);
  }
  for (std::size_t i = listing.bit_count; i < listing.cells.size(); ++i) {
    const Cell& cell = program.cells[listing.cells[i]];
    append_number(file, as_bits(cell.initial), 4);
    append_number(file, as_bits(cell.low), 4);
    append_number(file, as_bits(cell.high), 4);
  }
  for (const Instance& instance : program.instances) {
    append_number(file, instance.kind->operations.front().opcode, 1);
    append_number(file, as_bits(instance.index), 4);
  }
}

std::string name_section(const Program& program,
                         const postfix::Listing& listing) {
  std::string names;
  for (const CellId id : listing.cells) {
    const std::string& name = program.cells[id].name;
    append_number(names, name.size(), 1);
    names += name;
  }
  return names;
}

std::string note_section(const postfix::Listing& listing) {
  std::string notes;
  for (const std::string_view note : listing.notes) {
    append_number(notes, note.size(), 2);
    notes += note;
  }
  return notes;
}

void append_header(std::string& file, const Program& program,
                   const postfix::Listing& listing) {
  file += postfix::kMagic;
  append_number(file, postfix::kVersion, 2);
  const bool skips = program.evaluation == Evaluation::ShortCircuit;
  append_number(file, skips ? postfix::kShortCircuitFlag : 0U, 1);
  append_number(file, listing.dialect, 1);
  append_number(file, 0, 8);  // length and checksum, when they are known
  append_number(file, as_bits(program.scan.min_ms), 4);
  append_number(file, as_bits(program.scan.max_ms), 4);
  append_number(file, listing.bit_count, 2);
  append_number(file, listing.cells.size() - listing.bit_count, 2);
  append_number(file, program.instances.size(), 2);
}

}  // namespace

std::optional<std::string> lower_to_postfix_binary(const Program& program,
                                                   DiagnosticSink& sink) {
  const auto listing = postfix::make_listing(program, sink);
  if (!listing) return std::nullopt;
  CodeWriter writer(*listing, sink);
  if (!writer.run()) return std::nullopt;
  const std::string names = name_section(program, *listing);
  const std::string notes = note_section(*listing);

  std::string file;
  append_header(file, program, *listing);
  append_number(file, writer.most_bits, 2);
  append_number(file, writer.most_words, 2);
  append_number(file, writer.most_open, 2);
  append_number(file, writer.code.size(), 4);
  append_number(file, names.size(), 4);
  append_number(file, notes.size(), 4);
  append_tables(file, program, *listing);
  file += writer.code;
  file += names;
  file += notes;
  put(file, postfix::LengthField, file.size(), 4);
  put(file, postfix::ChecksumField, postfix::checksum(file), 4);
  return file;
}

}  // namespace rung
