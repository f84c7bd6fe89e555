#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "analysis/program.h"
#include "analysis/response.h"
#include "analysis/transition_system.h"
#include "smt/interpret.h"

namespace rung {

/// Finds runs that go round for ever without a Q: with the inputs held, what P
/// and Q depend on comes back to values that it had. Other parts of the
/// program, a blinking lamp, may do what they like.
class Standstill {
 public:
  Standstill(const Program& program,
             const std::vector<std::string>& assumptions,
             const ResponseQuestion& question);

  /// `stimulus` ends with a P that waits. The run with the scans that go round
  /// behind it; no value when none were found in `limit` scans in all.
  std::optional<Stimulus> find(const Stimulus& stimulus, std::int64_t dt_ms,
                               std::uint64_t limit);

 private:
  bool scan(const StimulusStep& step, const std::vector<CellId>& inputs);
  std::vector<std::int64_t> state() const;

  TransitionSystem ts_;
  ExprId response_;
  std::vector<ExprId> faults_;         // where the terms are not the program
  bool exact_ = true;                  // they are nowhere more than it
  std::vector<std::uint32_t> states_;  // that P and Q depend on
  std::vector<std::pair<CellId, VarId>> inputs_;
  std::unique_ptr<Interpreter> terms_;  // over ts_
};

}  // namespace rung
