#include "smt/aig.h"

#include <utility>

namespace rung {
namespace {

std::uint32_t hash_pair(AigLit a, AigLit b) {
  std::uint64_t h = (std::uint64_t{a} << 32U | b) * 0x9e37'79b9'7f4a'7c15U;
  return static_cast<std::uint32_t>(h >> 32U);
}

}  // namespace

Aig::Aig() : left_(1, kLeaf), right_(1, kLeaf), table_(1024, 0) {}

AigLit Aig::input() {
  left_.push_back(kLeaf);
  right_.push_back(kLeaf);
  return static_cast<AigLit>((left_.size() - 1) << 1U);
}

void Aig::grow() {
  std::vector<std::uint32_t> table(table_.size() * 2, 0);
  const std::size_t mask = table.size() - 1;
  for (std::uint32_t node : table_) {
    if (node == 0) continue;
    std::size_t at = hash_pair(left_[node], right_[node]) & mask;
    while (table[at] != 0) at = (at + 1) & mask;
    table[at] = node;
  }
  table_ = std::move(table);
}

AigLit Aig::intern(AigLit a, AigLit b) {
  if (a > b) std::swap(a, b);
  const std::size_t mask = table_.size() - 1;
  std::size_t at = hash_pair(a, b) & mask;
  while (table_[at] != 0) {
    const std::uint32_t node = table_[at];
    if (left_[node] == a && right_[node] == b) return node << 1U;
    at = (at + 1) & mask;
  }
  const auto node = static_cast<std::uint32_t>(left_.size());
  left_.push_back(a);
  right_.push_back(b);
  table_[at] = node;
  if (++gates_ * 2 > table_.size()) grow();
  return node << 1U;
}

/// Rules with one gate: `a` is one, `b` anything.
bool Aig::rewrite_one(AigLit a, AigLit b, Step& step) const {
  if (is_and(a)) {
    const AigLit x = left_[aig_node(a)];
    const AigLit y = right_[aig_node(a)];
    if (b == aig_not(x) || b == aig_not(y)) {  // contradiction
      step = {true, kAigFalse, 0};
      return true;
    }
    if (b == x || b == y) {  // idempotence
      step = {true, a, 0};
      return true;
    }
  } else if (is_nand(a)) {
    const AigLit x = left_[aig_node(a)];
    const AigLit y = right_[aig_node(a)];
    if (b == aig_not(x) || b == aig_not(y)) {  // subsumption
      step = {true, b, 0};
      return true;
    }
    if (b == x || b == y) {  // substitution
      step = {false, b, aig_not(b == x ? y : x)};
      return true;
    }
  }
  return false;
}

/// Rules with two gates that share an operand.
bool Aig::rewrite_two(AigLit a, AigLit b, Step& step) const {
  const AigLit x = left_[aig_node(a)];
  const AigLit y = right_[aig_node(a)];
  const AigLit z = left_[aig_node(b)];
  const AigLit w = right_[aig_node(b)];
  const bool opposite =
      x == aig_not(z) || x == aig_not(w) || y == aig_not(z) || y == aig_not(w);
  const bool shares_z = z == x || z == y;
  const bool shares_w = w == x || w == y;
  if (is_and(a) && is_and(b)) {
    if (opposite) {
      step = {true, kAigFalse, 0};
      return true;
    }
    if (shares_z || shares_w) {  // (x y)(x w) is (x y) w
      step = {false, a, shares_z ? w : z};
      return true;
    }
  } else if (is_and(a)) {  // b is a NAND
    if (opposite) {
      step = {true, a, 0};
      return true;
    }
    if (shares_z || shares_w) {  // (x y) !(x w) is (x y) !w
      step = {false, a, aig_not(shares_z ? w : z)};
      return true;
    }
  } else {  // two NANDs: !(x y) !(x !y) is !x
    if ((x == z && y == aig_not(w)) || (x == w && y == aig_not(z))) {
      step = {true, aig_not(x), 0};
      return true;
    }
    if ((y == w && x == aig_not(z)) || (y == z && x == aig_not(w))) {
      step = {true, aig_not(y), 0};
      return true;
    }
  }
  return false;
}

bool Aig::rewrite(AigLit a, AigLit b, Step& step) const {
  if (rewrite_one(a, b, step) || rewrite_one(b, a, step)) return true;
  if (!is_gate(aig_node(a)) || !is_gate(aig_node(b))) return false;
  return is_nand(a) && is_and(b) ? rewrite_two(b, a, step)
                                 : rewrite_two(a, b, step);
}

AigLit Aig::conjunction(AigLit a, AigLit b) {
  // Every substitution replaces an operand by one of a smaller node, so this
  // ends.
  for (;;) {
    if (a == kAigFalse || b == kAigFalse || a == aig_not(b)) return kAigFalse;
    if (a == kAigTrue || a == b) return b;
    if (b == kAigTrue) return a;
    Step step;
    if (!rewrite(a, b, step)) return intern(a, b);
    if (step.done) return step.a;
    a = step.a;
    b = step.b;
  }
}

AigLit Aig::exclusive_or(AigLit a, AigLit b) {
  return conjunction(aig_not(conjunction(a, b)),
                     aig_not(conjunction(aig_not(a), aig_not(b))));
}

AigLit Aig::choose(AigLit condition, AigLit then, AigLit otherwise) {
  if (then == otherwise) return then;
  return aig_not(
      conjunction(aig_not(conjunction(condition, then)),
                  aig_not(conjunction(aig_not(condition), otherwise))));
}

std::vector<bool> Aig::cone(const std::vector<AigLit>& roots) const {
  std::vector<bool> in(size(), false);
  for (AigLit root : roots) in[aig_node(root)] = true;
  for (auto node = static_cast<std::uint32_t>(size()); node-- > 0;) {
    if (!in[node] || !is_gate(node)) continue;
    in[aig_node(left_[node])] = true;
    in[aig_node(right_[node])] = true;
  }
  return in;
}

}  // namespace rung
