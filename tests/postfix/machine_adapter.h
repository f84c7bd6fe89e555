#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "analysis/program.h"
#include "backend/postfix/lower.h"
#include "rungproof_machine.h"

namespace rung {

/// A program as a controller runs it: lowered to bytes, loaded, executed by
/// the machine of runtime/. For tests; cells are named as in the Program.
class MachineRun {
 public:
  explicit MachineRun(const Program& program) {
    DiagnosticList errors;
    const auto bytes = lower_to_postfix_binary(program, errors);
    if (!bytes) {
      for (const Diagnostic& item : errors.items()) {
        if (item.severity == Severity::Error) error_ += item.message + "\n";
      }
      return;
    }
    number_cells(program);
    load(*bytes);
  }

  /// Bytes made elsewhere; cells are numbered as in the file.
  explicit MachineRun(const std::string& bytes) { load(bytes); }

  // The machine points into this object.
  MachineRun(const MachineRun&) = delete;
  MachineRun& operator=(const MachineRun&) = delete;

  /// Empty, or why there is no machine: inexpressible, or refused.
  const std::string& error() const { return error_; }
  rungproof::Machine& machine() { return machine_; }

  void set_input(CellId cell, std::int64_t value) {
    machine_.set(number(cell), static_cast<std::int32_t>(value));
  }
  /// False after a fault: a word left 32 bits or its cell's range. The
  /// simulator goes on there, in 64 bits; the machine stops.
  bool scan(std::int64_t dt_ms) {
    return machine_.scan(static_cast<std::uint32_t>(dt_ms));
  }
  std::int64_t value(CellId cell) const { return machine_.value(number(cell)); }
  void reset() { machine_.reset(); }

 private:
  // The format has bits before words.
  void number_cells(const Program& program) {
    std::uint32_t next = 0;
    numbers_.resize(program.cells.size());
    for (const Type type : {Type::Bit, Type::Word}) {
      for (const CellId id : ids_of(program.cells)) {
        if (program.cells[id].type == type) numbers_[id.index()] = next++;
      }
    }
  }

  std::uint32_t number(CellId cell) const {
    return numbers_.empty() ? cell.index() : numbers_[cell.index()];
  }

  void load(const std::string& bytes) {
    bytes_.assign(bytes.begin(), bytes.end());
    const auto length = static_cast<std::uint32_t>(bytes_.size());
    const std::uint32_t words =
        rungproof::Machine::memory_words(bytes_.data(), length);
    // Exactly as much as asked for: what the machine touches beyond it, the
    // address sanitizer sees.
    memory_.resize(words);
    if (machine_.begin(bytes_.data(), length, memory_.data(), words) !=
        rungproof::Refusal::None) {
      error_ = "refusal " +
               std::to_string(static_cast<int>(machine_.refusal())) +
               " at byte " + std::to_string(machine_.refused_at());
    }
  }

  std::vector<std::uint8_t> bytes_;
  std::vector<std::uint32_t> memory_;
  std::vector<std::uint32_t> numbers_;
  rungproof::Machine machine_;
  std::string error_;
};

}  // namespace rung
