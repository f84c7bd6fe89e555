#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

#include "analysis/transition_system.h"

namespace rung {

/// Evaluates the terms of a transition system scan by scan, on integers: what
/// the circuits are tested against, and a check of a run before it is replayed.
class Interpreter {
 public:
  /// `roots` and all that they depend on, through any number of scans.
  Interpreter(const TransitionSystem& ts, const std::vector<ExprId>& roots);

  void reset();  // before the first scan
  void set_input(VarId input, std::int64_t value);
  void scan();
  /// Of a term in the cone, in the scan just run.
  std::int64_t value(ExprId term) const;
  /// After the scan just run (or before the first), by state index.
  std::int64_t state(std::uint32_t state) const;

 private:
  struct Latch {
    std::uint32_t state;
    std::uint32_t at;    // position of the variable
    std::uint32_t next;  // position of its next value
  };
  /// A term with its operands by position: scans look nothing up.
  struct Step {
    ExprOp op;
    std::uint32_t a = 0;
    std::uint32_t b = 0;
    std::uint32_t c = 0;
    std::int64_t constant = 0;
  };
  void collect(const std::vector<ExprId>& roots);
  std::uint32_t position(ExprId term) const { return position_.at(term); }

  const TransitionSystem* ts_;
  std::vector<ExprId> terms_;  // ascending, so operands come first
  std::vector<Step> steps_;    // by position
  std::unordered_map<ExprId, std::uint32_t> position_;
  std::vector<std::int64_t> values_;   // by position
  std::vector<std::int64_t> current_;  // by position, of the variables
  std::vector<Latch> latches_;
};

}  // namespace rung
