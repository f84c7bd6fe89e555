#pragma once

#include <cstdint>
#include <vector>

#include "smt/bit_blast.h"
#include "smt/unroll.h"

namespace rung {

/// The part of a transition system that some terms depend on, through any
/// number of scans, as a circuit. The constraints of the system, with what
/// they depend on, are always in it.
class Cone {
 public:
  Cone(const TransitionSystem& ts, const std::vector<ExprId>& roots);

  const TransitionSystem& ts() const { return circuit_.ts(); }
  StepCircuit& circuit() { return circuit_; }
  const StepCircuit& circuit() const { return circuit_; }
  /// Of a variable of the cone.
  const Word& leaves(VarId var) const { return circuit_.known(var); }

  /// State indices, ascending; inputs (dt, if it matters) by VarId.
  const std::vector<std::uint32_t>& states() const { return states_; }
  const std::vector<VarId>& inputs() const { return inputs_; }
  /// All state bits, in the order of states().
  const std::vector<StateBit>& bits() const { return bits_; }

  /// Inputs and dt are in their ranges and the constraints hold.
  AigLit constraint() const { return constraint_; }
  /// Every state word is in its range: holds from power-up by construction.
  AigLit ranges() const { return ranges_; }
  /// Terms that the cone was made for may be bits of it: same index.
  const std::vector<AigLit>& roots() const { return roots_; }

 private:
  StepCircuit circuit_;
  std::vector<std::uint32_t> states_;
  std::vector<VarId> inputs_;
  std::vector<StateBit> bits_;
  std::vector<AigLit> roots_;
  AigLit constraint_ = kAigTrue;
  AigLit ranges_ = kAigTrue;
};

/// The bits of one state, given its value after the step.
void append_bits(const StepCircuit& circuit, std::uint32_t state,
                 const Word& leaves, const Word& next,
                 std::vector<StateBit>& bits);

}  // namespace rung
