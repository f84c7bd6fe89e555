#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "frontend/ast.h"
#include "frontend/error_limit.h"
#include "frontend/ladder/power_flow.h"

namespace rung::rockwell {

enum class Op : std::uint8_t {
  Examine,   // XIC; XIO negates
  Energize,  // OTE
  Latch,     // OTL
  Unlatch,   // OTU
  OneShot,   // ONS
  OneShotRising,
  OneShotFalling,
  Timer,    // TON TOF RTO
  Counter,  // CTU CTD
  Reset,
  Compare,
  Limit,
  Move,
  Arithmetic,
  Clear,
  Jump,
  Label,
  MasterControl,
  AlwaysFalse,
  NoOperation,
  End,  // TND: the routine ends
  Call,
  Subroutine,
  Return,
};

struct InstructionKind {
  std::string_view name;
  Op op;
  std::uint8_t fewest;  // operands
  std::uint8_t most;
  ladder::Effect effect;
  AstOp operation = AstOp::Name;  // of Compare and Arithmetic; Not: XIO, CTD
};

struct Operand {
  std::string_view text;
  SourceRange where;
};

struct Instruction {
  const InstructionKind* kind = nullptr;
  std::string_view name;  // as it is written
  std::vector<Operand> operands;
  SourceRange where;
};

struct RungText {
  std::vector<ladder::Step> steps;  // prepared
  SourceRange where;
};

struct RungTexts {
  std::vector<Instruction> instructions;
  std::vector<RungText> rungs;
};

/// A piece of a file: `text` stands at `begin`.
struct Piece {
  std::string_view text;
  FileId file;
  std::uint32_t begin = 0;
};

/// Reads rungs in neutral text: `XIC(a)[OTE(b),XIO(c)OTE(d)];` as it is
/// exported, and `SOR XIC a BST OTE b NXB XIO c OTE d BND EOR` as it is typed.
/// A line may begin with `N:` and a coordinate `[1,0]` may follow a word.
///
/// Errors: RP051, RP054, RP087. Linear; no recursion.
void read_rungs(const Piece& piece, RungTexts& out, ErrorLimit& errors);

/// Only the form, with instructions of any name: how many there are; -1 after
/// an error.
std::int64_t count_instructions(std::string_view text);

}  // namespace rung::rockwell
