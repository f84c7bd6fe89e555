#include "backend/unit/unit.h"

#include <algorithm>
#include <utility>

namespace rung::backend {

Terms constant_term(Type type, std::int64_t value) {
  return {{.type = type, .value = value}};
}

Terms read_term(CellId cell, Type type) {
  return {{.op = NodeOp::Read, .type = type, .cell = cell}};
}

void push_operator(Terms& terms, NodeOp op, Type type, std::uint32_t operands) {
  std::uint32_t size = 1;
  for (std::uint32_t i = 0; i < operands; ++i) {
    size += terms[terms.size() - size].size;
  }
  terms.push_back({.op = op, .type = type, .size = size});
}

Terms negated(Terms operand) {
  if (operand.back().op == NodeOp::Not) {
    operand.pop_back();
  } else {
    push_operator(operand, NodeOp::Not, Type::Bit, 1);
  }
  return operand;
}

Terms joined(NodeOp op, Type type, Terms left, const Terms& right) {
  left.insert(left.end(), right.begin(), right.end());
  push_operator(left, op, type, 2);
  return left;
}

bool is_contact(const Terms& terms) {
  return !terms.empty() && terms.front().op == NodeOp::Read &&
         (terms.size() == 1 ||
          (terms.size() == 2 && terms.back().op == NodeOp::Not));
}

bool reads(const Terms& terms, CellId cell) {
  return std::any_of(terms.begin(), terms.end(), [&](const Term& term) {
    return term.op == NodeOp::Read && term.cell == cell;
  });
}

}  // namespace rung::backend
