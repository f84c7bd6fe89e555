#include "smt/cone.h"

#include <algorithm>

namespace rung {

void append_bits(const StepCircuit& circuit, std::uint32_t state,
                 const Word& leaves, const Word& next,
                 std::vector<StateBit>& bits) {
  const std::int64_t init = circuit.ts().states[state].init;
  for (std::size_t i = 0; i < leaves.size(); ++i) {
    if (leaves[i] <= kAigTrue) continue;  // a known sign
    const bool set = ((init >> std::min<std::size_t>(i, 63)) & 1) != 0;
    bits.push_back({leaves[i], next[i], set});
  }
}

Cone::Cone(const TransitionSystem& ts, const std::vector<ExprId>& roots)
    : circuit_(ts) {
  for (ExprId root : roots) roots_.push_back(circuit_.bit(root));
  for (ExprId constraint : ts.constraints) {
    const AigLit holds = circuit_.bit(constraint);
    constraint_ = circuit_.aig().conjunction(constraint_, holds);
  }
  // Encoding a next value may meet more variables.
  const std::vector<VarId>& met = circuit_.variables();
  for (std::size_t i = 0; i < met.size(); ++i) {
    const VarId var = met[i];
    const Variable& v = ts.vars[var];
    const AigLit in_range = circuit_.in_range(var);
    if (v.role == VarRole::State) {
      states_.push_back(v.state);
      circuit_.next(v.state);
      ranges_ = circuit_.aig().conjunction(ranges_, in_range);
    } else {
      inputs_.push_back(var);
      constraint_ = circuit_.aig().conjunction(constraint_, in_range);
    }
  }
  std::sort(states_.begin(), states_.end());
  std::sort(inputs_.begin(), inputs_.end());
  for (std::uint32_t state : states_) {
    append_bits(circuit_, state, circuit_.leaves(ts.states[state].var),
                circuit_.next(state), bits_);
  }
}

}  // namespace rung
