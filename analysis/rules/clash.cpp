#include "analysis/rules/clash.h"

#include <algorithm>
#include <limits>
#include <unordered_map>
#include <vector>

#include "analysis/rules/support.h"

namespace rung {
namespace {

constexpr std::int64_t kLowest = std::numeric_limits<std::int32_t>::min();
constexpr std::int64_t kHighest = std::numeric_limits<std::int32_t>::max();

struct Interval {
  std::int64_t low = kLowest;
  std::int64_t high = kHighest;
  std::uint32_t node = Clash::kNone;  // the last comparison that narrowed it
};

/// A comparison of a cell with a constant, the cell on the left.
struct Bound {
  CellId cell;  // no value: it is something else
  NodeOp op = NodeOp::Less;
  std::int64_t limit = 0;
};

NodeOp mirrored(NodeOp op) {
  if (op == NodeOp::Less) return NodeOp::Greater;
  if (op == NodeOp::LessEqual) return NodeOp::GreaterEqual;
  if (op == NodeOp::Greater) return NodeOp::Less;
  if (op == NodeOp::GreaterEqual) return NodeOp::LessEqual;
  return op;
}

NodeOp inverse(NodeOp op) {
  if (op == NodeOp::Less) return NodeOp::GreaterEqual;
  if (op == NodeOp::LessEqual) return NodeOp::Greater;
  if (op == NodeOp::Greater) return NodeOp::LessEqual;
  if (op == NodeOp::GreaterEqual) return NodeOp::Less;
  return op == NodeOp::Equal ? NodeOp::NotEqual : NodeOp::Equal;
}

Bound bound_at(const Program& program, std::uint32_t node) {
  bool inverted = false;
  while (program.nodes[node].op == NodeOp::Not) {
    inverted = !inverted;
    node = program.nodes[node].a;
  }
  const Node& it = program.nodes[node];
  if (!is_comparison(it.op)) return {};
  const Node& a = program.nodes[it.a];
  const Node& b = program.nodes[it.b];
  const NodeOp op = inverted ? inverse(it.op) : it.op;
  if (a.op == NodeOp::Read && b.op == NodeOp::Constant) {
    return {a.cell, op, b.value};
  }
  if (a.op == NodeOp::Constant && b.op == NodeOp::Read) {
    return {b.cell, mirrored(op), a.value};
  }
  return {};
}

void narrow(Interval& interval, const Bound& bound) {
  const std::int64_t limit = bound.limit;
  const NodeOp op = bound.op;
  if (op == NodeOp::Less || op == NodeOp::LessEqual || op == NodeOp::Equal) {
    interval.high =
        std::min(interval.high, op == NodeOp::Less ? limit - 1 : limit);
  }
  if (op == NodeOp::Greater || op == NodeOp::GreaterEqual ||
      op == NodeOp::Equal) {
    interval.low =
        std::max(interval.low, op == NodeOp::Greater ? limit + 1 : limit);
  }
}

}  // namespace

Clash find_clash(const Program& program, std::uint32_t root, NodeOp op) {
  struct Seen {
    std::uint32_t plain = Clash::kNone;
    std::uint32_t inverted = Clash::kNone;
    Interval interval;
  };
  const std::vector<std::uint32_t> parts = operands(program, root, op);
  if (parts.size() < 2) return {};
  std::unordered_map<std::uint32_t, Seen> cells;
  cells.reserve(parts.size());
  for (const std::uint32_t node : parts) {
    const Contact contact = contact_at(program, node);
    if (contact.cell.has_value()) {
      Seen& seen = cells[contact.cell.index()];
      const std::uint32_t other = contact.inverted ? seen.plain : seen.inverted;
      if (other != Clash::kNone) return {other, node};
      (contact.inverted ? seen.inverted : seen.plain) = node;
      continue;
    }
    if (op != NodeOp::And) continue;
    const Bound bound = bound_at(program, node);
    if (!bound.cell.has_value()) continue;
    Interval& interval = cells[bound.cell.index()].interval;
    narrow(interval, bound);
    if (interval.low > interval.high && interval.node != Clash::kNone) {
      return {interval.node, node};
    }
    interval.node = node;
  }
  return {};
}

}  // namespace rung
