#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "analysis/transition_system.h"
#include "smt/run.h"

namespace rung {

/// Where a simulation met a target.
struct RandomHit {
  static constexpr std::uint32_t kFirstSteps = 16;
  std::uint32_t step = 0;  // of the first run that did, from 1; 0: none
  std::uint32_t lane = 0;
  std::uint64_t lanes = 0;  // unguided ones that did in the first steps
};

/// A term of which an engine asks: does it hold at the end of some scan? The
/// violation of an invariant, the goal of a `reach`, a trigger, a fault.
struct Target {
  enum class Purpose : std::uint8_t {  // from the least strict
    Trigger,                           // hoped to be reachable
    Witness,                           // the same, and its run is replayed
    Violation,                         // hoped to be unreachable
    Fault,  // hoped to be unreachable; runs to it are not searched
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
  std::uint32_t k = 0;      // Unreachable: of the induction that showed it
  bool met = false;         // some random run reached it
  RandomHit hit;            // in the last simulation
  std::uint32_t bound = 0;  // Open: no run of so many scans reaches it
  std::string failure;      // Open: of an engine; empty: none

  bool doubtful() const { return status == Status::Open && !met; }
};

}  // namespace rung
