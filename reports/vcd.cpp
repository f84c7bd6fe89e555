#include "reports/vcd.h"

#include <array>
#include <bitset>
#include <cstdint>
#include <string_view>

namespace rung {
namespace {

struct Scope {
  CellRole role;
  std::string_view name;
};
constexpr std::array<Scope, 3> kScopes = {{{CellRole::Input, "inputs"},
                                           {CellRole::Output, "outputs"},
                                           {CellRole::Memory, "memory"}}};

// Printable characters, the first one fastest: "!", "\"", ..., "!!".
std::string identifier(CellId cell) {
  constexpr std::uint32_t kFirst = '!';
  constexpr std::uint32_t kCount = '~' - '!' + 1;
  std::string result;
  std::uint32_t rest = cell.index() + 1;
  while (rest > 0) {
    --rest;
    result += static_cast<char>(kFirst + rest % kCount);
    rest /= kCount;
  }
  return result;
}

// A reference holds no white space.
std::string reference(std::string_view name) {
  std::string result(name);
  for (char& c : result) {
    if (static_cast<unsigned char>(c) <= ' ') c = '_';
  }
  return result;
}

// Shorter vectors are extended with 0 on the left, so leading ones stay.
std::string vector_value(std::int64_t value) {
  const std::string bits =
      std::bitset<64>(static_cast<std::uint64_t>(value)).to_string();
  const std::size_t first = bits.find('1');
  return "b" + (first == std::string::npos ? "0" : bits.substr(first)) + " ";
}

void write_value(const Program& program, CellId cell, std::int64_t value,
                 std::string& out) {
  if (program.cells[cell].type == Type::Bit) {
    out += value != 0 ? '1' : '0';
  } else {
    out += vector_value(value);
  }
  out += identifier(cell) + "\n";
}

void write_scope(const Program& program, const Scope& scope, std::string& out) {
  bool is_open = false;
  for (const CellId id : ids_of(program.cells)) {
    const Cell& cell = program.cells[id];
    if (cell.role != scope.role) continue;
    if (!is_open) {
      out += "$scope module " + std::string(scope.name) + " $end\n";
      is_open = true;
    }
    out += cell.type == Type::Bit ? "$var wire 1 " : "$var integer 64 ";
    out += identifier(id) + " " + reference(cell.name) + " $end\n";
  }
  if (is_open) out += "$upscope $end\n";
}

}  // namespace

std::string write_vcd(const Program& program, const Recording& recording) {
  std::string out =
      "$version rungproof $end\n"
      "$timescale 1 ms $end\n"
      "$scope module program $end\n";
  for (const Scope& scope : kScopes) write_scope(program, scope, out);
  out += "$upscope $end\n$enddefinitions $end\n#0\n$dumpvars\n";
  for (const CellId cell : ids_of(program.cells)) {
    write_value(program, cell, recording.initial[cell.index()], out);
  }
  out += "$end\n";
  std::int64_t now = 0;
  for (const Recording::Sample& sample : recording.samples) {
    if (sample.now_ms != now) out += "#" + std::to_string(sample.now_ms) + "\n";
    now = sample.now_ms;
    for (const Recording::Change& change : sample.changes) {
      write_value(program, change.cell, change.value, out);
    }
  }
  if (recording.end_ms != now) {
    out += "#" + std::to_string(recording.end_ms) + "\n";
  }
  return out;
}

}  // namespace rung
