#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "smt/cone.h"
#include "smt/lanes.h"

namespace rung {

/// A few lanes of a simulation that take two inputs by turns, in eras. When a
/// turn (two scans) changes nothing but numbers, and the next one changes them
/// by the same, it is taken as often as no comparison of them flips: a counter
/// of thousands is a few steps away.
///
/// A guess, as comparisons of sums may flip: a run that is found is checked
/// scan by scan before it counts.
class Turns {
 public:
  /// Even lanes, so that they go on from where others broke a record.
  static constexpr std::array<std::uint32_t, 4> kLanes = {8, 24, 40, 56};

  explicit Turns(const Cone& cone);

  /// No state counts anything: then there is nothing to take.
  bool useful() const { return useful_; }

  /// A new era begins: inputs of its first scans are what the lanes hold, those
  /// of the second ones differ from them where `flips` says.
  void begin(const Lanes& lanes, const std::vector<AigLit>& inputs,
             const std::vector<std::uint64_t>& flips);
  /// Sets the inputs of the era's next scan.
  void set_inputs(Lanes& lanes, const std::vector<AigLit>& inputs) const;
  /// The scan is made, and the lanes hold the state behind it: moves numbers.
  /// By lane, how often the last turn was taken again; empty: never.
  std::vector<std::int64_t> take(Lanes& lanes);

 private:
  struct Number {
    Word word;
    std::int64_t low = 0;
    std::int64_t high = 0;
    std::vector<std::int64_t> thresholds;  // ascending: is it at least that
  };
  using Values = std::array<std::int64_t, kLanes.size()>;
  struct Moment {  // between two turns
    std::vector<std::uint64_t> bits;
    std::vector<Values> numbers;
  };

  Moment now(const Lanes& lanes) const;
  std::int64_t times(std::size_t lane) const;

  bool useful_ = false;
  std::vector<Number> numbers_;
  std::vector<AigLit> bits_;                          // states that are bits
  std::array<std::vector<std::uint64_t>, 2> inputs_;  // by turns
  std::uint32_t scans_ = 0;                           // of this era
  std::vector<Moment> moments_;                       // the last three
};

}  // namespace rung
