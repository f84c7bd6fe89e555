#pragma once

#include <cstdint>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "smt/cone.h"

namespace rung {

/// The term min(x + dt, cap) of every clock x, by state index; no value for
/// states that are none. Made before slices are, because it may add terms.
std::vector<ExprId> growth_terms(TransitionSystem& ts);

/// A scan and, behind it, a stretch: when the scan changed nothing but clocks,
/// more scans with the same inputs may follow at once, as long as no comparison
/// that reads a clock changes its answer. They are one step of the search,
/// whose length `delta` is any sum of `scans` legal dt's; all clocks that grew
/// in the scan grow by it. So an hour costs one step.
///
/// Exact for what it finds: a step expands into those scans.
/// Comparisons of sums of several clocks may flip twice in a stretch unseen:
/// so a run found is checked scan by scan before it counts.
class JumpCircuit {
 public:
  JumpCircuit(Cone& cone, const std::vector<ExprId>& growth);

  /// No clock in the cone: then no stretch is ever worth anything.
  bool useful() const { return useful_; }
  AigLit taken() const { return taken_; }
  const Word& delta() const { return delta_; }
  const Word& scans() const { return scans_; }
  /// Must hold in every step: a stretch that is taken is one that may be.
  AigLit allowed() const { return allowed_; }
  /// As Cone::bits(), with the values after the stretch.
  const std::vector<StateBit>& bits() const { return bits_; }
  /// Every comparison is of clocks alone, which grow at one rate: it cannot
  /// flip twice, so a stretch is what one long scan is.
  bool exact() const { return exact_; }

 private:
  void add_leaves();
  Word grown_word(std::uint32_t state);
  Word leaf_word(std::int64_t high);
  void visit(ExprId term);
  void stretch_term(ExprId id, const Expr& e);
  void compare(ExprId id, const Expr& e);
  bool is_plain(ExprId id) const;
  const Word& stretched(ExprId id);
  bool depends(ExprId id) const { return stretched_.count(id) != 0; }
  Word stretched_word(const Expr& e);
  void finish();

  Cone* cone_;
  bool useful_ = false;
  bool exact_ = true;
  AigLit taken_ = kAigFalse;
  Word delta_;
  Word scans_;
  AigLit allowed_ = kAigTrue;
  AigLit same_ = kAigTrue;  // no comparison flips
  std::vector<StateBit> bits_;
  /// Values in the last scan of the stretch, of the terms that differ there.
  std::unordered_map<ExprId, Word> stretched_;
  std::unordered_map<ExprId, std::uint32_t> grown_;  // growth term: its state
  std::unordered_set<ExprId> plain_;  // a clock's value, or a choice
  std::unordered_map<ExprId, bool> seen_;
  std::vector<ExprId> stack_;
};

}  // namespace rung
