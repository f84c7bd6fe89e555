#pragma once

#include <array>

#include "analysis/element.h"

namespace rung {

/// The timers of LDmicro: rows of element_kinds().
///
/// LDmicro counts executions, one a scan of a fixed length. Here the clock does
/// that: `p` is the length of the counted scans, so with the fixed length both
/// are the same. The scan that starts the clock is not counted yet.
namespace ldmicro_elements {

using enum ParameterKind;

inline constexpr std::array<ElementParameter, 3> kTimerParameters = {
    {{"n", Index}, {"IN", Bit}, {"P", Seconds}}};
inline constexpr std::array<ElementParameter, 2> kResetParameters = {
    {{"n", Index}, {"v", Bit}}};

inline constexpr std::array<ElementState, 2> kOnStates = {{
    {.name = "on", .type = StateType::Bit},
    {.name = "elapsed", .type = StateType::Clock, .running = "on"},
}};
inline constexpr std::array<ElementUpdate, 2> kOnStep = {{
    {"elapsed", "IN ? elapsed : 0"},
    {"on", "IN"},
}};
inline constexpr std::array<ElementUpdate, 2> kOnReset = {{
    {"elapsed", "v ? 0 : elapsed"},
    {"on", "on && !v"},
}};
inline constexpr std::array<ElementOperation, 2> kOnOperations = {{
    {.name = "TON",
     .parameters = kTimerParameters,
     .updates = kOnStep,
     .result = "IN && elapsed' >= p"},
    {.name = "TON.RES",
     .parameters = kResetParameters,
     .updates = kOnReset,
     .result = "v",
     .resets = true},
}};

// A reset makes an off-delay timer count again, as if its input had just been
// true.
inline constexpr std::array<ElementState, 3> kOffStates = {{
    {.name = "on", .type = StateType::Bit},
    {.name = "fallen", .type = StateType::Bit},
    {.name = "elapsed", .type = StateType::Clock, .running = "fallen"},
}};
inline constexpr std::array<ElementUpdate, 3> kOffStep = {{
    {"elapsed", "IN ? 0 : elapsed"},
    {"fallen", "!IN && (on || fallen)"},
    {"on", "IN"},
}};
inline constexpr std::array<ElementUpdate, 3> kOffReset = {{
    {"elapsed", "v ? 0 : elapsed"},
    {"fallen", "fallen && !v"},
    {"on", "on || v"},
}};
inline constexpr std::array<ElementOperation, 2> kOffOperations = {{
    {.name = "TOF",
     .parameters = kTimerParameters,
     .updates = kOffStep,
     .result = "IN || fallen' && elapsed' < p"},
    {.name = "TOF.RES",
     .parameters = kResetParameters,
     .updates = kOffReset,
     .result = "v",
     .resets = true},
}};

inline constexpr std::array<ElementUpdate, 1> kRetentiveStep = {{
    {"on", "IN"},
}};
inline constexpr std::array<ElementOperation, 2> kRetentiveOperations = {{
    {.name = "RTO",
     .parameters = kTimerParameters,
     .updates = kRetentiveStep,
     .result = "elapsed >= p"},
    {.name = "RTO.RES",
     .parameters = kResetParameters,
     .updates = kOnReset,
     .result = "v",
     .resets = true},
}};

inline constexpr std::array<ElementKind, 3> kKinds = {{
    {.id = "ton-ldmicro",
     .letter = "TON",
     .dialect = "ldmicro",
     .family = ElementFamily::Timer,
     .summary = "On-delay timer: true when its input was true in the P "
                "executions before and is; RES makes it start again.",
     .source = "LDmicro, intcode.cpp, ELEM_TON and ELEM_RES",
     .states = kOnStates,
     .operations = kOnOperations,
     .done = "on && elapsed >= p",
     .value = "elapsed"},
    {.id = "tof-ldmicro",
     .letter = "TOF",
     .dialect = "ldmicro",
     .family = ElementFamily::Timer,
     .summary = "Off-delay timer: true while its input is, and for P "
                "executions after it; RES makes it true for P executions.",
     .source = "LDmicro, intcode.cpp, ELEM_TOF and ELEM_RES",
     .states = kOffStates,
     .operations = kOffOperations,
     .done = "on || fallen && elapsed < p",
     .value = "elapsed"},
    {.id = "rto-ldmicro",
     .letter = "RTO",
     .dialect = "ldmicro",
     .family = ElementFamily::Timer,
     .summary = "Retentive timer: true, whatever its input is, when its input "
                "was true in P executions since RES.",
     .source = "LDmicro, intcode.cpp, ELEM_RTO and ELEM_RES",
     .states = kOnStates,
     .operations = kRetentiveOperations,
     .done = "elapsed >= p",
     .value = "elapsed",
     .keeps = true},
}};

}  // namespace ldmicro_elements
}  // namespace rung
