#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "analysis/transition_system.h"
#include "base/diagnostic.h"

namespace rung {

using ObligationId = Id<struct ObligationTag>;

enum class Goal : std::uint8_t {
  Invariant,  // `condition` holds at the end of every scan
  Reach,      // `condition` holds at the end of some scan of some run
  Recover,    // from every reachable state some run leads to such a scan
  Respond,    // every fair run goes through such scans again and again
};

std::string_view to_string(Goal goal);

/// One thing to be decided. `latch` lines give several.
///
/// Invariant: for a property whose text is an implication (or a bounded
/// response ...) `trigger` is its left side at a scan's end: when it can never
/// hold, a proof is vacuous. Respond: the fairness, where some is given: only
/// runs on which `trigger` is true again and again are considered.
struct Obligation {
  std::string name;       // "NAME", "NAME.holds", "interlock@12"
  std::string_view kind;  // "always", "never", "interlock", "latch", "reach",
                          // "recoverable", "after", "for", "only-after",
                          // "settles", "eventually", "built-in"
  std::string text;       // the property line, or what a built-in one says
  SourceRange where;
  Goal goal = Goal::Invariant;
  ExprId condition;
  ExprId trigger;  // no value: nothing can make it vacuous
  /// How the simulator re-decides it on a trace; see property.h.
  std::uint32_t property = 0;
  std::uint32_t part = 0;
  bool built_in = false;
};

}  // namespace rung
