#pragma once

#include <string>
#include <vector>

#include "backend/unit/network.h"
#include "backend/unit/unit.h"

namespace rung::backend {

/// Can the expression be a list of `in`, `andBit`, `orBit` ...? Without a stack
/// no two blocks of contacts are joined.
bool is_bit_list(const Terms& terms, bool with_stack);

/// One call of a list: `andNotBit` of a cell, or `push` of the stack.
struct BitCall {
  std::string_view name;
  CellId cell;  // no value: a call of the stack
};

/// The calls that bring the expression, a bit list, into the accumulator. The
/// accumulator holds `known` already, if that is a cell.
std::vector<BitCall> bit_calls(const Terms& terms, CellId known);

/// How deep brackets are when the expression is written with operators.
std::size_t depth_of(const Terms& terms);

}  // namespace rung::backend
