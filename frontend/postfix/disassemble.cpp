#include "frontend/postfix/disassemble.h"

#include <algorithm>
#include <array>
#include <optional>
#include <utility>
#include <vector>

#include "base/postfix_format.h"
#include "base/source.h"
#include "frontend/postfix/code_reader.h"

namespace rung {
namespace {

using postfix::Binary;

/// Header and tables; throws nothing, stops at the first refusal.
class TableReader {
 public:
  explicit TableReader(std::string_view bytes) { binary_.bytes = bytes; }

  bool run() {
    return read_header() && read_sections() && read_cells() && read_slots() &&
           read_names() && read_notes();
  }
  const Binary& binary() const { return binary_; }
  Disassembly refusal() && { return std::move(refusal_); }

 private:
  bool refuse(std::uint8_t code, std::size_t at, std::string reason) {
    refusal_.code = code;
    refusal_.at = static_cast<std::uint32_t>(at);
    refusal_.refusal = std::move(reason);
    return false;
  }

  std::uint32_t number(std::size_t at, int size) const {
    return postfix::read_number(binary_.bytes, at, size);
  }

  bool read_header() {
    using namespace postfix;
    const std::string_view bytes = binary_.bytes;
    if (bytes.size() < kHeaderBytes) {
      return refuse(1, 0, "the file is shorter than the header of 48 bytes");
    }
    if (!is_postfix_binary(bytes)) {
      return refuse(2, 0, "the file does not begin as a postfix binary");
    }
    if (const auto version = number(VersionField, 2); version != kVersion) {
      return refuse(
          3, VersionField,
          "the format's version is " + std::to_string(version) + ", not 1");
    }
    if (const auto length = number(LengthField, 4); length != bytes.size()) {
      return refuse(4, LengthField,
                    "the header says " + std::to_string(length) +
                        " bytes, the file has " + std::to_string(bytes.size()));
    }
    if (number(ChecksumField, 4) != checksum(bytes)) {
      return refuse(5, ChecksumField, "the checksum is wrong");
    }
    const std::uint32_t flags = number(FlagsField, 1);
    if ((flags & ~std::uint32_t{kShortCircuitFlag}) != 0) {
      return refuse(6, FlagsField, "a flag is set that version 1 lacks");
    }
    binary_.short_circuit = flags != 0;
    binary_.dialect = number(DialectField, 1);
    if (binary_.dialect >= kDialects.size()) {
      return refuse(6, DialectField, "the dialect has no name in version 1");
    }
    binary_.scan_min = number(ScanMinField, 4);
    binary_.scan_max = number(ScanMaxField, 4);
    if (binary_.scan_min > binary_.scan_max || binary_.scan_max > kMaxScanMs) {
      return refuse(6, ScanMinField, "there is no such scan interval");
    }
    return true;
  }

  bool read_sections() {
    using namespace postfix;
    binary_.bit_count = number(BitsField, 2);
    binary_.word_count = number(WordsField, 2);
    binary_.slot_count = number(SlotsField, 2);
    binary_.bit_stack = number(BitStackField, 2);
    binary_.word_stack = number(WordStackField, 2);
    binary_.branches = number(BranchesField, 2);
    const std::array<std::uint64_t, 6> sizes = {
        binary_.cell_count(),
        kRangeBytes * binary_.word_count,
        kSlotBytes * binary_.slot_count,
        number(CodeField, 4),
        number(NamesField, 4),
        number(NotesField, 4)};
    std::uint64_t at = kHeaderBytes;
    const std::uint64_t length = binary_.bytes.size();
    for (std::size_t i = 0; i < sizes.size(); ++i) {
      if (sizes[i] > length - at) {
        return refuse(7, BitsField, "a section runs past the file's end");
      }
      sections_[i] = binary_.bytes.substr(at, sizes[i]);
      begin_[i] = at;
      at += sizes[i];
    }
    if (at != length) return refuse(7, at, "bytes follow the last section");
    binary_.code_begin = begin_[3];
    binary_.code_end = begin_[4];
    return true;
  }

  bool read_cells() {
    const std::string_view attributes = sections_[0];
    for (std::size_t i = 0; i < attributes.size(); ++i) {
      const auto attribute = static_cast<unsigned char>(attributes[i]);
      const bool bit = i < binary_.bit_count;
      const unsigned role = attribute & postfix::kRoleMask;
      const unsigned rest = attribute & ~unsigned{postfix::kRoleMask};
      if (role >= postfix::kRoles.size() ||
          (rest != 0 && (!bit || rest != postfix::kInitialBit))) {
        return refuse(8, begin_[0] + i, "a cell's attributes are undefined");
      }
      binary_.cells.push_back({.role = role, .initial = rest != 0 ? 1 : 0});
    }
    for (std::size_t i = 0; i < binary_.word_count; ++i) {
      const std::size_t at = begin_[1] + postfix::kRangeBytes * i;
      postfix::BinaryCell& cell = binary_.cells[binary_.bit_count + i];
      cell.initial = postfix::read_signed(binary_.bytes, at, 4);
      cell.low = postfix::read_signed(binary_.bytes, at + 4, 4);
      cell.high = postfix::read_signed(binary_.bytes, at + 8, 4);
      if (cell.initial < cell.low || cell.initial > cell.high) {
        return refuse(8, at, "a word's initial value is outside its range");
      }
    }
    return true;
  }

  bool read_slots() {
    for (std::size_t i = 0; i < binary_.slot_count; ++i) {
      const std::size_t at = begin_[2] + postfix::kSlotBytes * i;
      const auto* kind =
          postfix::find_kind(static_cast<std::uint8_t>(number(at, 1)));
      const std::uint32_t index = number(at + 1, 4);
      if (kind == nullptr) {
        return refuse(9, at, "an element's kind is unknown");
      }
      if (index > postfix::kMaxIndex) {
        return refuse(9, at, "an element's index is above 2147483647");
      }
      binary_.slots.push_back({kind, index});
    }
    return true;
  }

  bool read_names() {
    const std::string_view names = sections_[4];
    std::size_t at = 0;
    for (postfix::BinaryCell& cell : binary_.cells) {
      if (at == names.size()) {
        return refuse(10, begin_[4] + at, "a cell has no name");
      }
      const std::size_t size = static_cast<unsigned char>(names[at]);
      cell.name = names.substr(at + 1, size);
      if (cell.name.size() != size || !postfix::is_name(cell.name)) {
        return refuse(10, begin_[4] + at,
                      "a name is empty, cut off, or holds a quote or a control "
                      "character");
      }
      at += 1 + size;
    }
    if (at == names.size()) return true;
    return refuse(10, begin_[4] + at, "there are more names than cells");
  }

  bool read_notes() {
    const std::string_view notes = sections_[5];
    std::size_t at = 0;
    while (at != notes.size()) {
      const std::size_t size =
          notes.size() - at < 2 ? 0 : number(begin_[5] + at, 2);
      const std::string_view note =
          size == 0 ? std::string_view() : notes.substr(at + 2, size);
      if (note.size() != size || !postfix::is_note(note)) {
        return refuse(11, begin_[5] + at,
                      "a property line is empty, cut off, padded, or holds a "
                      "control character");
      }
      binary_.notes.push_back(note);
      at += 2 + size;
    }
    return true;
  }

  Binary binary_;
  Disassembly refusal_;
  std::array<std::string_view, 6> sections_;
  std::array<std::size_t, 6> begin_ = {};
};

void append_cell(std::string& text, const postfix::BinaryCell& cell,
                 bool word) {
  text += postfix::kRoles[cell.role];
  text += word ? " word " : " bit ";
  postfix::append_name(text, cell.name);
  if (word) {
    text +=
        " in " + std::to_string(cell.low) + ".." + std::to_string(cell.high);
  }
  if (cell.initial != 0) text += " = " + std::to_string(cell.initial);
  text += '\n';
}

std::string text_head(const Binary& binary) {
  std::string text = "postfix 1\ndialect ";
  text += postfix::kDialects[binary.dialect];
  text += "\nevaluation ";
  text += binary.short_circuit ? "short-circuit" : "strict";
  text += "\nscan " + std::to_string(binary.scan_min) + ".." +
          std::to_string(binary.scan_max) + " ms\n";
  for (std::size_t i = 0; i < binary.cells.size(); ++i) {
    append_cell(text, binary.cells[i], i >= binary.bit_count);
  }
  for (const postfix::BinarySlot& slot : binary.slots) {
    text += "element ";
    text += slot.kind->letter;
    text += '(' + std::to_string(slot.index) + ") ";
    text += slot.kind->kind_id;
    text += '\n';
  }
  for (const std::string_view note : binary.notes) {
    text += "//@ ";
    text += note;
    text += '\n';
  }
  text += "rungs\n";
  return text;
}

}  // namespace

bool is_postfix_binary(std::string_view bytes) {
  return bytes.substr(0, postfix::kMagic.size()) == postfix::kMagic;
}

Disassembly disassemble_postfix(std::string_view bytes) {
  TableReader tables(bytes);
  if (!tables.run()) return std::move(tables).refusal();
  return postfix::read_code(tables.binary(), text_head(tables.binary()));
}

}  // namespace rung
