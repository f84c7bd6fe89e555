#include "backend/unit/network.h"

#include <cassert>
#include <utility>

namespace rung::backend {
namespace {

/// Without constants, but for one that is all there is.
Terms folded(const Terms& terms) {
  Terms out;
  std::vector<std::size_t> starts;
  const auto constant = [&](std::size_t operand) -> int {
    const std::size_t end =
        operand + 1 < starts.size() ? starts[operand + 1] : out.size();
    if (end - starts[operand] != 1) return -1;
    const Term& term = out[starts[operand]];
    return term.op == NodeOp::Constant ? static_cast<int>(term.value) : -1;
  };
  for (const Term& term : terms) {
    if (term.op == NodeOp::Constant || term.op == NodeOp::Read) {
      starts.push_back(out.size());
      out.push_back(term);
      continue;
    }
    if (term.op == NodeOp::Not) {
      const int value = constant(starts.size() - 1);
      if (value >= 0) {
        out.back().value = 1 - value;
      } else {
        push_operator(out, NodeOp::Not, Type::Bit, 1);
      }
      continue;
    }
    assert(term.op == NodeOp::And || term.op == NodeOp::Or);
    const std::size_t left = starts.size() - 2;
    const std::size_t right = left + 1;
    const int absorbing = term.op == NodeOp::And ? 0 : 1;
    const int a = constant(left);
    const int b = constant(right);
    const auto at = [&](std::size_t operand) {
      return out.begin() + static_cast<std::ptrdiff_t>(starts[operand]);
    };
    if (a == absorbing || b == absorbing) {
      out.erase(at(left), out.end());
      out.push_back({.value = absorbing});
    } else if (b >= 0) {
      out.erase(at(right), out.end());
    } else if (a >= 0) {
      out.erase(at(left), at(right));
    } else {
      push_operator(out, term.op, Type::Bit, 2);
    }
    starts.pop_back();
  }
  return out;
}

}  // namespace

Network network_of(const Terms& expression) {
  using Kind = Circuit::Kind;
  const Terms terms = folded(expression);
  struct Todo {
    std::size_t term = 0;
    bool negated = false;
    std::uint32_t parent = 0;
    bool root = false;
  };
  Network network;
  std::vector<Todo> todo = {{terms.size() - 1, false, 0, true}};
  while (!todo.empty()) {
    const Todo next = todo.back();
    todo.pop_back();
    const Term& term = terms[next.term];
    if (term.op == NodeOp::Not) {
      todo.push_back({next.term - 1, !next.negated, next.parent, next.root});
      continue;
    }
    Circuit circuit;
    const bool leaf = term.op == NodeOp::Constant || term.op == NodeOp::Read;
    if (leaf) {
      circuit.kind = term.op == NodeOp::Read ? Kind::Contact : Kind::Constant;
      circuit.negated = next.negated;
      circuit.value = (term.value != 0) != next.negated;
      circuit.cell = term.cell;
    } else {
      circuit.kind = (term.op == NodeOp::And) != next.negated ? Kind::Series
                                                              : Kind::Parallel;
    }
    std::uint32_t self = next.parent;
    if (leaf || next.root || network[next.parent].kind != circuit.kind) {
      self = static_cast<std::uint32_t>(network.size());
      if (!next.root) network[next.parent].parts.push_back(self);
      network.push_back(std::move(circuit));
    }
    if (leaf) continue;
    const std::size_t right = next.term - 1;
    todo.push_back({right, next.negated, self, false});
    todo.push_back({right - terms[right].size, next.negated, self, false});
  }
  return network;
}

}  // namespace rung::backend
