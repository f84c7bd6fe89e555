#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "smt/cone.h"
#include "smt/interpret.h"
#include "smt/region.h"
#include "smt/run.h"
#include "smt/sat.h"
#include "smt/slice_state.h"

namespace rung {

/// Regions from which inputs lead to a goal, found by generalising runs that
/// get there: backwards, each scan's state is widened as far as the same
/// inputs still lead on.
///
/// Source: the widening by cores is that of Bradley, "SAT-Based Model Checking
///         without Unrolling", VMCAI 2011, on intervals instead of cubes; a
///         stretch of scans in which clocks run is one region with its clock
///         as ranking.
class Ways {
 public:
  using Values = SliceState;

  /// `goal` is a term of a scan's end, of which `cone` was made.
  Ways(TransitionSystem& ts, Cone& cone, ExprId goal, const Deadline& deadline);

  /// The scan ends with the goal or in a region: a term.
  ExprId arrived() const { return arrived_; }
  bool contains(const Values& state) const;
  const std::vector<Region>& regions() const { return regions_; }

  /// One scan that gets there from `state`: a region more. False when there
  /// is none.
  bool step_from(const Values& state);
  /// The same along a run that starts in `state` and gets there; its inputs
  /// are those of the cone. False when it could not be generalised.
  bool learn(const Values& state, const Run& run);

  /// Any state that is in no region, whether or not a run reaches it; nothing
  /// when there is none but those left out.
  std::optional<Values> any_outside();
  /// any_outside() gives no state within these bounds any more.
  void leave_out(const std::vector<Bound>& bounds);

  /// The states behind a run from `state`, scan by scan.
  Values end_of(const Values& state, const Run& run);

 private:
  struct Hop {  // a scan of a run, with where it starts
    Values before;
    std::vector<std::int64_t> inputs;
    bool stretch = false;  // many scans, as long as it takes
    Values after;
  };

  int literal(ExprId term) {
    return clauses_.literal(cone_.circuit().bit(term));
  }
  std::int64_t model_value(VarId var) const;
  void start_in(const Values& state);
  Values state_now() const;
  void scan(const std::vector<std::int64_t>& inputs);
  std::vector<Hop> hops(const Values& state, const Run& run);
  std::vector<Hop> single_scans(const Hop& stretch);
  std::vector<std::int64_t> with_dt(std::vector<std::int64_t> inputs,
                                    std::int64_t dt) const;

  Hop make_hop(const std::vector<std::int64_t>& inputs, bool stretch);
  bool is_quiet(const Hop& hop) const;
  bool grows_on(const Hop& hop);
  double narrowness(const Region& region) const;
  bool add_scan(const Hop& hop);
  bool add_stretch(const Hop& hop);
  bool try_stretch(const Hop& hop, std::uint32_t clock, bool relations,
                   std::int64_t dt);
  std::vector<std::uint32_t> running_clocks(const Hop& hop) const;
  std::vector<Region::Held> held(const std::vector<std::int64_t>& inputs) const;
  ExprId claim(const Region& region);
  bool leads_on(Region& region, bool take_core);
  bool widen(Region& region);
  void drop(Region& region);
  void widen_bound(Region& region, std::size_t i);
  void drop_inputs(Region& region);
  void add(Region region);

  TransitionSystem& ts_;
  Cone& cone_;
  Interpreter terms_;
  Sat sat_;
  AigClauses clauses_;
  ExprId allowed_;
  ExprId inside_;  // the state is in a region
  ExprId left_out_;
  ExprId arrived_;  // the scan's end is, or has the goal
  std::vector<Region> regions_;
};

}  // namespace rung
