#pragma once

#include <array>

#include "analysis/element.h"

namespace rung {

/// Timers and counters of the FX family: rows of element_kinds(). `OUT` is the
/// coil, `RST` the reset instruction; both give the contact as they leave it.
///
/// The contact is looked at where the coil is executed, from the second
/// execution on in which it is driven: a timer of K0 is on in the next scan.
/// While `RST` is driven the device is held: it neither times nor counts.
namespace melsec {

using enum ParameterKind;

inline constexpr std::array<ElementParameter, 3> kTimerParameters = {
    {{"n", Index}, {"v", Bit}, {"K", Seconds}}};
inline constexpr std::array<ElementParameter, 2> kResetParameters = {
    {{"n", Index}, {"v", Bit}}};

inline constexpr std::array<ElementState, 4> kTimerStates = {{
    {.name = "held", .type = StateType::Bit},
    {.name = "on", .type = StateType::Bit},
    {.name = "out", .type = StateType::Bit},
    {.name = "elapsed", .type = StateType::Clock, .running = "on"},
}};
inline constexpr std::array<ElementUpdate, 3> kTimerStep = {{
    {"elapsed", "v && on ? elapsed : 0"},
    {"out", "v && on && elapsed' >= p"},
    {"on", "v && !held"},
}};
inline constexpr std::array<ElementUpdate, 4> kTimerReset = {{
    {"held", "v"},
    {"elapsed", "v ? 0 : elapsed"},
    {"out", "out && !v"},
    {"on", "on && !v"},
}};
inline constexpr std::array<ElementOperation, 2> kTimerOperations = {{
    {.name = "OUT.T",
     .parameters = kTimerParameters,
     .updates = kTimerStep,
     .result = "out'"},
    {.name = "RST.T",
     .parameters = kResetParameters,
     .updates = kTimerReset,
     .result = "out'",
     .resets = true},
}};

inline constexpr std::array<ElementUpdate, 2> kRetentiveStep = {{
    {"out", "out || v && on && elapsed >= p"},
    {"on", "v && !held"},
}};
inline constexpr std::array<ElementOperation, 2> kRetentiveOperations = {{
    {.name = "OUT.TR",
     .parameters = kTimerParameters,
     .updates = kRetentiveStep,
     .result = "out'"},
    {.name = "RST.TR",
     .parameters = kResetParameters,
     .updates = kTimerReset,
     .result = "out'",
     .resets = true},
}};

inline constexpr std::array<ElementState, 4> kCounterStates = {{
    {.name = "held", .type = StateType::Bit},
    {.name = "last", .type = StateType::Bit},
    {.name = "out", .type = StateType::Bit},
    {.name = "value", .type = StateType::Count, .low = "0", .high = "p"},
}};
inline constexpr std::array<ElementParameter, 3> kCounterParameters = {
    {{"n", Index}, {"v", Bit}, {"K", Count}}};
inline constexpr std::array<ElementUpdate, 3> kCounterStep = {{
    {"value", "v && !last && !held && value < p ? value + 1 : value"},
    {"out", "out || !held && value' >= p"},
    {"last", "v"},
}};
inline constexpr std::array<ElementUpdate, 3> kCounterReset = {{
    {"held", "v"},
    {"value", "v ? 0 : value"},
    {"out", "out && !v"},
}};
inline constexpr std::array<ElementParameter, 1> kReadParameters = {
    {{"n", Index}}};
inline constexpr std::array<ElementOperation, 3> kCounterOperations = {{
    {.name = "OUT.C",
     .parameters = kCounterParameters,
     .updates = kCounterStep,
     .result = "out'"},
    {.name = "RST.C",
     .parameters = kResetParameters,
     .updates = kCounterReset,
     .result = "out'",
     .resets = true},
    {.name = "C.VALUE",
     .parameters = kReadParameters,
     .result = "value",
     .reads = true,
     .word = true},
}};

inline constexpr std::array<ElementKind, 3> kKinds = {{
    {.id = "timer-melsec",
     .letter = "T",
     .dialect = "melsec",
     .family = ElementFamily::Timer,
     .summary =
         "On-delay timer: times while its coil is driven, and is cleared "
         "by an execution in which it is not.",
     .source = "FX3 programming manual, sections 4.5 and 7.13",
     .states = kTimerStates,
     .operations = kTimerOperations,
     .done = "out",
     .value = "elapsed"},
    {.id = "timer-retentive-melsec",
     .letter = "T",
     .dialect = "melsec",
     .family = ElementFamily::Timer,
     .summary = "Retentive timer: keeps its time while its coil is not driven; "
                "only RST clears it.",
     .source = "FX3 programming manual, sections 4.5 and 7.13",
     .states = kTimerStates,
     .operations = kRetentiveOperations,
     .done = "out",
     .value = "elapsed",
     .keeps = true},
    {.id = "counter-melsec",
     .letter = "C",
     .dialect = "melsec",
     .family = ElementFamily::Counter,
     .summary = "Up-counter: counts rising edges of its coil up to the preset "
                "and stays there; only RST clears it.",
     .source = "FX3 programming manual, sections 4.6 and 7.13",
     .states = kCounterStates,
     .operations = kCounterOperations,
     .done = "out",
     .value = "value"},
}};

}  // namespace melsec
}  // namespace rung
