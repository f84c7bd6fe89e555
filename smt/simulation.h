#pragma once

#include <cstdint>
#include <vector>

#include "smt/cone.h"
#include "smt/jump.h"
#include "smt/lanes.h"
#include "smt/run.h"
#include "smt/sat.h"

namespace rung {

/// 64 random runs of a cone from power-up, side by side on its bits. Inputs
/// change now and then and rest in between; behind a scan that changes nothing
/// but clocks the longest stretch follows, so timers of any length expire in a
/// few steps. What is true of all samples may be an invariant; what a run
/// meets is reachable.
class Simulation {
 public:
  /// `first` is a model of the inputs that the constraints allow, by
  /// Cone::inputs().
  Simulation(Cone& cone, const JumpCircuit* jump, AigLit never,
             std::vector<std::int64_t> first);

  /// One more scan of every lane, and the stretch behind the scan before.
  void step();

  std::uint32_t steps() const {
    return static_cast<std::uint32_t>(log_.size());
  }
  /// Lanes that have kept the constraints and met no fault so far.
  std::uint64_t alive() const { return alive_; }
  /// Of the scan just made; leaves of states are those before it.
  std::uint64_t value(AigLit a) const { return lanes_.value(a) & alive_; }
  std::int64_t value(const Word& word, std::uint32_t lane) const {
    return lanes_.value(word, lane);
  }

  /// The run of one lane up to the scan just made.
  Run run(std::uint32_t lane) const;

 private:
  struct Step {
    std::vector<std::uint64_t> inputs;  // by input bit
    std::vector<std::int64_t> deltas;   // by lane, behind this scan
  };

  struct Clock {
    Word next;                             // after the scan
    std::vector<std::int64_t> thresholds;  // it is compared with
  };

  std::uint64_t random();
  std::uint64_t changing_lanes();
  void propose();
  void keep_legal(const std::vector<std::uint64_t>& before);
  void set_inputs(const std::vector<std::uint64_t>& bits);
  std::vector<std::uint64_t> inputs() const;
  void advance();
  std::vector<std::int64_t> longest_stretches();
  std::int64_t time_to_event(std::uint32_t lane) const;
  std::int64_t legal_sum(std::int64_t delta) const;
  void set_stretch(const std::vector<std::int64_t>& deltas);

  Cone* cone_;
  const JumpCircuit* jump_;
  AigLit legal_;
  Lanes lanes_;
  std::vector<AigLit> input_bits_;
  std::vector<Clock> clocks_;
  std::vector<Step> log_;
  std::uint64_t alive_ = ~std::uint64_t{0};
  std::uint64_t seed_ = 0x2545'f491'4f6c'dd1dU;
};

/// Inputs of a first scan that the constraints allow; empty: none were found.
std::vector<std::int64_t> first_inputs(Cone& cone, const Deadline& deadline);

}  // namespace rung
