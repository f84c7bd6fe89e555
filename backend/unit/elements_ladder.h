#pragma once

#include <memory>
#include <string>

#include "backend/unit/builder.h"

namespace rung::backend {

/// The timers that a ladder language has. Edges and latches are relays there,
/// counters are refused.
struct LadderTimers {
  /// The element that its reader makes of them: "ton" or "timer-melsec".
  std::string_view on_delay;
  /// TOF and TP as well; else an off-delay is an on-delay of its absence.
  bool all_of_iec = false;
  bool plain_input = false;  // one contact
  bool one_call = false;     // a timer stands in one place
  /// Why this preset cannot be; empty: it can.
  std::string (*refuse)(std::int64_t milliseconds) = nullptr;
};

std::unique_ptr<Elements> ladder_elements(const LadderTimers& timers,
                                          std::string_view language);

}  // namespace rung::backend
