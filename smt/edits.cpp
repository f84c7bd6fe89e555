#include "smt/edits.h"

#include <vector>

namespace rung {

void negate_node(Program& program, std::uint32_t at) {
  const auto moved = [&](std::uint32_t& index) {
    if (index >= at) ++index;
  };
  Node negation = {
      .op = NodeOp::Not, .a = at, .where = program.nodes[at].where};
  for (std::uint32_t i = at + 1; i < program.nodes.size(); ++i) {
    Node& node = program.nodes[i];
    moved(node.a);
    moved(node.b);
    moved(node.target);
  }
  for (std::uint32_t i = 0; i < at; ++i) {
    // Only markers point ahead.
    Node& node = program.nodes[i];
    if (node.op == NodeOp::Branch && node.target > at) ++node.target;
  }
  program.nodes.insert(program.nodes.begin() + at + 1, negation);
  for (const RungId id : ids_of(program.rungs)) {
    Rung& rung = program.rungs[id];
    if (rung.begin > at) ++rung.begin;
    if (rung.end > at) ++rung.end;
  }
  for (const CallId id : ids_of(program.calls)) {
    std::vector<std::uint32_t>& arguments = program.calls[id].arguments;
    for (std::uint32_t& argument : arguments) moved(argument);
  }
}

void replace_operator(Program& program, std::uint32_t at, NodeOp op) {
  Node& node = program.nodes[at];
  if (node.op == NodeOp::Not) {  // what is not negated is itself, twice
    node.op = NodeOp::And;
    node.b = node.a;
    return;
  }
  node.op = op;
  for (Node& marker : program.nodes) {
    const bool of_it = marker.op == NodeOp::Branch && marker.target == at;
    if (of_it) marker.skip_when = !marker.skip_when;
  }
}

void append_contact(Program& program, RungId rung, CellId cell, bool negated,
                    NodeOp op) {
  const std::uint32_t end = program.rungs[rung].end;
  const SourceRange where = program.rungs[rung].where;
  std::vector<Node> added = {
      {.op = NodeOp::Read, .cell = cell, .where = where}};
  if (negated) added.push_back({.op = NodeOp::Not, .a = end, .where = where});
  const auto contact = end + static_cast<std::uint32_t>(added.size()) - 1;
  added.push_back({.op = op, .a = end - 1, .b = contact, .where = where});
  const auto count = static_cast<std::uint32_t>(added.size());
  const auto move = [&](std::uint32_t& index) {
    if (index >= end) index += count;
  };
  for (std::uint32_t i = end; i < program.nodes.size(); ++i) {
    move(program.nodes[i].a);
    move(program.nodes[i].b);
    move(program.nodes[i].target);
  }
  program.nodes.insert(program.nodes.begin() + end, added.begin(), added.end());
  for (const RungId id : ids_of(program.rungs)) {
    Rung& other = program.rungs[id];
    move(other.begin);
    if (id == rung || other.end > end) other.end += count;
  }
  for (const CallId id : ids_of(program.calls)) {
    for (std::uint32_t& argument : program.calls[id].arguments) move(argument);
  }
}

void replace_by_constant(Program& program, std::uint32_t at, bool value) {
  Node& node = program.nodes[at];
  node.op = NodeOp::Constant;
  node.value = value ? 1 : 0;
}

}  // namespace rung
