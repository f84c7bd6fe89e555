#include "base/postfix_format.h"

#include <algorithm>

namespace rung::postfix {
namespace {

constexpr std::array<Operator, 20> kOperators = {{
    {Opcode::False, "false", 0, 0, false},
    {Opcode::True, "true", 0, 0, false},
    {Opcode::Not, "!", 1, 0, false},
    {Opcode::And, "&&", 2, 0, false},
    {Opcode::Or, "||", 2, 0, false},
    {Opcode::Xor, "^", 2, 0, false},
    {Opcode::Add, "+", 0, 2, true},
    {Opcode::Subtract, "-", 0, 2, true},
    {Opcode::Multiply, "*", 0, 2, true},
    {Opcode::Divide, "/", 0, 2, true},
    {Opcode::Negate, "neg", 0, 1, true},
    {Opcode::Wrap16, "wrap16", 0, 1, true},
    {Opcode::ToWord, "to_word", 1, 0, true},
    {Opcode::ToBit, "to_bit", 0, 1, false},
    {Opcode::Equal, "==", 0, 2, false},
    {Opcode::NotEqual, "!=", 0, 2, false},
    {Opcode::Less, "<", 0, 2, false},
    {Opcode::LessEqual, "<=", 0, 2, false},
    {Opcode::Greater, ">", 0, 2, false},
    {Opcode::GreaterEqual, ">=", 0, 2, false},
}};

using enum ElementCode::Preset;
constexpr std::array<ElementCode, 9> kElements = {{
    {0x40, 0x40, 1, Milliseconds, "T", "T", "timer-yun"},
    {0x41, 0x40, 1, None, "TR", "T", "timer-yun"},
    {0x42, 0x42, 1, Milliseconds, "T", "T", "timer-sim"},
    {0x43, 0x43, 1, Milliseconds, "TOF", "TOF", "timer-off-sim"},
    {0x48, 0x48, 1, Count, "C", "C", "counter-yun"},
    {0x49, 0x48, 1, None, "CR", "C", "counter-yun"},
    {0x4a, 0x4a, 3, Count, "C", "C", "counter-sim"},
    {0x50, 0x50, 1, None, "RISE", "E", "edge"},
    {0x51, 0x50, 1, None, "FALL", "E", "edge"},
}};

template <class Table, class Condition>
auto* find_in(const Table& table, Condition condition) {
  const auto found = std::find_if(table.begin(), table.end(), condition);
  return found == table.end() ? nullptr : &*found;
}

bool is_control(char c) {
  return static_cast<unsigned char>(c) < 0x20 || c == 0x7f;
}

bool is_name_character(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
         (c >= '0' && c <= '9') || c == '_' || c == '.' ||
         static_cast<unsigned char>(c) >= 0x80;
}

}  // namespace

std::span<const Operator> operators() { return kOperators; }

const Operator* find_operator(std::uint8_t opcode) {
  return find_in(kOperators, [&](const Operator& entry) {
    return static_cast<std::uint8_t>(entry.opcode) == opcode;
  });
}

const Operator* find_operator(std::string_view token) {
  return find_in(kOperators,
                 [&](const Operator& entry) { return entry.token == token; });
}

std::span<const ElementCode> element_codes() { return kElements; }

const ElementCode* find_element(std::uint8_t opcode) {
  return find_in(kElements, [&](const ElementCode& entry) {
    return entry.opcode == opcode;
  });
}

const ElementCode* find_kind(std::uint8_t kind) {
  return find_in(kElements,
                 [&](const ElementCode& entry) { return entry.kind == kind; });
}

const ElementCode* find_kind(std::string_view kind_id) {
  return find_in(kElements, [&](const ElementCode& entry) {
    return entry.kind_id == kind_id;
  });
}

std::uint32_t read_number(std::string_view bytes, std::size_t at, int size) {
  std::uint32_t number = 0;
  for (int i = size; i-- > 0;) {
    number = (number << 8) | static_cast<unsigned char>(
                                 bytes[at + static_cast<std::size_t>(i)]);
  }
  return number;
}

void append_number(std::string& bytes, std::uint64_t value, int size) {
  for (int byte = 0; byte < size; ++byte) {
    bytes += static_cast<char>(static_cast<unsigned char>(value >> (8 * byte)));
  }
}

std::uint32_t checksum(std::string_view file) {
  std::uint32_t crc = 0xffff'ffff;
  for (std::size_t at = 0; at < file.size(); ++at) {
    if (at >= ChecksumField && at < ChecksumField + 4U) continue;
    crc ^= static_cast<unsigned char>(file[at]);
    for (int bit = 0; bit < 8; ++bit) {
      crc = (crc & 1U) != 0 ? (crc >> 1) ^ 0xedb8'8320U : crc >> 1;
    }
  }
  return ~crc;
}

bool is_name(std::string_view name) {
  return !name.empty() && name.size() <= kMaxName &&
         std::none_of(name.begin(), name.end(),
                      [](char c) { return is_control(c) || c == '"'; });
}

bool is_plain_name(std::string_view name) {
  if (name.empty() || name[0] == '.' || (name[0] >= '0' && name[0] <= '9')) {
    return false;
  }
  return std::all_of(name.begin(), name.end(), is_name_character) &&
         find_operator(name) == nullptr;
}

void append_name(std::string& text, std::string_view name) {
  if (is_plain_name(name)) {
    text += name;
  } else {
    text += '"';
    text += name;
    text += '"';
  }
}

bool is_note(std::string_view note) {
  const auto blank = [](char c) { return c == ' ' || c == '\t'; };
  return !note.empty() && note.size() <= 0xffff && !blank(note.front()) &&
         !blank(note.back()) &&
         std::none_of(note.begin(), note.end(),
                      [&](char c) { return is_control(c) && c != '\t'; });
}

}  // namespace rung::postfix
