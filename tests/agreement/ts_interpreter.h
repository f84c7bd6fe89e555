#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "analysis/transition_system.h"

namespace rung {

/// Executes a transition system on concrete values: what the encoding says,
/// with no solver between. Choices of the encoding are false.
class TsInterpreter {
 public:
  explicit TsInterpreter(const TransitionSystem& ts);

  /// States get their initial values.
  void reset();

  /// Of an input, choice or dt, by VarId; for the steps that follow.
  void set(VarId var, std::int64_t value) { vars_[var.index()] = value; }
  void set_state(std::uint32_t state, std::int64_t value) {
    vars_[ts_.states[state].var.index()] = value;
  }
  std::int64_t state(std::uint32_t state) const {
    return vars_[ts_.states[state].var.index()];
  }

  /// One scan. Afterwards value() is of terms in that scan, and states have
  /// the values of its end.
  void step();

  std::int64_t value(ExprId term) const { return values_[term.index()]; }

  /// A value outside of the bounds that its term or variable claims; empty
  /// when there was none in the last step.
  const std::string& broken_bound() const { return broken_bound_; }

 private:
  std::int64_t evaluate(const Expr& expr) const;

  const TransitionSystem& ts_;
  std::vector<std::int64_t> vars_;    // by VarId
  std::vector<std::int64_t> values_;  // by ExprId
  std::string broken_bound_;
};

}  // namespace rung
