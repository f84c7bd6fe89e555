#pragma once

#include <cstdint>
#include <vector>

namespace rung {

/// A signal of an and-inverter graph: node * 2, plus 1 when inverted.
using AigLit = std::uint32_t;
inline constexpr AigLit kAigFalse = 0;
inline constexpr AigLit kAigTrue = 1;

constexpr AigLit aig_not(AigLit a) { return a ^ 1U; }
constexpr std::uint32_t aig_node(AigLit a) { return a >> 1U; }
constexpr bool aig_inverted(AigLit a) { return (a & 1U) != 0; }

/// Two-input ANDs and inverters, hashed: equal gates are one node. Operands
/// have smaller nodes than the gates over them, so a pass is one loop.
///
/// Source of the rewriting: Brummayer, Biere, "Local Two-Level And-Inverter
/// Graph Minimization without Blowup", MEMICS 2006. It never adds a node that
/// plain hashing would not, and decides most interlocks while they are built.
class Aig {
 public:
  Aig();

  /// A fresh free signal.
  AigLit input();

  AigLit conjunction(AigLit a, AigLit b);
  AigLit disjunction(AigLit a, AigLit b) {
    return aig_not(conjunction(aig_not(a), aig_not(b)));
  }
  AigLit implication(AigLit a, AigLit b) {
    return aig_not(conjunction(a, aig_not(b)));
  }
  AigLit exclusive_or(AigLit a, AigLit b);
  AigLit choose(AigLit condition, AigLit then, AigLit otherwise);

  std::size_t size() const { return left_.size(); }
  bool is_gate(std::uint32_t node) const { return left_[node] != kLeaf; }
  AigLit left(std::uint32_t node) const { return left_[node]; }
  AigLit right(std::uint32_t node) const { return right_[node]; }

  /// Flags by node: the gates and leaves that `roots` are made of.
  std::vector<bool> cone(const std::vector<AigLit>& roots) const;

 private:
  struct Step {  // of a rewriting: the answer, or two new operands
    bool done = false;
    AigLit a = 0;
    AigLit b = 0;
  };
  static constexpr AigLit kLeaf = 0xffff'ffff;

  bool is_and(AigLit a) const {
    return !aig_inverted(a) && is_gate(aig_node(a));
  }
  bool is_nand(AigLit a) const {
    return aig_inverted(a) && is_gate(aig_node(a));
  }
  bool rewrite_one(AigLit a, AigLit b, Step& step) const;
  bool rewrite_two(AigLit a, AigLit b, Step& step) const;
  bool rewrite(AigLit a, AigLit b, Step& step) const;
  AigLit intern(AigLit a, AigLit b);
  void grow();

  std::vector<AigLit> left_;
  std::vector<AigLit> right_;
  std::vector<std::uint32_t> table_;  // open addressing; node, 0 is empty
  std::size_t gates_ = 0;
};

}  // namespace rung
