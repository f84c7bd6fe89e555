#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "analysis/transition_system.h"
#include "smt/slice_state.h"

namespace rung {

/// A bound of a state at a scan's end, or of the difference of two clocks: at
/// least, or at most, `value`. A bit counts as 0 or 1.
struct Bound {
  static constexpr std::uint32_t kNone = ~std::uint32_t{0};

  std::uint32_t state = 0;
  std::uint32_t minus = kNone;  // the clock that is subtracted
  bool at_most = false;
  std::int64_t value = 0;

  bool operator==(const Bound&) const = default;
};

/// States from which one choice of inputs leads on. The next scan, with the
/// inputs `held` (dt may be one; any value will do for the others), ends with
/// the goal or in a region that was found before this one; or, where there is
/// a clock, in this region again, and the clock has grown. It is bounded, so
/// that ends.
struct Region {
  struct Held {
    VarId input;
    std::int64_t value = 0;
  };
  std::vector<Bound> bounds;  // of the states in it: all of these hold
  std::vector<Held> held;
  std::uint32_t clock = Bound::kNone;
};

/// The bounds of a region as a term over a state, and over the state that the
/// scan ends in.
ExprId before_scan(TransitionSystem& ts, const Bound& bound);
ExprId after_scan(TransitionSystem& ts, const Bound& bound);
ExprId before_scan(TransitionSystem& ts, const std::vector<Bound>& bounds);
ExprId after_scan(TransitionSystem& ts, const std::vector<Bound>& bounds);

/// The scan has the inputs that the region asks for.
ExprId holds_inputs(TransitionSystem& ts, const Region& region);
/// The clock of the region, which has one, grows in the scan.
ExprId clock_grows(TransitionSystem& ts, const Region& region);

/// Every assumption holds in the scan.
ExprId allowed(TransitionSystem& ts);

/// Is the state in it?
bool contains(const Region& region, const SliceState& values);

/// "Q0 && T(0).elapsed >= 4900: I1 = 1" in the program's names.
std::string to_string(const TransitionSystem& ts, const Region& region);

/// Runs of the system start in another state while this lives.
class StartingAt {
 public:
  /// `values` of the states named; the others start as ever.
  StartingAt(TransitionSystem& ts, const std::vector<std::uint32_t>& states,
             const SliceState& values);
  ~StartingAt();
  StartingAt(const StartingAt&) = delete;
  StartingAt& operator=(const StartingAt&) = delete;

 private:
  TransitionSystem& ts_;
  std::vector<std::uint32_t> states_;
  std::vector<std::int64_t> inits_;
};

}  // namespace rung
