#include <algorithm>
#include <string>
#include <vector>

#include "smt/cone.h"
#include "smt/exports/problem.h"

namespace rung {
namespace {

/// A number as bytes of seven bits, the low ones first.
void append_number(std::string& out, std::uint32_t number) {
  while (number >= 0x80) {
    out.push_back(static_cast<char>((number & 0x7fU) | 0x80U));
    number >>= 7U;
  }
  out.push_back(static_cast<char>(number));
}

class AigerWriter {
 public:
  explicit AigerWriter(const ModelProblem& problem)
      : problem_(problem),
        cone_(problem.ts, {problem.bad, problem.legal}),
        aig_(cone_.circuit().aig()) {}

  std::string write() {
    guard();
    number_leaves();
    number_gates();
    std::string out = "aig " + std::to_string(next_ - 1) + " " +
                      std::to_string(inputs_.size()) + " " +
                      std::to_string(latches_.size()) + " 1 " +
                      std::to_string(gates_.size()) + "\n";
    for (const Latch& latch : latches_) {
      out += std::to_string(at(latch.next) ^ (latch.init ? 1U : 0U)) + "\n";
    }
    out += std::to_string(at(bad_)) + "\n";
    for (const std::uint32_t node : gates_) {
      const AigLit own = image_[node];
      AigLit a = at(aig_.left(node));
      AigLit b = at(aig_.right(node));
      if (a < b) std::swap(a, b);
      append_number(out, own - a);
      append_number(out, a - b);
    }
    return out + symbols();
  }

 private:
  struct Latch {
    AigLit leaf = 0;
    AigLit next = 0;
    bool init = false;  // a latch begins with 0: this one is stored inverted
    std::string name;
  };

  /// A scan that is not legal ends the run.
  void guard() {
    const AigLit legal = aig_.conjunction(cone_.constraint(), cone_.roots()[1]);
    bad_ = aig_.conjunction(cone_.roots()[0], legal);
    if (legal == kAigTrue) return;
    const AigLit ended = aig_.input();
    bad_ = aig_.conjunction(bad_, aig_not(ended));
    latches_.push_back(
        {ended, aig_.disjunction(ended, aig_not(legal)), false, "ended"});
  }

  std::string bit_name(VarId var, std::size_t bit) const {
    const Variable& variable = problem_.ts.vars[var];
    return variable.type == Type::Bit
               ? variable.name
               : variable.name + "[" + std::to_string(bit) + "]";
  }

  void number_leaves() {
    for (const VarId var : cone_.inputs()) {
      const Word& leaves = cone_.leaves(var);
      for (std::size_t i = 0; i < leaves.size(); ++i) {
        if (leaves[i] <= kAigTrue) continue;  // a known sign
        inputs_.push_back(leaves[i]);
        input_names_.push_back(bit_name(var, i));
      }
    }
    for (const StateBit& bit : cone_.bits()) {
      const StepCircuit::Leaf leaf = cone_.circuit().leaf(aig_node(bit.leaf));
      latches_.push_back(
          {bit.leaf, bit.next, bit.init, bit_name(leaf.var, leaf.bit)});
    }
    image_.assign(aig_.size(), kAigFalse);
    for (const AigLit leaf : inputs_) image_[aig_node(leaf)] = fresh();
    for (const Latch& latch : latches_) {
      image_[aig_node(latch.leaf)] = fresh() ^ (latch.init ? 1U : 0U);
    }
  }

  void number_gates() {
    std::vector<AigLit> roots = {bad_};
    for (const Latch& latch : latches_) roots.push_back(latch.next);
    const std::vector<bool> needed = aig_.cone(roots);
    for (std::uint32_t node = 1; node < aig_.size(); ++node) {
      if (!needed[node] || !aig_.is_gate(node)) continue;
      gates_.push_back(node);
      image_[node] = fresh();
    }
  }

  AigLit fresh() { return next_++ << 1U; }
  AigLit at(AigLit a) const { return image_[aig_node(a)] ^ (a & 1U); }

  std::string symbols() const {
    std::string out;
    for (std::size_t i = 0; i < inputs_.size(); ++i) {
      out += "i" + std::to_string(i) + " " + input_names_[i] + "\n";
    }
    for (std::size_t i = 0; i < latches_.size(); ++i) {
      out += "l" + std::to_string(i) + " " + latches_[i].name + "\n";
    }
    out += "o0 bad\nc\n";
    for (const std::string& name : problem_.names) out += name + "\n";
    return out;
  }

  const ModelProblem& problem_;
  Cone cone_;
  Aig& aig_;
  AigLit bad_ = kAigFalse;
  std::vector<AigLit> inputs_;
  std::vector<std::string> input_names_;
  std::vector<Latch> latches_;
  std::vector<std::uint32_t> gates_;  // nodes
  std::vector<AigLit> image_;         // by node
  AigLit next_ = 1;
};

}  // namespace

std::string to_aiger(const ModelProblem& problem) {
  return AigerWriter(problem).write();
}

}  // namespace rung
