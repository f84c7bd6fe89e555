#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "analysis/program.h"
#include "analysis/state_relation.h"
#include "backend/unit/names.h"

namespace rung::backend {

/// A program in the terms of a target, before it is spelled: variables with
/// names of the target, its function blocks, statements in execution order. All
/// writers but postfix print this; what differs between them is how an
/// expression is spelled and which blocks there are.

using BlockId = Id<struct BlockTag>;

/// A node of an expression in postorder. Its operands stand right before it;
/// `size` counts the nodes of its subtree. Only operators that every target
/// can spell: no Branch, Wrap16, ToBit; Call and ToWord only where a target has
/// calls in expressions, and bits that count as 0 and 1.
struct Term {
  NodeOp op = NodeOp::Constant;
  Type type = Type::Bit;
  std::uint32_t size = 1;
  std::int64_t value = 0;  // Constant
  CellId cell;             // Read: of Unit::variables
  std::uint32_t call = 0;  // Call: of Unit::calls
};
using Terms = std::vector<Term>;

Terms constant_term(Type type, std::int64_t value);
Terms read_term(CellId cell, Type type);
/// Appends an operator to its operands, which stand at the end of `terms`.
void push_operator(Terms& terms, NodeOp op, Type type, std::uint32_t operands);
Terms negated(Terms operand);
Terms joined(NodeOp op, Type type, Terms left, const Terms& right);
/// Is it one cell, or the negation of one?
bool is_contact(const Terms& terms);
bool reads(const Terms& terms, CellId cell);

struct Variable {
  std::string name;    // in the target
  std::string source;  // the cell of the source; empty: made here
  Type type = Type::Bit;
  CellRole role = CellRole::Memory;
  std::int64_t initial = 0;
  std::int64_t low = 0;
  std::int64_t high = 1;
  BlockId block;         // of the pin of a block, which nothing declares
  std::string_view pin;  // "Q"
};

struct Block {
  std::string name;       // in the target
  std::string_view type;  // "TON"
  std::string source;     // the element of the source: "T(0)"; may be empty
};

/// `T(0, 2, ` and how many operands follow.
struct InlineCall {
  std::string head;
  std::uint32_t operands = 0;
};

struct Argument {
  CellId pin;
  Terms value;
};

/// `target := value`, or the call of a block; both only when `guard` is true.
struct Statement {
  Terms guard;    // empty: always
  CellId target;  // no value: a call
  Terms value;
  BlockId block;
  std::vector<Argument> arguments;     // pins without one keep their values
  std::optional<std::int64_t> preset;  // ms, of a timer
  RungId rung;                         // of the source
};

struct Unit {
  std::string name;
  Arena<CellId, Variable> variables;
  Arena<BlockId, Block> blocks;
  std::vector<InlineCall> calls;
  std::vector<Statement> statements;
  std::vector<StateRelation> relations;
  NameTable names;  // all that are taken
};

/// What a writer gives: the text, and which of its signals are which of the
/// source's, where the names differ.
struct Written {
  std::string text;
  /// Name in the source, name in the target.
  std::vector<std::pair<std::string, std::string>> signals;
  std::vector<std::pair<std::string, std::string>> elements;
  std::vector<StateRelation> relations;
};

}  // namespace rung::backend
