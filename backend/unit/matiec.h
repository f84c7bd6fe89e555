#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "backend/unit/builder.h"

namespace rung::backend {

/// Function blocks of matiec (OpenPLC, Beremiz) in the place of others, or the
/// other way round. Its timers are those of the standard but for a preset of 0,
/// and where one timer has several presets; its counters stop at PV and at 0.

/// How the states of a timer and those of matiec's relate; `other` is the kind
/// of the first: "timer-sim", "timer-off-sim", "ton", "tof" or "tp".
void relate_matiec_timer(UnitBuilder& builder, const std::string& instance,
                         std::string_view other, bool matiec_is_source,
                         std::int64_t preset);

/// Of an off-delay of the sim dialect with several presets: one timer has the
/// largest, and the variable `kept_out` holds the output.
void relate_matiec_off_delays(UnitBuilder& builder, const std::string& instance,
                              const std::string& kept_out);

/// The same for CTU (with its PV) and CTD.
void relate_matiec_counter(UnitBuilder& builder, const std::string& instance,
                           bool down, bool matiec_is_source, std::int64_t pv);

}  // namespace rung::backend
