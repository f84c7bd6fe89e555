#pragma once

#include <array>

#include "analysis/element.h"

namespace rung {

/// The timers and counters of S7-300 and S7-400: rows of element_kinds(). What
/// starts a timer is its kind. An operation with `.Q` looks at the status,
/// `.R` is the instruction R.
namespace s7 {

using enum ParameterKind;

// --- timers ------------------------------------------------------------------

inline constexpr std::array<ElementParameter, 3> kTimerParameters = {
    {{"n", Index}, {"v", Bit}, {"TV", Seconds}}};
inline constexpr std::array<ElementParameter, 2> kStatusParameters = {
    {{"n", Index}, {"TV", Seconds}}};
inline constexpr std::array<ElementParameter, 2> kResetParameters = {
    {{"n", Index}, {"v", Bit}}};

inline constexpr std::array<ElementState, 3> kTimerStates = {{
    {.name = "last", .type = StateType::Bit},
    {.name = "timing", .type = StateType::Bit},
    {.name = "elapsed", .type = StateType::Clock, .running = "timing"},
}};
inline constexpr std::array<ElementUpdate, 2> kTimerReset = {{
    {"timing", "timing && !v"},
    {"elapsed", "v ? 0 : elapsed"},
}};

// A pulse ends with its input, an extended one does not.
inline constexpr std::array<ElementUpdate, 3> kPulseStep = {{
    {"elapsed", "v && last ? elapsed : 0"},
    {"timing", "v && (timing || !last)"},
    {"last", "v"},
}};
inline constexpr std::array<ElementUpdate, 3> kExtendedStep = {{
    {"elapsed", "v && !last ? 0 : elapsed"},
    {"timing", "timing || v && !last"},
    {"last", "v"},
}};
inline constexpr std::string_view kPulseStatus = "timing && elapsed < p";
inline constexpr std::string_view kPulseResult = "timing' && elapsed' < p";
inline constexpr std::string_view kDelayStatus = "timing && elapsed >= p";
inline constexpr std::string_view kDelayResult = "timing' && elapsed' >= p";

inline constexpr std::array<ElementOperation, 3> kPulseOperations = {{
    {.name = "SI",
     .parameters = kTimerParameters,
     .updates = kPulseStep,
     .result = kPulseResult},
    {.name = "SI.Q",
     .parameters = kStatusParameters,
     .result = kPulseStatus,
     .reads = true},
    {.name = "SI.R",
     .parameters = kResetParameters,
     .updates = kTimerReset,
     .result = "v",
     .resets = true},
}};
inline constexpr std::array<ElementOperation, 3> kExtendedOperations = {{
    {.name = "SV",
     .parameters = kTimerParameters,
     .updates = kExtendedStep,
     .result = kPulseResult},
    {.name = "SV.Q",
     .parameters = kStatusParameters,
     .result = kPulseStatus,
     .reads = true},
    {.name = "SV.R",
     .parameters = kResetParameters,
     .updates = kTimerReset,
     .result = "v",
     .resets = true},
}};
inline constexpr std::array<ElementOperation, 3> kDelayOperations = {{
    {.name = "SE",
     .parameters = kTimerParameters,
     .updates = kPulseStep,
     .result = kDelayResult},
    {.name = "SE.Q",
     .parameters = kStatusParameters,
     .result = kDelayStatus,
     .reads = true},
    {.name = "SE.R",
     .parameters = kResetParameters,
     .updates = kTimerReset,
     .result = "v",
     .resets = true},
}};

// A stored delay keeps its status when a later edge starts it anew.
inline constexpr std::array<ElementState, 4> kStoredStates = {{
    {.name = "last", .type = StateType::Bit},
    {.name = "timing", .type = StateType::Bit},
    {.name = "out", .type = StateType::Bit},
    {.name = "elapsed", .type = StateType::Clock, .running = "timing"},
}};
inline constexpr std::array<ElementUpdate, 4> kStoredStep = {{
    {"out", "out || timing && elapsed >= p"},
    {"elapsed", "v && !last ? 0 : elapsed"},
    {"timing", "timing || v && !last"},
    {"last", "v"},
}};
inline constexpr std::array<ElementUpdate, 3> kStoredReset = {{
    {"out", "out && !v"},
    {"timing", "timing && !v"},
    {"elapsed", "v ? 0 : elapsed"},
}};
inline constexpr std::array<ElementOperation, 3> kStoredOperations = {{
    {.name = "SS",
     .parameters = kTimerParameters,
     .updates = kStoredStep,
     .result = "out' || timing' && elapsed' >= p"},
    {.name = "SS.Q",
     .parameters = kStatusParameters,
     .result = "out || timing && elapsed >= p",
     .reads = true},
    {.name = "SS.R",
     .parameters = kResetParameters,
     .updates = kStoredReset,
     .result = "v",
     .resets = true},
}};

// An off-delay times from the falling edge on, also after a reset.
inline constexpr std::array<ElementUpdate, 4> kOffStep = {{
    {"out", "out || v && !last || !v && last"},
    {"elapsed", "v ? 0 : elapsed"},
    {"timing", "!v && (timing || last)"},
    {"last", "v"},
}};
inline constexpr std::array<ElementOperation, 3> kOffOperations = {{
    {.name = "SA",
     .parameters = kTimerParameters,
     .updates = kOffStep,
     .result = "out' && !(timing' && elapsed' >= p)"},
    {.name = "SA.Q",
     .parameters = kStatusParameters,
     .result = "out && !(timing && elapsed >= p)",
     .reads = true},
    {.name = "SA.R",
     .parameters = kResetParameters,
     .updates = kStoredReset,
     .result = "v",
     .resets = true},
}};

// --- counter -----------------------------------------------------------------

inline constexpr std::array<ElementState, 5> kCounterStates = {{
    {.name = "last_up", .type = StateType::Bit},
    {.name = "last_down", .type = StateType::Bit},
    {.name = "last_set", .type = StateType::Bit},
    {.name = "last_free", .type = StateType::Bit},
    {.name = "value",
     .type = StateType::Count,
     .low = "-32768",
     .high = "32767"},
}};
inline constexpr std::array<ElementParameter, 3> kSetParameters = {
    {{"n", Index}, {"v", Bit}, {"PV", ParameterKind::Word}}};
inline constexpr std::array<ElementParameter, 1> kReadParameters = {
    {{"n", Index}}};
inline constexpr std::array<ElementUpdate, 2> kUpStep = {{
    {"value", "v && !last_up && value < 999 ? value + 1 : value"},
    {"last_up", "v"},
}};
inline constexpr std::array<ElementUpdate, 2> kDownStep = {{
    {"value", "v && !last_down && value > 0 ? value - 1 : value"},
    {"last_down", "v"},
}};
// That PV is 0 to 999 is the reader's business: it is a constant or checked.
inline constexpr std::array<ElementUpdate, 2> kSetStep = {{
    {"value", "v && !last_set ? PV : value"},
    {"last_set", "v"},
}};
inline constexpr std::array<ElementUpdate, 1> kClearStep = {{
    {"value", "v ? 0 : value"},
}};
inline constexpr std::array<ElementUpdate, 4> kFreeStep = {{
    {"last_up", "last_up && !(v && !last_free)"},
    {"last_down", "last_down && !(v && !last_free)"},
    {"last_set", "last_set && !(v && !last_free)"},
    {"last_free", "v"},
}};
inline constexpr std::array<ElementOperation, 7> kCounterOperations = {{
    {.name = "Z.UP",
     .parameters = kResetParameters,
     .updates = kUpStep,
     .result = "value' > 0"},
    {.name = "Z.DOWN",
     .parameters = kResetParameters,
     .updates = kDownStep,
     .result = "value' > 0"},
    {.name = "Z.S",
     .parameters = kSetParameters,
     .updates = kSetStep,
     .result = "value' > 0"},
    {.name = "Z.R",
     .parameters = kResetParameters,
     .updates = kClearStep,
     .result = "v",
     .resets = true},
    {.name = "Z.FR",
     .parameters = kResetParameters,
     .updates = kFreeStep,
     .result = "value > 0"},
    {.name = "Z.Q",
     .parameters = kReadParameters,
     .result = "value > 0",
     .reads = true},
    {.name = "Z.VALUE",
     .parameters = kReadParameters,
     .result = "value",
     .reads = true,
     .word = true},
}};

inline constexpr std::string_view kSource =
    "Statement List for S7-300 and S7-400, timer and counter instructions; "
    "awlsim, timers and counters";

inline constexpr std::array<ElementKind, 6> kKinds = {{
    {.id = "pulse-s7",
     .letter = "T",
     .dialect = "s7",
     .family = ElementFamily::Timer,
     .summary = "SI, pulse: on from a rising edge for the time, or until the "
                "input goes.",
     .source = kSource,
     .states = kTimerStates,
     .operations = kPulseOperations,
     .done = kPulseStatus,
     .value = "elapsed"},
    {.id = "extended-pulse-s7",
     .letter = "T",
     .dialect = "s7",
     .family = ElementFamily::Timer,
     .summary = "SV, extended pulse: on from a rising edge for the time; each "
                "edge starts it anew.",
     .source = kSource,
     .states = kTimerStates,
     .operations = kExtendedOperations,
     .done = kPulseStatus,
     .value = "elapsed"},
    {.id = "delay-s7",
     .letter = "T",
     .dialect = "s7",
     .family = ElementFamily::Timer,
     .summary = "SE, on-delay: on when the input has been on for the time.",
     .source = kSource,
     .states = kTimerStates,
     .operations = kDelayOperations,
     .done = kDelayStatus,
     .value = "elapsed"},
    {.id = "stored-delay-s7",
     .letter = "T",
     .dialect = "s7",
     .family = ElementFamily::Timer,
     .summary = "SS, stored on-delay: on when the time has passed since the "
                "last rising edge, until R.",
     .source = kSource,
     .states = kStoredStates,
     .operations = kStoredOperations,
     .done = "out || timing && elapsed >= p",
     .value = "elapsed",
     .keeps = true},
    {.id = "off-delay-s7",
     .letter = "T",
     .dialect = "s7",
     .family = ElementFamily::Timer,
     .summary = "SA, off-delay: on with the input, and for the time after it.",
     .source = kSource,
     .states = kStoredStates,
     .operations = kOffOperations,
     .done = "out && !(timing && elapsed >= p)",
     .value = "elapsed"},
    {.id = "counter-s7",
     .letter = "Z",
     .dialect = "s7",
     .family = ElementFamily::Counter,
     .summary = "Counts edges up to 999 and down to 0; its status is on while "
                "the count is not 0.",
     .source = kSource,
     .states = kCounterStates,
     .operations = kCounterOperations,
     .done = "value > 0",
     .value = "value"},
}};

}  // namespace s7
}  // namespace rung
