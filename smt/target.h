#pragma once

#include <cstdint>
#include <string_view>

#include "analysis/transition_system.h"
#include "smt/run.h"

namespace rung {

/// A term of which an engine asks: does it hold at the end of some scan? The
/// violation of an invariant, the goal of a `reach`, a trigger, a fault.
struct Target {
  enum class Purpose : std::uint8_t {
    Violation,  // hoped to be unreachable
    Witness,    // hoped to be reachable
    Trigger,    // the same
    Fault,      // hoped to be unreachable; runs to it are not searched
  };
  enum class Status : std::uint8_t { Open, Reached, Unreachable };

  ExprId term;
  ExprId never;  // its negation: what a proof shows of every scan
  Purpose purpose = Purpose::Violation;
  /// Nobody sees the run, so it need not be the shortest and calmest.
  bool hidden = false;

  Status status = Status::Open;
  std::string_view engine;  // that decided it
  FoundRun run;             // Reached
  bool seen = false;        // Open: a random run reached it
  std::uint32_t bound = 0;  // Open: no run of so many scans reaches it
};

}  // namespace rung
