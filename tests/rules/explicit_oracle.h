#pragma once

#include <cstdint>
#include <vector>

#include "analysis/rule.h"

namespace rung::testing {

/// Answers by visiting every reachable state one by one: slow, small, and
/// sharing nothing with the engines. Yes is said only when all states were
/// visited and the inputs tried are all that can tell a difference: a scan
/// takes one fixed time, and words are compared with constants only.
class ExplicitOracle : public Oracle {
 public:
  explicit ExplicitOracle(const TransitionSystem& ts) : ts_(ts) {}

  std::vector<Evidence> answer(const std::vector<Question>& questions) override;

 private:
  const TransitionSystem& ts_;
};

}  // namespace rung::testing
