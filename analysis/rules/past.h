#pragma once

#include <cstdint>
#include <unordered_map>

#include "analysis/transition_system.h"

namespace rung {

/// Gives terms a memory: what rules ask about more than one scan. Each is a
/// state that nothing in the program depends on.
class Past {
 public:
  explicit Past(TransitionSystem& ts) : ts_(ts) {}

  /// The value of `term` in the scan before; 0 (or what is nearest) in the
  /// first one.
  ExprId previous(ExprId term);

  /// All inputs that `term` depends on, through any number of scans, are what
  /// they were in the scan before. Linear in the system.
  ExprId inputs_rest(ExprId term);

  /// True in the first scan only.
  ExprId first_scan();

 private:
  TransitionSystem& ts_;
  std::unordered_map<std::uint32_t, ExprId> memory_;  // by term
  ExprId ran_;                                        // a scan has been made
};

}  // namespace rung
