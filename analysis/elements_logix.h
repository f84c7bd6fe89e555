#pragma once

#include <array>

#include "analysis/element.h"

namespace rung {

/// The timers of Logix controllers: rows of element_kinds(). The result of an
/// operation is the timer's DN bit.
namespace logix {

using enum ParameterKind;

inline constexpr std::array<ElementParameter, 3> kTimerParameters = {
    {{"n", Index}, {"IN", Bit}, {"PRE", Seconds}}};
inline constexpr std::array<ElementParameter, 2> kResetParameters = {
    {{"n", Index}, {"v", Bit}}};

// The execution that sets EN looks at no time yet.
inline constexpr std::array<ElementState, 2> kOnStates = {{
    {.name = "EN", .type = StateType::Bit},
    {.name = "elapsed", .type = StateType::Clock, .running = "EN"},
}};
inline constexpr std::array<ElementUpdate, 3> kOnStep = {{
    {"elapsed", "IN ? elapsed : 0"},
    {"DN", "IN && EN && elapsed' >= p"},
    {"EN", "IN"},
}};
inline constexpr std::array<ElementUpdate, 2> kOnReset = {{
    {"elapsed", "v ? 0 : elapsed"},
    {"EN", "EN && !v"},
}};
inline constexpr std::array<ElementOperation, 2> kOnOperations = {{
    {.name = "TON",
     .parameters = kTimerParameters,
     .updates = kOnStep,
     .result = "DN"},
    {.name = "TON.RES",
     .parameters = kResetParameters,
     .updates = kOnReset,
     .result = "v",
     .resets = true},
}};

inline constexpr std::array<ElementState, 3> kOffStates = {{
    {.name = "EN", .type = StateType::Bit},
    {.name = "fallen", .type = StateType::Bit},
    {.name = "elapsed", .type = StateType::Clock, .running = "fallen"},
}};
inline constexpr std::array<ElementUpdate, 3> kOffStep = {{
    {"elapsed", "IN ? 0 : elapsed"},
    {"fallen", "!IN && (EN || fallen)"},
    {"EN", "IN"},
}};
inline constexpr std::array<ElementOperation, 1> kOffOperations = {{
    {.name = "TOF",
     .parameters = kTimerParameters,
     .updates = kOffStep,
     .result = "IN || fallen' && elapsed' < p"},
}};

// ACC grows in executions with EN only: what passes before the execution that
// clears EN is not counted. `lap` is the time since the last execution.
inline constexpr std::array<ElementState, 4> kRetentiveStates = {{
    {.name = "EN", .type = StateType::Bit},
    {.name = "DN", .type = StateType::Bit},
    {.name = "ACC", .type = StateType::Count, .low = "0", .high = "p"},
    {.name = "lap", .type = StateType::Clock, .running = "EN"},
}};
inline constexpr std::array<ElementUpdate, 4> kRetentiveStep = {{
    {"ACC", "!IN || !EN ? ACC : ACC + lap < p ? ACC + lap : p"},
    {"DN", "DN || IN && EN && ACC' >= p"},
    {"lap", "0"},
    {"EN", "IN"},
}};
inline constexpr std::array<ElementUpdate, 3> kRetentiveReset = {{
    {"ACC", "v ? 0 : ACC"},
    {"DN", "DN && !v"},
    {"EN", "EN && !v"},
}};
inline constexpr std::array<ElementOperation, 2> kRetentiveOperations = {{
    {.name = "RTO",
     .parameters = kTimerParameters,
     .updates = kRetentiveStep,
     .result = "DN'"},
    {.name = "RTO.RES",
     .parameters = kResetParameters,
     .updates = kRetentiveReset,
     .result = "v",
     .resets = true},
}};

// The prescan sets CU and CD, so that a rung that is true at once is no edge:
// `up` and `down` are their negations. ACC goes round at its ends.
inline constexpr std::array<ElementState, 3> kCounterStates = {{
    {.name = "ACC",
     .type = StateType::Count,
     .low = "-2147483648",
     .high = "2147483647"},
    {.name = "up", .type = StateType::Bit},
    {.name = "down", .type = StateType::Bit},
}};
inline constexpr std::array<ElementParameter, 3> kCounterParameters = {
    {{"n", Index}, {"IN", Bit}, {"PRE", Count}}};
inline constexpr std::array<ElementParameter, 1> kReadParameters = {
    {{"n", Index}}};
inline constexpr std::array<ElementUpdate, 2> kUpStep = {{
    {"ACC", "!IN || !up ? ACC : ACC < 2147483647 ? ACC + 1 : -2147483648"},
    {"up", "!IN"},
}};
inline constexpr std::array<ElementUpdate, 2> kDownStep = {{
    {"ACC", "!IN || !down ? ACC : ACC > -2147483648 ? ACC - 1 : 2147483647"},
    {"down", "!IN"},
}};
inline constexpr std::array<ElementUpdate, 3> kCounterReset = {{
    {"ACC", "v ? 0 : ACC"},
    {"up", "up || v"},
    {"down", "down || v"},
}};
inline constexpr std::array<ElementOperation, 4> kCounterOperations = {{
    {.name = "CTU",
     .parameters = kCounterParameters,
     .updates = kUpStep,
     .result = "ACC' >= p"},
    {.name = "CTD",
     .parameters = kCounterParameters,
     .updates = kDownStep,
     .result = "ACC' >= p"},
    {.name = "CTU.ACC",
     .parameters = kReadParameters,
     .result = "ACC",
     .reads = true,
     .word = true},
    {.name = "CTU.RES",
     .parameters = kResetParameters,
     .updates = kCounterReset,
     .result = "v",
     .resets = true},
}};

inline constexpr std::array<ElementKind, 4> kKinds = {{
    {.id = "ton-logix",
     .letter = "TON",
     .dialect = "logix",
     .family = ElementFamily::Timer,
     .summary = "On-delay timer: the first true execution sets EN, DN is true "
                "when PRE has passed since then.",
     .source = "Logix 5000 General Instructions, 1756-RM003, TON and RES",
     .states = kOnStates,
     .operations = kOnOperations,
     .done = "EN && elapsed >= p",
     .value = "elapsed"},
    {.id = "tof-logix",
     .letter = "TOF",
     .dialect = "logix",
     .family = ElementFamily::Timer,
     .summary = "Off-delay timer: DN is true while the rung is, and for PRE "
                "after it.",
     .source = "Logix 5000 General Instructions, 1756-RM003, TOF",
     .states = kOffStates,
     .operations = kOffOperations,
     .done = "EN || fallen && elapsed < p",
     .value = "elapsed"},
    {.id = "rto-logix",
     .letter = "RTO",
     .dialect = "logix",
     .family = ElementFamily::Timer,
     .summary = "Retentive timer: ACC grows while the rung is true and stays; "
                "DN is true from PRE to RES.",
     .source = "Logix 5000 General Instructions, 1756-RM003, RTO and RES",
     .states = kRetentiveStates,
     .operations = kRetentiveOperations,
     .done = "DN",
     .value = "ACC",
     .keeps = true},
    {.id = "counter-logix",
     .letter = "CTU",
     .dialect = "logix",
     .family = ElementFamily::Counter,
     .summary = "Counts rising edges up and down, also past its preset, and "
                "from one end of 32 bits to the other; RES clears it, and a "
                "rung that is true then counts again.",
     .source = "Logix 5000 General Instructions, 1756-RM003, CTU, CTD and RES",
     .states = kCounterStates,
     .operations = kCounterOperations,
     .done = "ACC >= p",
     .value = "ACC"},
}};

}  // namespace logix
}  // namespace rung
