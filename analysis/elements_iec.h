#pragma once

#include <array>

#include "analysis/element.h"

namespace rung {

/// The standard function blocks of IEC 61131-3, second edition, section 2.5.2:
/// rows of element_kinds(). The operation with the block's own name executes
/// it and gives its first output; `TON.ET` and so on read another output as
/// the last execution left it, and change nothing.
///
/// The standard draws timers as diagrams. Here, as drawn, a timer looks at its
/// clock in every execution, the one that starts it included: with PT = 0 a
/// TON follows IN at once, and TOF and TP have no delay and no pulse.
namespace iec {

using enum ParameterKind;

// --- timers ------------------------------------------------------------------

inline constexpr std::array<ElementParameter, 3> kTimerParameters = {
    {{"n", Index}, {"IN", Bit}, {"PT", Seconds}}};
inline constexpr std::array<ElementParameter, 2> kElapsedParameters = {
    {{"n", Index}, {"PT", Seconds}}};
// While nothing is timed the clock stands at 0.
inline constexpr std::string_view kElapsedTime = "elapsed < p ? elapsed : p";

inline constexpr std::array<ElementState, 2> kOnDelayStates = {{
    {.name = "on", .type = StateType::Bit},
    {.name = "elapsed", .type = StateType::Clock, .running = "on"},
}};
inline constexpr std::array<ElementUpdate, 2> kOnDelayStep = {{
    {"elapsed", "IN ? elapsed : 0"},
    {"on", "IN"},
}};
inline constexpr std::array<ElementOperation, 2> kOnDelayOperations = {{
    {.name = "TON",
     .parameters = kTimerParameters,
     .updates = kOnDelayStep,
     .result = "IN && elapsed' >= p"},
    {.name = "TON.ET",
     .parameters = kElapsedParameters,
     .result = kElapsedTime,
     .reads = true,
     .word = true},
}};

inline constexpr std::array<ElementState, 3> kOffDelayStates = {{
    {.name = "on", .type = StateType::Bit},
    {.name = "fallen", .type = StateType::Bit},
    {.name = "elapsed", .type = StateType::Clock, .running = "fallen"},
}};
inline constexpr std::array<ElementUpdate, 3> kOffDelayStep = {{
    {"elapsed", "IN ? 0 : elapsed"},
    {"fallen", "!IN && (on || fallen)"},
    {"on", "IN"},
}};
inline constexpr std::array<ElementOperation, 2> kOffDelayOperations = {{
    {.name = "TOF",
     .parameters = kTimerParameters,
     .updates = kOffDelayStep,
     .result = "IN || fallen' && elapsed' < p"},
    {.name = "TOF.ET",
     .parameters = kElapsedParameters,
     .result = kElapsedTime,
     .reads = true,
     .word = true},
}};

inline constexpr std::array<ElementState, 2> kPulseStates = {{
    {.name = "started", .type = StateType::Bit},
    {.name = "elapsed", .type = StateType::Clock, .running = "started"},
}};
inline constexpr std::array<ElementUpdate, 4> kPulseStep = {{
    {"started", "started || IN"},
    {"q", "started' && elapsed < p"},
    {"started", "started' && (IN || q)"},
    {"elapsed", "started' ? elapsed : 0"},
}};
inline constexpr std::array<ElementOperation, 2> kPulseOperations = {{
    {.name = "TP",
     .parameters = kTimerParameters,
     .updates = kPulseStep,
     .result = "q"},
    {.name = "TP.ET",
     .parameters = kElapsedParameters,
     .result = kElapsedTime,
     .reads = true,
     .word = true},
}};

// --- counters ----------------------------------------------------------------

// PVmin and PVmax of the standard are those of INT. `out` is the first output.

inline constexpr std::array<ElementParameter, 1> kReadParameters = {
    {{"n", Index}}};

inline constexpr std::array<ElementState, 3> kUpStates = {{
    {.name = "value", .type = StateType::Count, .low = "0", .high = "32767"},
    {.name = "last", .type = StateType::Bit},
    {.name = "out", .type = StateType::Bit},
}};
inline constexpr std::array<ElementParameter, 4> kUpParameters = {
    {{"n", Index}, {"CU", Bit}, {"R", Bit}, {"PV", ParameterKind::Word}}};
inline constexpr std::array<ElementUpdate, 3> kUpStep = {{
    {"value", "R ? 0 : CU && !last && value < 32767 ? value + 1 : value"},
    {"last", "CU"},
    {"out", "value' >= PV"},
}};
inline constexpr std::array<ElementOperation, 2> kUpOperations = {{
    {.name = "CTU",
     .parameters = kUpParameters,
     .updates = kUpStep,
     .result = "out'"},
    {.name = "CTU.CV",
     .parameters = kReadParameters,
     .result = "value",
     .reads = true,
     .word = true},
}};

inline constexpr std::array<ElementState, 3> kDownStates = {{
    {.name = "value",
     .type = StateType::Count,
     .low = "-32768",
     .high = "32767"},
    {.name = "last", .type = StateType::Bit},
    {.name = "out", .type = StateType::Bit},
}};
inline constexpr std::array<ElementParameter, 4> kDownParameters = {
    {{"n", Index}, {"CD", Bit}, {"LD", Bit}, {"PV", ParameterKind::Word}}};
inline constexpr std::array<ElementUpdate, 3> kDownStep = {{
    {"value", "LD ? PV : CD && !last && value > -32768 ? value - 1 : value"},
    {"last", "CD"},
    {"out", "value' <= 0"},
}};
inline constexpr std::array<ElementOperation, 2> kDownOperations = {{
    {.name = "CTD",
     .parameters = kDownParameters,
     .updates = kDownStep,
     .result = "out'"},
    {.name = "CTD.CV",
     .parameters = kReadParameters,
     .result = "value",
     .reads = true,
     .word = true},
}};

inline constexpr std::array<ElementState, 4> kUpDownStates = {{
    {.name = "value",
     .type = StateType::Count,
     .low = "-32768",
     .high = "32767"},
    {.name = "last_up", .type = StateType::Bit},
    {.name = "last_down", .type = StateType::Bit},
    {.name = "out", .type = StateType::Bit},
}};
inline constexpr std::array<ElementParameter, 6> kUpDownParameters = {
    {{"n", Index},
     {"CU", Bit},
     {"CD", Bit},
     {"R", Bit},
     {"LD", Bit},
     {"PV", ParameterKind::Word}}};
// Two edges in one execution leave the value as it is.
inline constexpr std::array<ElementUpdate, 4> kUpDownStep = {{
    {"value",
     "R ? 0 : LD ? PV : "
     "CU && !last_up && !(CD && !last_down) && value < 32767 ? value + 1 : "
     "CD && !last_down && !(CU && !last_up) && value > -32768 ? value - 1 : "
     "value"},
    {"last_up", "CU"},
    {"last_down", "CD"},
    {"out", "value' >= PV"},
}};
inline constexpr std::array<ElementOperation, 3> kUpDownOperations = {{
    {.name = "CTUD",
     .parameters = kUpDownParameters,
     .updates = kUpDownStep,
     .result = "out'"},
    {.name = "CTUD.QD",
     .parameters = kReadParameters,
     .result = "value <= 0",
     .reads = true},
    {.name = "CTUD.CV",
     .parameters = kReadParameters,
     .result = "value",
     .reads = true,
     .word = true},
}};

// --- edges and latches -------------------------------------------------------

inline constexpr std::array<ElementParameter, 2> kEdgeParameters = {
    {{"n", Index}, {"CLK", Bit}}};
inline constexpr std::array<ElementState, 1> kEdgeStates = {{
    {.name = "M", .type = StateType::Bit},
}};
inline constexpr std::array<ElementUpdate, 1> kRisingStep = {{{"M", "CLK"}}};
inline constexpr std::array<ElementOperation, 1> kRisingOperations = {{
    {.name = "R_TRIG",
     .parameters = kEdgeParameters,
     .updates = kRisingStep,
     .result = "CLK && !M"},
}};
inline constexpr std::array<ElementUpdate, 1> kFallingStep = {{{"M", "!CLK"}}};
inline constexpr std::array<ElementOperation, 1> kFallingOperations = {{
    {.name = "F_TRIG",
     .parameters = kEdgeParameters,
     .updates = kFallingStep,
     .result = "!CLK && !M"},
}};

inline constexpr std::array<ElementState, 1> kLatchStates = {{
    {.name = "Q1", .type = StateType::Bit},
}};
inline constexpr std::array<ElementParameter, 3> kSetParameters = {
    {{"n", Index}, {"S1", Bit}, {"R", Bit}}};
inline constexpr std::array<ElementUpdate, 1> kSetStep = {
    {{"Q1", "S1 || !R && Q1"}}};
inline constexpr std::array<ElementOperation, 1> kSetOperations = {{
    {.name = "SR",
     .parameters = kSetParameters,
     .updates = kSetStep,
     .result = "Q1'"},
}};
inline constexpr std::array<ElementParameter, 3> kResetParameters = {
    {{"n", Index}, {"S", Bit}, {"R1", Bit}}};
inline constexpr std::array<ElementUpdate, 1> kResetStep = {
    {{"Q1", "!R1 && (S || Q1)"}}};
inline constexpr std::array<ElementOperation, 1> kResetOperations = {{
    {.name = "RS",
     .parameters = kResetParameters,
     .updates = kResetStep,
     .result = "Q1'"},
}};

inline constexpr std::array<ElementKind, 10> kKinds = {{
    {.id = "ton",
     .letter = "TON",
     .dialect = "iec",
     .family = ElementFamily::Timer,
     .summary = "On-delay timer: Q when IN has been true for PT.",
     .source = "IEC 61131-3, table 38 and figure 15",
     .states = kOnDelayStates,
     .operations = kOnDelayOperations,
     .done = "on && elapsed >= p",
     .value = "elapsed"},
    {.id = "tof",
     .letter = "TOF",
     .dialect = "iec",
     .family = ElementFamily::Timer,
     .summary = "Off-delay timer: Q while IN is true and for PT after it. Q is "
                "false until IN was true once.",
     .source = "IEC 61131-3, table 38 and figure 15",
     .states = kOffDelayStates,
     .operations = kOffDelayOperations,
     .done = "on || fallen && elapsed < p",
     .value = "elapsed"},
    {.id = "tp",
     .letter = "TP",
     .dialect = "iec",
     .family = ElementFamily::Timer,
     .summary = "Pulse: Q for PT from a rising edge of IN, whatever IN does "
                "then; the next edge counts when Q and IN have been false.",
     .source = "IEC 61131-3, table 38 and figure 15",
     .states = kPulseStates,
     .operations = kPulseOperations,
     .done = "started && elapsed < p",
     .value = "elapsed"},
    {.id = "ctu",
     .letter = "CTU",
     .dialect = "iec esbmc",
     .family = ElementFamily::Counter,
     .summary = "Up-counter: counts rising edges of CU up to 32767, also past "
                "PV; R clears it and dominates.",
     .source = "IEC 61131-3, table 36",
     .states = kUpStates,
     .operations = kUpOperations,
     .done = "out",
     .value = "value"},
    {.id = "ctd",
     .letter = "CTD",
     .dialect = "iec esbmc",
     .family = ElementFamily::Counter,
     .summary = "Down-counter: counts rising edges of CD down to -32768; LD "
                "loads PV and dominates.",
     .source = "IEC 61131-3, table 36",
     .states = kDownStates,
     .operations = kDownOperations,
     .done = "out",
     .value = "value"},
    {.id = "ctud",
     .letter = "CTUD",
     .dialect = "iec esbmc",
     .family = ElementFamily::Counter,
     .summary = "Up-down-counter: R dominates LD, and LD the edges; edges of "
                "CU and CD in one execution cancel out.",
     .source = "IEC 61131-3, table 36",
     .states = kUpDownStates,
     .operations = kUpDownOperations,
     .done = "out",
     .value = "value"},
    {.id = "r-trig",
     .letter = "R_TRIG",
     .dialect = "iec matiec esbmc",
     .family = ElementFamily::Edge,
     .summary = "Rising edge; a CLK that is true in the first execution is "
                "one.",
     .source = "IEC 61131-3, table 35",
     .states = kEdgeStates,
     .operations = kRisingOperations},
    {.id = "f-trig",
     .letter = "F_TRIG",
     .dialect = "iec matiec",
     .family = ElementFamily::Edge,
     .summary = "Falling edge; as the standard defines it, a CLK that is "
                "false in the first execution is one.",
     .source = "IEC 61131-3, table 35",
     .states = kEdgeStates,
     .operations = kFallingOperations},
    {.id = "sr",
     .letter = "SR",
     .dialect = "iec matiec esbmc",
     .family = ElementFamily::Latch,
     .summary = "Latch; S1 dominates R.",
     .source = "IEC 61131-3, table 34",
     .states = kLatchStates,
     .operations = kSetOperations},
    {.id = "rs",
     .letter = "RS",
     .dialect = "iec matiec esbmc",
     .family = ElementFamily::Latch,
     .summary = "Latch; R1 dominates S.",
     .source = "IEC 61131-3, table 34",
     .states = kLatchStates,
     .operations = kResetOperations},
}};

}  // namespace iec
}  // namespace rung
