#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

/// The SMT-LIB that certificates are written in, read again from its text:
/// declarations and assertions over Bool and Int, without binders.
namespace rung::script {

enum class Op : std::uint8_t {
  Symbol,
  Number,
  True,
  False,
  Not,
  And,
  Or,
  Xor,
  Implies,
  Equal,
  Less,
  LessEqual,
  Greater,
  GreaterEqual,
  Add,
  Subtract,  // of one operand: negation
  Multiply,
  Divide,  // SMT-LIB's: the remainder is not negative
  Modulo,
  Ite,
};

struct Symbol {
  std::string_view name;
  bool is_int = false;
};

struct Node {
  Op op = Op::True;
  std::uint32_t first = 0;  // operand, in Script::operands
  std::uint32_t count = 0;
  std::int64_t value = 0;  // of a number; index of a symbol
};

/// Nodes stand behind their operands. An assertion's nodes are those from
/// `begin` up to its root.
struct Assertion {
  std::uint32_t begin = 0;
  std::uint32_t root = 0;
};

struct Script {
  std::vector<Symbol> symbols;
  std::vector<Node> nodes;
  std::vector<std::uint32_t> operands;
  std::vector<Assertion> assertions;  // in the order of the text
  std::string error;                  // not empty: what is not understood
};

/// Errors: Script::error, for anything but what is listed above.
/// Lifetime: names point into `text`.
/// Limits: linear; no recursion.
Script read_script(std::string_view text);

}  // namespace rung::script
