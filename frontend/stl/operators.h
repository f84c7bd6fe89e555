#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "frontend/ast.h"

namespace rung::stl {

enum class Code : std::uint8_t {
  Logic,  // U UN O ON X XN with an operand; O without
  Open,   // U( and so on
  Close,
  Assign,
  Set,  // of a bit, or of a counter
  Reset,
  Not,
  SetResult,  // SET, CLR
  Save,
  Edge,  // FP FN
  Jump,
  End,  // BE BEA BEB
  Call,
  Load,
  LoadBcd,
  Transfer,
  Compare,
  Add,
  Subtract,
  ToBcd,
  Swap,
  Timer,
  Release,  // FR
  Count,
  ZoneOn,
  ZoneOpen,
  ZoneClose,
  ZoneOff,
  Nothing,
  ResetStatus,
  Assert,
};
enum class Join : std::uint8_t { And, Or, Xor };
enum class Condition : std::uint8_t { None, Result, Saved };
enum class Mnemonics : std::uint8_t { Both, German, English };

struct Operator {
  std::string_view name;
  Code code = Code::Nothing;
  std::uint8_t operands = 0;
  Mnemonics mnemonics = Mnemonics::Both;
  Join join = Join::And;
  bool negate = false;
  Condition condition = Condition::None;  // of Jump, End, Call
  bool saves = false;                     // SPBB, SPBNB
  AstOp compare = AstOp::Equal;           // of Compare and Assert
  bool wide = false;                      // 32 bits
  std::string_view element = {};          // of Timer: the kind's operation
};

/// Null when there is none. `SE` is two: in English an extended pulse, in
/// German a delay.
const Operator* find_operator(std::string_view upper_name, Mnemonics mnemonics);
std::vector<std::string_view> operator_names();

}  // namespace rung::stl
