#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "base/postfix_format.h"
#include "frontend/postfix/disassemble.h"

namespace rung::postfix {

struct BinaryCell {
  unsigned role = 0;
  std::int64_t initial = 0;
  std::int64_t low = 0;
  std::int64_t high = 1;
  std::string_view name;
};

struct BinarySlot {
  const ElementCode* kind = nullptr;
  std::uint32_t index = 0;
};

/// A binary whose header and tables are verified; its code is not.
struct Binary {
  std::string_view bytes;
  bool short_circuit = false;
  std::uint32_t dialect = 0;
  std::uint32_t scan_min = 0;
  std::uint32_t scan_max = 0;
  std::uint32_t bit_count = 0;
  std::uint32_t word_count = 0;
  std::uint32_t slot_count = 0;
  std::uint32_t bit_stack = 0;
  std::uint32_t word_stack = 0;
  std::uint32_t branches = 0;
  std::size_t code_begin = 0;
  std::size_t code_end = 0;
  std::vector<BinaryCell> cells;  // bits, then words
  std::vector<BinarySlot> slots;
  std::vector<std::string_view> notes;
  std::size_t cell_count() const { return std::size_t{bit_count} + word_count; }
};

/// A number with a sign, as postfix::read_number reads one without.
std::int64_t read_signed(std::string_view bytes, std::size_t at, int size);

/// Verifies the code and appends it to `text`, one rung a line.
Disassembly read_code(const Binary& binary, std::string text);

}  // namespace rung::postfix
