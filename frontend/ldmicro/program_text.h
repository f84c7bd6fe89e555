#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string_view>
#include <vector>

#include "frontend/ast.h"
#include "frontend/error_limit.h"
#include "frontend/ladder/power_flow.h"

namespace rung::ldmicro {

/// The instructions that are read; kInstructions has a row for each.
enum class Op : std::uint8_t {
  Contacts,
  Coil,
  Short,
  Open,
  Placeholder,
  MasterRelay,
  TimerOn,
  TimerOff,
  TimerRetentive,
  CountUp,
  CountDown,
  CountCircular,
  CountReverse,
  Reset,
  OneShotRising,
  OneShotFalling,
  OneShotLow,
  Oscillator,
  Compare,
  Move,
  Arithmetic,
};

struct InstructionKind {
  std::string_view name;
  Op op;
  std::uint8_t fewest;  // operands
  std::uint8_t most;
  ladder::Effect effect;
  AstOp operation = AstOp::Name;  // of Compare and Arithmetic
};

struct Word {
  std::string_view text;
  SourceRange where;
};

struct Instruction {
  const InstructionKind* kind = nullptr;
  std::vector<Word> operands;
  SourceRange where;
};

struct Variable {
  std::uint32_t bytes = 2;
  SourceRange where;
};

/// A file as its lines say it; names have no meaning yet.
struct ProgramText {
  bool first_format = false;  // LDmicro0.1; else 0.2, which a bare header is
  std::int64_t cycle_us = 10'000;
  SourceRange cycle_where;
  std::vector<Word> pins;  // of the IO LIST, in its order
  std::map<std::string_view, Variable> variables;  // of the VAR LIST
  std::vector<Instruction> instructions;
  struct Rung {
    std::vector<ladder::Step> steps;  // prepared
    SourceRange where;
  };
  std::vector<Rung> rungs;
};

/// Splits a file into settings and rungs. Comments, and property lines in them,
/// go into `ast`. Errors: RP087, RP051, RP053, RP054. Linear; no recursion.
ProgramText read_program_text(std::string_view text, Ast& ast,
                              ErrorLimit& errors);

/// A whole number of the language: 12, -12, 0x1F, 0b101, 0o17, 'a'.
std::optional<std::int64_t> number_of(std::string_view text);

}  // namespace rung::ldmicro
