#pragma once

#include <cstdint>
#include <vector>

#include "smt/cone.h"
#include "smt/jump.h"
#include "smt/lanes.h"
#include "smt/run.h"
#include "smt/sat.h"
#include "smt/turns.h"

namespace rung {

/// 64 random runs of a cone from power-up, side by side on its bits. Inputs
/// change now and then and rest in between; behind a scan that changes nothing
/// but clocks the longest stretch follows, so timers of any length expire in a
/// few steps. What is true of all samples may be an invariant; what a run
/// meets is reachable.
///
/// Half of the lanes are guided: they start again and again where some run
/// brought a number or a bit to where none had it. So a count or a sequence is
/// climbed step by step, not by luck in one run.
///
/// A few lanes are patient: they wait as long as it takes, with the shortest or
/// the longest scans only, and seldom change inputs. So a chain of timers runs
/// to its end, and how far clocks drift apart is seen at its extremes.
class Simulation {
 public:
  /// `first` is a model of the inputs that the constraints allow, by
  /// Cone::inputs().
  Simulation(Cone& cone, const JumpCircuit* jump, AigLit never,
             std::vector<std::int64_t> first, std::uint64_t seed = 0);

  /// One more scan of every lane, and the stretch behind the scan before.
  void step();
  /// Did the last step bring some state to where no run had it?
  bool news() const { return news_; }

  /// Every other lane, so some of each pace.
  static constexpr std::uint64_t kGuided = 0x5555'5555'5555'5555U;
  static constexpr std::uint64_t kPatient = 0xaaaa'aaaa'0000'0000U;

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

  /// The run of a lane up to the scan of `step`, from 1.
  Run run(std::uint32_t step, std::uint32_t lane) const;

 private:
  struct Place {  // a scan of a lane
    std::uint32_t step;
    std::uint32_t lane;
  };
  struct Step {
    std::vector<std::uint64_t> inputs;  // by input bit
    std::vector<std::int64_t> deltas;   // by lane, behind this scan
    std::vector<std::int64_t> turns;    // by lane, behind that: see Turns
    std::vector<Place> origin;          // by lane; empty: the step before
  };

  struct Clock {
    Word before;
    Word next;                             // after the scan
    std::vector<std::int64_t> thresholds;  // it is compared with
  };

  /// The highest and lowest value that runs brought a number or a bit to.
  struct Record {
    Word word;  // over the states before a scan
    std::int64_t high = 0;
    std::int64_t low = 0;
  };

  /// What came behind the scan at `place`, where a record was broken.
  struct Start {
    Place place;
    std::vector<bool> values;  // of movable_
  };

  std::uint64_t random();
  std::uint64_t beyond(const Word& word, std::int64_t bound, bool down) const;
  std::uint64_t record_breakers();
  void remember(std::uint64_t lanes);
  std::vector<Place> restart();
  std::uint64_t changing_lanes();
  void propose();
  void keep_legal(const std::vector<std::uint64_t>& before);
  void set_inputs(const std::vector<std::uint64_t>& bits);
  std::vector<std::uint64_t> inputs() const;
  void advance();
  Lanes::Values waits();
  std::vector<std::uint64_t> few_flips();
  std::uint64_t take_stretches(Lanes::Values& deltas);
  Lanes::Values times_to_event() const;
  std::int64_t legal_sum(std::int64_t delta) const;
  void set_stretch(const Lanes::Values& deltas);

  Cone* cone_;
  const JumpCircuit* jump_;
  AigLit legal_;
  Lanes lanes_;
  std::vector<AigLit> input_bits_;
  std::vector<std::size_t> toggled_;   // of them, inputs that are bits
  std::vector<std::uint64_t> frozen_;  // by input; bits only
  std::vector<Clock> clocks_;
  std::vector<Record> records_;
  Turns turns_;
  std::vector<Step> log_;
  std::vector<AigLit> movable_;  // state and input bits
  std::vector<Start> starts_;    // the latest ones, in a ring
  std::size_t next_start_ = 0;
  bool news_ = false;
  std::uint64_t alive_ = ~std::uint64_t{0};
  std::uint64_t seed_ = 0x2545'f491'4f6c'dd1dU;
};

/// Inputs of a first scan that the constraints allow; empty: none were found.
std::vector<std::int64_t> first_inputs(Cone& cone, const Deadline& deadline);

}  // namespace rung
