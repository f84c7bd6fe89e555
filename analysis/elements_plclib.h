#pragma once

#include <array>

#include "analysis/element.h"

namespace rung {

/// The timers of plcLib sketches, and the tasks of ARTe: rows of
/// element_kinds().
///
/// A timer is a variable of the sketch, `unsigned long`: 0 while it is idle,
/// else millis() at its start. `started` says that it is not 0. The wrap of
/// millis() after 49.7 days is not modelled, nor is its value 0 in the first
/// millisecond.
namespace plclib {

using enum ParameterKind;

inline constexpr std::array<ElementParameter, 3> kTimerParameters = {
    {{"n", Index}, {"v", Bit}, {"p", Seconds}}};

inline constexpr std::array<ElementState, 2> kTimerStates = {{
    {.name = "started", .type = StateType::Bit},
    {.name = "elapsed", .type = StateType::Clock, .running = "started"},
}};

// The scan that starts an on-delay gives false, whatever the preset is.
inline constexpr std::array<ElementUpdate, 3> kOnDelayStep = {{
    {"was", "v && started"},
    {"elapsed", "was ? elapsed : 0"},
    {"started", "v"},
}};
// An off-delay's variable is never cleared.
inline constexpr std::array<ElementUpdate, 2> kOffDelayStep = {{
    {"elapsed", "v ? 0 : elapsed"},
    {"started", "started || v"},
}};
inline constexpr std::array<ElementUpdate, 4> kPulseStep = {{
    {"q", "started ? elapsed < p : v"},
    {"ends", "started && elapsed >= p && !v"},
    {"elapsed", "started && !ends ? elapsed : 0"},
    {"started", "(started || v) && !ends"},
}};

inline constexpr std::array<ElementOperation, 2> kThesisOperations = {{
    {.name = "timerDelay",
     .parameters = kTimerParameters,
     .updates = kOnDelayStep,
     .result = "was && elapsed' > p",
     .rounding = SecondsRounding::Floor},
    {.name = "timerOn",
     .parameters = kTimerParameters,
     .updates = kOffDelayStep,
     .result = "v || started && elapsed <= p",
     .rounding = SecondsRounding::Floor},
}};
inline constexpr std::array<ElementOperation, 3> kPublishedOperations = {{
    {.name = "timerOn",
     .parameters = kTimerParameters,
     .updates = kOnDelayStep,
     .result = "was && elapsed' >= p"},
    {.name = "timerOff",
     .parameters = kTimerParameters,
     .updates = kOffDelayStep,
     .result = "v || started && elapsed < p"},
    {.name = "timerPulse",
     .parameters = kTimerParameters,
     .updates = kPulseStep,
     .result = "q"},
}};

// --- a pair of variables that makes a cycle ----------------------------------

// (T1, T2) is (0, 0) at first, then (1, 0): armed, (t, 0): first, (0, 1): turn,
// (0, t): second. In (0, 0) the time since power-up is compared.
inline constexpr std::array<ElementState, 5> kCycleStates = {{
    {.name = "armed", .type = StateType::Bit},
    {.name = "first", .type = StateType::Bit},
    {.name = "turn", .type = StateType::Bit},
    {.name = "second", .type = StateType::Bit},
    {.name = "elapsed", .type = StateType::Clock, .running = "!armed && !turn"},
}};
// The call is executed in two halves: each looks at its own variable. The first
// one clears the state where the input is false; nothing else uses it.
inline constexpr std::array<ElementUpdate, 7> kFirstHalf = {{
    {"over", "v && !armed && !turn && !second && elapsed >= p"},
    {"start", "v && armed"},
    {"elapsed", "start || !v ? 0 : elapsed"},
    {"first", "v && (start || first && !over)"},
    {"turn", "v && (turn || over)"},
    {"second", "v && second"},
    {"armed", "!v"},
}};
inline constexpr std::array<ElementUpdate, 7> kSecondHalf = {{
    {"active", "v && !armed && !first"},
    {"start", "active && turn"},
    {"over", "active && !turn && elapsed >= p"},
    {"elapsed", "start || over ? 0 : elapsed"},
    {"second", "start || second && !over"},
    {"armed", "armed || over"},
    {"turn", "turn && !active"},
}};

inline constexpr std::array<ElementOperation, 2> kPulseOperations = {{
    {.name = "m8013.first",
     .parameters = kTimerParameters,
     .updates = kFirstHalf,
     .result = "v && !turn && !second",
     .resets = true},
    {.name = "m8013.second",
     .parameters = kTimerParameters,
     .updates = kSecondHalf,
     .result = "v && !active"},
}};
inline constexpr std::array<ElementOperation, 2> kCycleOperations = {{
    {.name = "timerCycle.first",
     .parameters = kTimerParameters,
     .updates = kFirstHalf,
     .result = "v && !turn && !second",
     .resets = true},
    {.name = "timerCycle.second",
     .parameters = kTimerParameters,
     .updates = kSecondHalf,
     .result = "active"},
}};

// --- tasks -------------------------------------------------------------------

// A run may stand anywhere in its scan, so two runs whose scans begin `elapsed`
// apart are up to `longest`, the longest scan, further apart.
inline constexpr std::array<ElementState, 2> kTaskStates = {{
    {.name = "ran", .type = StateType::Bit},
    {.name = "elapsed", .type = StateType::Clock, .running = "ran"},
}};
inline constexpr std::array<ElementUpdate, 3> kTaskStep = {{
    {"runs", "v && (!ran || elapsed + longest > p)"},
    {"elapsed", "runs ? 0 : elapsed"},
    {"ran", "ran || runs"},
}};
inline constexpr std::array<ElementOperation, 1> kTaskOperations = {{
    {.name = "runs",
     .parameters = kTimerParameters,
     .updates = kTaskStep,
     .result = "runs"},
}};

inline constexpr std::string_view kThesis =
    "PLC on an Arduino Due with plcLib and ARTe, 2018, appendix";
inline constexpr std::string_view kPublished = "plcLib 1.4, plcLib.cpp";

inline constexpr std::array<ElementKind, 5> kKinds = {{
    {.id = "timer-plclib",
     .letter = "timer",
     .dialect = "plclib",
     .family = ElementFamily::Timer,
     .summary = "A timer's variable of the thesis's library: `timerDelay` is "
                "an on-delay, `timerOn` an off-delay.",
     .source = kThesis,
     .states = kTimerStates,
     .operations = kThesisOperations,
     .done = "started && elapsed > p",
     .value = "elapsed"},
    {.id = "timer-plclib14",
     .letter = "timer",
     .dialect = "plclib14",
     .family = ElementFamily::Timer,
     .summary = "A timer's variable of the published library: `timerOn` is an "
                "on-delay, `timerOff` an off-delay, `timerPulse` a pulse.",
     .source = kPublished,
     .states = kTimerStates,
     .operations = kPublishedOperations,
     .done = "started && elapsed >= p",
     .value = "elapsed"},
    {.id = "cycle-plclib",
     .letter = "cycle",
     .dialect = "plclib",
     .family = ElementFamily::Timer,
     .summary = "The pair of variables of `m8013`: one second on, one second "
                "off while its input is true.",
     .source = kThesis,
     .states = kCycleStates,
     .operations = kPulseOperations},
    {.id = "cycle-plclib14",
     .letter = "cycle",
     .dialect = "plclib14",
     .family = ElementFamily::Timer,
     .summary = "The pair of variables of `timerCycle`: low for the first "
                "period, high for the second.",
     .source = kPublished,
     .states = kCycleStates,
     .operations = kCycleOperations},
    {.id = "task-plclib",
     .letter = "task",
     .dialect = "plclib plclib14",
     .family = ElementFamily::Edge,
     .summary = "A periodic task: it may run where `v` says so, but not again "
                "before its period can have passed.",
     .source = "ARTe: loopN(period)",
     .states = kTaskStates,
     .operations = kTaskOperations},
}};

}  // namespace plclib
}  // namespace rung
