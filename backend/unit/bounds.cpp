#include "backend/unit/bounds.h"

#include <algorithm>
#include <limits>

namespace rung::backend {
namespace {

constexpr std::int64_t kLeast = std::numeric_limits<std::int32_t>::min();
constexpr std::int64_t kMost = std::numeric_limits<std::int32_t>::max();
// A word that still grows after so many passes is taken as growing for ever.
constexpr int kPasses = 4;

Bounds clamped(Bounds bounds) {
  return {std::clamp(bounds.low, kLeast, kMost),
          std::clamp(bounds.high, kLeast, kMost)};
}

class Finder {
 public:
  explicit Finder(const Program& program) : program_(program) {
    for (const Cell& cell : program.cells) {
      const bool input = cell.role == CellRole::Input;
      found_.cells.push_back(input ? Bounds{cell.low, cell.high}
                                   : Bounds{cell.initial, cell.initial});
    }
    found_.nodes.resize(program.nodes.size());
    found_.overflows.resize(program.nodes.size(), false);
  }

  WordBounds run() {
    int passes = 0;
    while (pass()) {
      if (++passes < kPasses) continue;
      widen();
      pass();
      break;
    }
    return std::move(found_);
  }

 private:
  /// Did a cell grow?
  bool pass() {
    bool grew = false;
    for (const Rung& rung : program_.rungs) {
      for (std::uint32_t at = rung.begin; at < rung.end; ++at) visit(at);
      if (program_.cells[rung.target].type == Type::Bit) continue;
      Bounds& bounds = found_.cells[rung.target.index()];
      const Bounds value = found_.nodes[rung.root()];
      if (value.within(bounds.low, bounds.high)) continue;
      grew = true;
      bounds = {std::min(bounds.low, value.low),
                std::max(bounds.high, value.high)};
    }
    return grew;
  }

  // What is outside the range of its type is a fault, and no value.
  void widen() {
    for (const CellId id : ids_of(program_.cells)) {
      const Cell& cell = program_.cells[id];
      Bounds& bounds = found_.cells[id.index()];
      if (bounds == Bounds{cell.initial, cell.initial}) continue;
      bounds = {cell.low, cell.high};
    }
  }

  void visit(std::uint32_t at) {
    const Node& node = program_.nodes[at];
    Bounds& bounds = found_.nodes[at];
    if (node.type == Type::Bit) return;
    if (node.op == NodeOp::Constant) {
      bounds = {node.value, node.value};
    } else if (node.op == NodeOp::Read) {
      bounds = found_.cells[node.cell.index()];
    } else if (node.op == NodeOp::Call) {
      const InstanceId of = program_.calls[node.call].instance;
      const ElementFamily family = program_.instances[of].kind->family;
      bounds = family == ElementFamily::Timer ? Bounds{0, kMost}
                                              : Bounds{-0x8000, 0x7fff};
    } else if (is_choice(node)) {
      const Bounds then = found_.nodes[node.a];
      const Bounds otherwise = found_.nodes[node.b];
      bounds = {std::min(then.low, otherwise.low),
                std::max(then.high, otherwise.high)};
    } else {
      bounds = bounds_of(node.op, found_.nodes[node.a], found_.nodes[node.b]);
    }
    found_.overflows[at] = clamped(bounds) != bounds;
    bounds = clamped(bounds);
  }

  /// `to_word(g) * x + to_word(!g) * y`, as readers write what stands behind a
  /// condition: one of the two is 0.
  bool is_choice(const Node& node) const {
    if (node.op != NodeOp::Add) return false;
    const Node* const chosen = factor_of(node.a);
    const Node* const otherwise = factor_of(node.b);
    if (chosen == nullptr || otherwise == nullptr) return false;
    if (chosen->op != NodeOp::Read || otherwise->op != NodeOp::Not) {
      return false;
    }
    const Node& denied = program_.nodes[otherwise->a];
    return denied.op == NodeOp::Read && denied.cell == chosen->cell;
  }

  /// The bit whose number is the left factor of a product; null: none.
  const Node* factor_of(std::uint32_t at) const {
    const Node& product = program_.nodes[at];
    if (product.op != NodeOp::Multiply) return nullptr;
    const Node& factor = program_.nodes[product.a];
    return factor.op == NodeOp::ToWord ? &program_.nodes[factor.a] : nullptr;
  }

  const Program& program_;
  WordBounds found_;
};

}  // namespace

Bounds bounds_of(NodeOp op, Bounds left, Bounds right) {
  if (op == NodeOp::Add) {
    return {left.low + right.low, left.high + right.high};
  }
  if (op == NodeOp::Subtract) {
    return {left.low - right.high, left.high - right.low};
  }
  if (op == NodeOp::Negate) return {-left.high, -left.low};
  if (op == NodeOp::Multiply) {
    const auto [low, high] =
        std::minmax({left.low * right.low, left.low * right.high,
                     left.high * right.low, left.high * right.high});
    return {low, high};
  }
  if (op == NodeOp::Divide) {  // by a constant
    const auto [low, high] =
        std::minmax({left.low / right.low, left.high / right.low});
    return {low, high};
  }
  if (op == NodeOp::Wrap16 && !left.within(-0x8000, 0x7fff)) {
    return {-0x8000, 0x7fff};
  }
  return op == NodeOp::ToWord ? Bounds{0, 1} : left;
}

WordBounds find_bounds(const Program& program) { return Finder(program).run(); }

}  // namespace rung::backend
