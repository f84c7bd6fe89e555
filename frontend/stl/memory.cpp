#include "frontend/stl/memory.h"

#include <charconv>

#include "frontend/token_list.h"

namespace rung::stl {
namespace {

constexpr std::uint32_t kLastByte = 65'535;
constexpr CellShape kByteCell = {true, 0, 255};
constexpr CellShape kInt32Cell = {true, -2'147'483'648, 2'147'483'647};
constexpr CellShape kPatternCell = {true, 0, 4'294'967'295};

std::optional<std::uint32_t> number_of(std::string_view digits) {
  std::uint32_t value = 0;
  const char* const end = digits.data() + digits.size();
  const auto read = std::from_chars(digits.data(), end, value);
  const bool whole = read.ec == std::errc{} && read.ptr == end;
  if (digits.empty() || !whole || value > kLastByte) return std::nullopt;
  return value;
}

std::int64_t power_of_two(std::uint32_t exponent) {
  return std::int64_t{1} << exponent;
}

CellShape shape_of(std::uint8_t size) {
  if (size == 0) return kBitCell;
  if (size == 1) return kByteCell;
  return size == 2 ? kInt16Cell : kInt32Cell;
}

AstDeclaration::Kind role_of(char area) {
  if (area == 'E') return AstDeclaration::Kind::Input;
  return area == 'A' ? AstDeclaration::Kind::Output
                     : AstDeclaration::Kind::Memory;
}

}  // namespace

std::optional<Address> address_of(std::string_view text, std::uint32_t scope) {
  Address address;
  if (text.size() < 2) return std::nullopt;
  address.letter = text[0];
  address.area = text[0] == 'I' ? 'E' : (text[0] == 'Q' ? 'A' : text[0]);
  if (std::string_view("EAML").find(address.area) == std::string_view::npos) {
    return std::nullopt;
  }
  if (address.area == 'L') address.scope = scope;
  text.remove_prefix(1);
  const std::size_t dot = text.find('.');
  if (dot == std::string_view::npos) {
    address.size = text[0] == 'B' ? 1 : (text[0] == 'W' ? 2 : 4);
    const auto byte = number_of(text.substr(1));
    const bool fits =
        std::string_view("BWD").find(text[0]) != std::string_view::npos &&
        byte && *byte + address.size <= kLastByte + 1;
    if (!fits) return std::nullopt;
    address.byte = *byte;
    return address;
  }
  const auto byte = number_of(text.substr(0, dot));
  const auto bit = number_of(text.substr(dot + 1));
  if (!byte || !bit || *bit > 7) return std::nullopt;
  address.byte = *byte;
  address.bit = static_cast<std::uint8_t>(*bit);
  return address;
}

Expression bit_constant(bool value, SourceRange where) {
  Expression nodes;
  push_leaf(nodes, AstOp::Bool, value ? "true" : "false", where);
  return nodes;
}

std::optional<bool> constant_bit(const Expression& nodes) {
  if (nodes.size() != 1 || nodes[0].op != AstOp::Bool) return std::nullopt;
  return nodes[0].text == "true";
}

void push_number(StatementWriter& writer, Expression& nodes, std::int64_t value,
                 SourceRange where) {
  push_leaf(nodes, AstOp::Number, writer.keep_text(std::to_string(value)),
            where);
}

void push_with(StatementWriter& writer, Expression& nodes, AstOp op,
               std::int64_t value, SourceRange where) {
  push_number(writer, nodes, value, where);
  push_binary(nodes, op, where);
}

void Memory::note(const Address& address) {
  letters_.try_emplace(address.area, address.letter);
  auto& area = bytes_[{address.scope, address.area}];
  if (address.size == 0) {
    area[address.byte].bits = true;
    return;
  }
  for (std::uint32_t i = 0; i < address.size; ++i) {
    Byte& byte = area[address.byte + i];
    const bool same = byte.owner == address.byte && byte.size == address.size;
    if (byte.size != 0 && !same) byte.shared = true;
    byte.owner = address.byte;
    byte.size = address.size;
  }
}

bool Memory::is_own(const Address& address) const {
  const auto& area = bytes_.at({address.scope, address.area});
  for (std::uint32_t i = 0; i < address.size; ++i) {
    const Byte& byte = area.at(address.byte + i);
    if (byte.bits || byte.shared) return false;
  }
  return true;
}

std::string_view Memory::cell(const Address& address, SourceRange where) {
  constexpr std::string_view kSizes = " BW D";
  std::string name;
  if (address.scope != 0) {
    name = "FC" + std::to_string(address.scope - 1) + ".";
  }
  name += letters_.at(address.area);
  if (address.size != 0) name += kSizes[address.size];
  name += std::to_string(address.byte);
  if (address.size == 0) name += "." + std::to_string(address.bit);
  const auto known = cells_.find(name);
  if (known != cells_.end()) return known->second;
  const std::string_view kept = writer_.keep_text(name);
  writer_.declare(kept, shape_of(address.size), role_of(address.area), where);
  cells_.emplace(std::move(name), kept);
  return kept;
}

std::string_view Memory::bit(const Address& address, SourceRange where) {
  return cell(address, where);
}

/// The bits of a byte, or the byte: 0 to 255.
void Memory::push_byte(Expression& nodes, const Address& byte,
                       SourceRange where) {
  const Byte& info = bytes_.at({byte.scope, byte.area}).at(byte.byte);
  if (!info.bits) {
    push_leaf(nodes, AstOp::Name, cell(byte, where), where);
    return;
  }
  Address bit = byte;
  bit.size = 0;
  for (bit.bit = 0; bit.bit < 8; ++bit.bit) {
    push_leaf(nodes, AstOp::Name, cell(bit, where), where);
    push_conversion(nodes, "to_word", where);
    if (bit.bit == 0) continue;
    push_with(writer_, nodes, AstOp::Multiply, power_of_two(bit.bit), where);
    push_binary(nodes, AstOp::Add, where);
  }
}

Word Memory::load(const Address& address, SourceRange where) {
  Word result;
  result.wide = address.size == 4;
  Expression value;
  if (is_own(address)) {
    push_leaf(value, AstOp::Name, cell(address, where), where);
  } else {
    Address byte = address;
    byte.size = 1;
    for (std::uint32_t i = 0; i < address.size; ++i) {
      byte.byte = address.byte + i;
      push_byte(value, byte, where);
      const std::uint32_t below = 8 * (address.size - 1U - i);
      if (below != 0) {
        push_with(writer_, value, AstOp::Multiply, power_of_two(below), where);
      }
      if (i > 0) push_binary(value, AstOp::Add, where);
    }
    if (address.size == 2) push_conversion(value, "wrap16", where);
    if (address.size == 4) {
      const std::string_view bits =
          writer_.keep("bits", kPatternCell, value, where);
      value.clear();
      push_leaf(value, AstOp::Name, bits, where);
      push_leaf(value, AstOp::Name, bits, where);
      push_with(writer_, value, AstOp::GreaterEqual, power_of_two(31), where);
      push_conversion(value, "to_word", where);
      push_with(writer_, value, AstOp::Multiply, power_of_two(32), where);
      push_binary(value, AstOp::Subtract, where);
    }
  }
  // The cell may change before the accumulator is looked at.
  const CellShape shape = address.size == 4 ? kInt32Cell : kInt16Cell;
  push_leaf(result.nodes, AstOp::Name,
            writer_.keep("accu", shape, value, where), where);
  return result;
}

Expression Memory::as_int(const Word& value, bool wide, SourceRange where) {
  Expression nodes;
  if (value.constant) {
    const std::uint32_t bits = *value.constant;
    push_number(writer_, nodes,
                wide ? std::int64_t{static_cast<std::int32_t>(bits)}
                     : std::int64_t{static_cast<std::int16_t>(bits & 0xffffU)},
                where);
    return nodes;
  }
  nodes = value.nodes;
  if (value.wide == wide) return nodes;
  if (value.wide) {
    push_conversion(nodes, "wrap16", where);
    return nodes;
  }
  // The upper half is 0: a negative word is a number from 32768 on.
  push_all(nodes, value.nodes);
  push_with(writer_, nodes, AstOp::Less, 0, where);
  push_conversion(nodes, "to_word", where);
  push_with(writer_, nodes, AstOp::Multiply, power_of_two(16), where);
  push_binary(nodes, AstOp::Add, where);
  return nodes;
}

std::string_view Memory::pattern(const Word& value, bool wide,
                                 SourceRange where) {
  Expression number = as_int(value, wide, where);
  const std::string_view kept =
      writer_.keep("value", kInt32Cell, number, where);
  Expression nodes;
  push_leaf(nodes, AstOp::Name, kept, where);
  push_leaf(nodes, AstOp::Name, kept, where);
  push_with(writer_, nodes, AstOp::Less, 0, where);
  push_conversion(nodes, "to_word", where);
  push_with(writer_, nodes, AstOp::Multiply, power_of_two(wide ? 32 : 16),
            where);
  push_binary(nodes, AstOp::Add, where);
  return writer_.keep("bits", kPatternCell, nodes, where);
}

/// `bits` bits of a number from bit `below` on.
Expression Memory::digit(std::string_view number, std::uint32_t below,
                         std::uint32_t bits, SourceRange where) {
  Expression nodes;
  push_leaf(nodes, AstOp::Name, number, where);
  if (below != 0) {
    push_with(writer_, nodes, AstOp::Divide, power_of_two(below), where);
  }
  push_leaf(nodes, AstOp::Name, number, where);
  push_with(writer_, nodes, AstOp::Divide, power_of_two(below + bits), where);
  push_with(writer_, nodes, AstOp::Multiply, power_of_two(bits), where);
  push_binary(nodes, AstOp::Subtract, where);
  return nodes;
}

void Memory::store_byte(const Address& byte, const Expression& value,
                        SourceRange where) {
  const Byte& info = bytes_.at({byte.scope, byte.area}).at(byte.byte);
  if (!info.bits) {
    writer_.assign(cell(byte, where), true, where, value, where);
    return;
  }
  const std::string_view kept = writer_.keep("byte", kByteCell, value, where);
  Address bit = byte;
  bit.size = 0;
  for (bit.bit = 0; bit.bit < 8; ++bit.bit) {
    Expression one = digit(kept, bit.bit, 1, where);
    push_conversion(one, "to_bit", where);
    writer_.assign(cell(bit, where), false, where, one, where);
  }
}

void Memory::store(const Address& address, const Word& value,
                   SourceRange where) {
  if (is_own(address) && address.size > 1) {
    writer_.assign(cell(address, where), true, where,
                   as_int(value, address.size == 4, where), where);
    return;
  }
  if (value.constant) return store_constant(address, *value.constant, where);
  const std::string_view bits = pattern(value, address.size == 4, where);
  Address byte = address;
  byte.size = 1;
  for (std::uint32_t i = 0; i < address.size; ++i) {
    byte.byte = address.byte + i;
    store_byte(byte, digit(bits, 8 * (address.size - 1U - i), 8, where), where);
  }
}

void Memory::store_constant(const Address& address, std::uint32_t value,
                            SourceRange where) {
  Address byte = address;
  byte.size = 1;
  for (std::uint32_t i = 0; i < address.size; ++i) {
    byte.byte = address.byte + i;
    const std::uint32_t bits = (value >> (8 * (address.size - 1U - i))) & 0xffU;
    if (!bytes_.at({byte.scope, byte.area}).at(byte.byte).bits) {
      Expression nodes;
      push_number(writer_, nodes, bits, where);
      writer_.assign(cell(byte, where), true, where, nodes, where);
      continue;
    }
    Address bit = byte;
    bit.size = 0;
    for (bit.bit = 0; bit.bit < 8; ++bit.bit) {
      writer_.assign(cell(bit, where), false, where,
                     bit_constant(((bits >> bit.bit) & 1U) != 0, where), where);
    }
  }
}

void Memory::begin_block(std::uint32_t scope) {
  written_.erase(written_.lower_bound({scope, 0}),
                 written_.lower_bound({scope + 1, 0}));
}

void Memory::mark_written(const Address& address, bool always) {
  if (address.area != 'L' || !always) return;
  const std::uint32_t first = address.byte * 8 + address.bit;
  const std::uint32_t count = address.size == 0 ? 1 : address.size * 8U;
  for (std::uint32_t i = 0; i < count; ++i) {
    written_.emplace(address.scope, first + i);
  }
}

void Memory::check_written(const Address& address, SourceRange where) {
  if (address.area != 'L') return;
  const std::uint32_t first = address.byte * 8 + address.bit;
  const std::uint32_t count = address.size == 0 ? 1 : address.size * 8U;
  for (std::uint32_t i = 0; i < count; ++i) {
    if (written_.contains({address.scope, first + i})) continue;
    errors_.error("RP044", where,
                  "local data is read before the block has written it: it has "
                  "no value here");
    return;
  }
}

}  // namespace rung::stl
