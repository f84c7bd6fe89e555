#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>

#include "backend/unit/builder.h"

namespace rung::backend {

/// What a ladder language has. Edges and latches are relays there.
struct LadderBlocks {
  bool off_delay = false;  // TOF; else the on-delay of its absence
  bool pulse = false;      // TP
  /// Counters: CTU and RES for those of the yun dialect, numbers for others.
  bool counters = false;
  bool resets = false;       // a timer is reset by RES, and not by a call
  bool plain_input = false;  // one contact
  bool one_call = false;     // a block stands in one place
  /// Why this preset cannot be; empty: it can.
  std::function<std::string(std::int64_t milliseconds)> refuse;
};

std::unique_ptr<Elements> ladder_elements(LadderBlocks blocks,
                                          std::string_view language);

}  // namespace rung::backend
