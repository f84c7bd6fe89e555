#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "analysis/program.h"

namespace rung {

/// A binary written by hand, field by field, with the right length and
/// checksum: so that a test breaks one thing at a time.
struct Image {
  unsigned version = 1;
  unsigned flags = 0;
  unsigned dialect = 1;
  std::uint32_t scan_min = 1;
  std::uint32_t scan_max = 100;
  unsigned bits = 2;
  unsigned words = 0;
  unsigned slots = 0;
  unsigned bit_stack = 1;
  unsigned word_stack = 0;
  unsigned branches = 0;
  std::string attributes = std::string("\0\1", 2);  // an input, an output
  std::string ranges;
  std::string slot_table;
  std::string code = bytes_of({0x03, 0, 0x04, 1, 0x00});  // b = a
  std::string names = "\1a\1b";
  std::string notes;
  /// Added to the sizes that the header claims.
  int code_excess = 0;

  static std::string bytes_of(const std::vector<unsigned>& bytes);
  static std::string number(std::uint32_t value);  // four bytes
  std::string file() const;
};

/// The file with length and checksum made right.
std::string sealed(std::string file);

/// Reads a text; every diagnostic goes to `said`, one a line.
Program program_of(std::string_view text, std::string& said);
/// The same for a text without errors, which the test checks.
Program program_of(std::string_view text);

/// Lines in front of rungs; `cells` and the rest are lines too.
std::string postfix_text(std::string_view declarations, std::string_view rungs,
                         std::string_view evaluation = "strict");

/// Two programs, alike but for where they came from.
std::string difference(const Program& a, const Program& b);

}  // namespace rung
