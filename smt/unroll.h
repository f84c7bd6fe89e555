#pragma once

#include <cstdint>
#include <vector>

#include "smt/aig.h"

namespace rung {

/// One bit of the state: its leaf in a step's graph, and its value afterwards.
struct StateBit {
  AigLit leaf = 0;
  AigLit next = 0;
  bool init = false;
};

/// Copies of a step's graph, one for each of a row of steps, in a graph of
/// their own. Signals are copied when first asked for, and simplify on the way:
/// from power-up most of the first scans is constant.
class Unrolling {
 public:
  enum class Start : std::uint8_t {
    Initial,  // step 0 begins at power-up
    Any,      // step 0 begins in any state
  };

  /// `step` may get more gates later, but no more state bits.
  Unrolling(const Aig& step, const std::vector<StateBit>& bits, Start start);

  /// The signal `of` (of the step's graph) in step `frame`.
  AigLit at(std::uint32_t frame, AigLit of);

  Aig& aig() { return aig_; }

 private:
  struct Place {
    std::uint32_t frame;
    std::uint32_t node;
  };
  static constexpr AigLit kNone = 0xffff'ffff;

  AigLit known(std::uint32_t frame, AigLit of) const;
  bool copy(Place place);  // false: operands were pushed first
  void push(std::uint32_t frame, AigLit of);

  const Aig* step_;
  Start start_;
  std::vector<std::uint32_t> bit_of_;  // by node of a state leaf: index + 1
  std::vector<StateBit> bits_;
  Aig aig_;
  std::vector<std::vector<AigLit>> copies_;  // by frame and node
  std::vector<Place> stack_;
};

}  // namespace rung
