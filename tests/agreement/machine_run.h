#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "analysis/program.h"
#include "analysis/simulator.h"
#include "analysis/trace.h"
#include "rungproof_machine.h"

namespace rung {

/// A program lowered to the bytes of the postfix format and executed by the
/// controller's machine, beside the simulator.
class MachineRun {
 public:
  /// `problem` says why there is no machine: not lowered, or refused.
  MachineRun(const Program& program, std::string& problem);

  /// One scan with the inputs of `step`; says what differs, or nothing.
  /// Where the machine stops at an overflow, the simulator's values tell
  /// whether it had to; from then on nothing is compared.
  std::string scan(const Stimulus& stimulus, const StimulusStep& step,
                   const Simulator& simulator);

  bool stopped() const { return stopped_; }

 private:
  std::string judge_stop(const Simulator& simulator) const;

  const Program& program_;
  std::string bytes_;
  std::vector<std::uint32_t> memory_;
  std::vector<std::uint32_t> cells_;  // the machine's numbers, by CellId
  rungproof::Machine machine_;
  bool stopped_ = false;
};

}  // namespace rung
