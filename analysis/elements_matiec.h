#pragma once

#include <array>

#include "analysis/elements_iec.h"

namespace rung {

/// Function blocks of tools that differ from the standard's: rows of
/// element_kinds(). Edges and latches are those of elements_iec.h.
///
/// matiec (OpenPLC, Beremiz): bodies of its library, lib/timer.txt and
/// lib/counter.txt. A timer looks at its clock from the execution after the one
/// that starts it: with PT = 0 it needs one execution more. Counters stop at PV
/// and at 0.
namespace matiec {

using enum ParameterKind;
using iec::kElapsedParameters;
using iec::kReadParameters;
using iec::kTimerParameters;

// --- timers: `timing` is STATE 1, `over` STATE 2 -----------------------------

inline constexpr std::array<ElementState, 4> kTimerStates = {{
    {.name = "prev", .type = StateType::Bit},
    {.name = "timing", .type = StateType::Bit},
    {.name = "over", .type = StateType::Bit},
    {.name = "elapsed", .type = StateType::Clock, .running = "timing"},
}};
// Right behind an execution, where readers put it, `elapsed` is below `p`.
inline constexpr std::string_view kElapsedTime =
    "over ? p : !timing ? 0 : elapsed < p ? elapsed : p";

inline constexpr std::array<ElementUpdate, 6> kOnDelayStep = {{
    {"start", "!timing && !over && !prev && IN"},
    {"fires", "!start && IN && timing && elapsed >= p"},
    {"over", "!start && IN && (over || fires)"},
    {"timing", "start || IN && timing && !fires"},
    {"elapsed", "!start && timing' ? elapsed : 0"},
    {"prev", "IN"},
}};
inline constexpr std::array<ElementOperation, 2> kOnDelayOperations = {{
    {.name = "TON",
     .parameters = kTimerParameters,
     .updates = kOnDelayStep,
     .result = "over'"},
    {.name = "TON.ET",
     .parameters = kElapsedParameters,
     .result = kElapsedTime,
     .reads = true,
     .word = true},
}};

inline constexpr std::array<ElementUpdate, 6> kOffDelayStep = {{
    {"start", "!timing && !over && prev && !IN"},
    {"fires", "!start && !IN && timing && elapsed >= p"},
    {"over", "!start && !IN && (over || fires)"},
    {"timing", "start || !IN && timing && !fires"},
    {"elapsed", "!start && timing' ? elapsed : 0"},
    {"prev", "IN"},
}};
inline constexpr std::array<ElementOperation, 2> kOffDelayOperations = {{
    {.name = "TOF",
     .parameters = kTimerParameters,
     .updates = kOffDelayStep,
     .result = "IN || timing'"},
    {.name = "TOF.ET",
     .parameters = kElapsedParameters,
     .result = kElapsedTime,
     .reads = true,
     .word = true},
}};

inline constexpr std::array<ElementUpdate, 6> kPulseStep = {{
    {"start", "!timing && !over && !prev && IN"},
    {"fires", "!start && timing && elapsed >= p"},
    {"over", "(over || fires) && IN"},
    {"timing", "start || timing && !fires"},
    {"elapsed", "!start && timing' ? elapsed : 0"},
    {"prev", "IN"},
}};
inline constexpr std::array<ElementOperation, 2> kPulseOperations = {{
    {.name = "TP",
     .parameters = kTimerParameters,
     .updates = kPulseStep,
     .result = "timing'"},
    {.name = "TP.ET",
     .parameters = kElapsedParameters,
     .result = kElapsedTime,
     .reads = true,
     .word = true},
}};

// --- counters ----------------------------------------------------------------

inline constexpr std::array<ElementUpdate, 3> kUpStep = {{
    {"value", "R ? 0 : CU && !last && value < PV ? value + 1 : value"},
    {"last", "CU"},
    {"out", "value' >= PV"},
}};
inline constexpr std::array<ElementOperation, 2> kUpOperations = {{
    {.name = "CTU",
     .parameters = iec::kUpParameters,
     .updates = kUpStep,
     .result = "out'"},
    iec::kUpOperations[1],
}};

inline constexpr std::array<ElementUpdate, 3> kDownStep = {{
    {"value", "LD ? PV : CD && !last && value > 0 ? value - 1 : value"},
    {"last", "CD"},
    {"out", "value' <= 0"},
}};
inline constexpr std::array<ElementOperation, 2> kDownOperations = {{
    {.name = "CTD",
     .parameters = iec::kDownParameters,
     .updates = kDownStep,
     .result = "out'"},
    iec::kDownOperations[1],
}};

inline constexpr std::array<ElementUpdate, 4> kUpDownStep = {{
    {"value",
     "R ? 0 : LD ? PV : "
     "CU && !last_up && CD && !last_down ? value : "
     "CU && !last_up && value < PV ? value + 1 : "
     "CD && !last_down && value > 0 ? value - 1 : value"},
    {"last_up", "CU"},
    {"last_down", "CD"},
    {"out", "value' >= PV"},
}};
inline constexpr std::array<ElementOperation, 3> kUpDownOperations = {{
    {.name = "CTUD",
     .parameters = iec::kUpDownParameters,
     .updates = kUpDownStep,
     .result = "out'"},
    iec::kUpDownOperations[1],
    iec::kUpDownOperations[2],
}};

// --- ESBMC-PLC ---------------------------------------------------------------

// Its timers count the scan that starts them: the clock runs always, and is
// held at 0 by the scans in which nothing is timed.
inline constexpr std::array<ElementState, 2> kScanTimerStates = {{
    {.name = "on", .type = StateType::Bit},
    {.name = "elapsed", .type = StateType::Clock, .running = "on || !on"},
}};
inline constexpr std::array<ElementUpdate, 2> kScanOnDelayStep = {{
    {"elapsed", "IN ? elapsed : 0"},
    {"on", "IN && elapsed' >= p"},
}};
inline constexpr std::array<ElementOperation, 2> kScanOnDelayOperations = {{
    {.name = "TON",
     .parameters = kTimerParameters,
     .updates = kScanOnDelayStep,
     .result = "on'"},
    {.name = "TON.ET",
     .parameters = kElapsedParameters,
     .result = iec::kElapsedTime,
     .reads = true,
     .word = true},
}};
inline constexpr std::array<ElementOperation, 2> kScanPulseOperations = {{
    {.name = "TP",
     .parameters = kTimerParameters,
     .updates = kScanOnDelayStep,
     .result = "on'"},
    {.name = "TP.ET",
     .parameters = kElapsedParameters,
     .result = iec::kElapsedTime,
     .reads = true,
     .word = true},
}};
inline constexpr std::array<ElementUpdate, 2> kScanOffDelayStep = {{
    {"elapsed", "IN ? 0 : elapsed"},
    {"on", "IN || on && elapsed' < p"},
}};
inline constexpr std::array<ElementOperation, 2> kScanOffDelayOperations = {{
    {.name = "TOF",
     .parameters = kTimerParameters,
     .updates = kScanOffDelayStep,
     .result = "on'"},
    {.name = "TOF.ET",
     .parameters = kElapsedParameters,
     .result = iec::kElapsedTime,
     .reads = true,
     .word = true},
}};

inline constexpr std::array<ElementUpdate, 1> kFallStep = {{{"M", "CLK"}}};
inline constexpr std::array<ElementOperation, 1> kFallOperations = {{
    {.name = "F_TRIG",
     .parameters = iec::kEdgeParameters,
     .updates = kFallStep,
     .result = "!CLK && M"},
}};

inline constexpr std::array<ElementKind, 10> kKinds = {{
    {.id = "ton-matiec",
     .letter = "TON",
     .dialect = "matiec",
     .family = ElementFamily::Timer,
     .summary = "On-delay timer: Q when IN has been true for PT, from the "
                "second execution with IN on.",
     .source = "matiec, lib/timer.txt",
     .states = kTimerStates,
     .operations = kOnDelayOperations,
     .done = "over",
     .value = "elapsed"},
    {.id = "tof-matiec",
     .letter = "TOF",
     .dialect = "matiec",
     .family = ElementFamily::Timer,
     .summary = "Off-delay timer: Q while IN is true and for PT after it, at "
                "least one execution.",
     .source = "matiec, lib/timer.txt",
     .states = kTimerStates,
     .operations = kOffDelayOperations,
     .done = "prev || timing",
     .value = "elapsed"},
    {.id = "tp-matiec",
     .letter = "TP",
     .dialect = "matiec",
     .family = ElementFamily::Timer,
     .summary = "Pulse: Q for PT from a rising edge of IN, at least one "
                "execution; the next edge counts when IN has been false.",
     .source = "matiec, lib/timer.txt",
     .states = kTimerStates,
     .operations = kPulseOperations,
     .done = "timing",
     .value = "elapsed"},
    {.id = "ctu-matiec",
     .letter = "CTU",
     .dialect = "matiec",
     .family = ElementFamily::Counter,
     .summary = "Up-counter: counts rising edges of CU up to PV; R clears it "
                "and dominates.",
     .source = "matiec, lib/counter.txt",
     .states = iec::kUpStates,
     .operations = kUpOperations,
     .done = "out",
     .value = "value"},
    {.id = "ctd-matiec",
     .letter = "CTD",
     .dialect = "matiec",
     .family = ElementFamily::Counter,
     .summary = "Down-counter: counts rising edges of CD down to 0; LD loads "
                "PV and dominates.",
     .source = "matiec, lib/counter.txt",
     .states = iec::kDownStates,
     .operations = kDownOperations,
     .done = "out",
     .value = "value"},
    {.id = "ctud-matiec",
     .letter = "CTUD",
     .dialect = "matiec",
     .family = ElementFamily::Counter,
     .summary = "Up-down-counter between 0 and PV: R dominates LD, and LD the "
                "edges; edges of CU and CD in one execution cancel out.",
     .source = "matiec, lib/counter.txt",
     .states = iec::kUpDownStates,
     .operations = kUpDownOperations,
     .done = "out",
     .value = "value"},
    {.id = "ton-esbmc",
     .letter = "TON",
     .dialect = "esbmc",
     .family = ElementFamily::Timer,
     .summary = "On-delay timer that counts scans: Q in the scan that "
                "completes PT, the first with IN on included.",
     .source = "ESBMC-PLC, its model of timers",
     .states = kScanTimerStates,
     .operations = kScanOnDelayOperations,
     .done = "on",
     .value = "elapsed"},
    {.id = "tof-esbmc",
     .letter = "TOF",
     .dialect = "esbmc",
     .family = ElementFamily::Timer,
     .summary = "Off-delay timer that counts scans, the first without IN "
                "included.",
     .source = "ESBMC-PLC, its model of timers",
     .states = kScanTimerStates,
     .operations = kScanOffDelayOperations,
     .done = "on",
     .value = "elapsed"},
    {.id = "tp-esbmc",
     .letter = "TP",
     .dialect = "esbmc",
     .family = ElementFamily::Timer,
     .summary = "As ESBMC simplifies it: an on-delay timer, no pulse.",
     .source = "ESBMC-PLC, its model of timers",
     .states = kScanTimerStates,
     .operations = kScanPulseOperations,
     .done = "on",
     .value = "elapsed"},
    {.id = "f-trig-esbmc",
     .letter = "F_TRIG",
     .dialect = "esbmc",
     .family = ElementFamily::Edge,
     .summary = "Falling edge; CLK must have been true before.",
     .source = "ESBMC-PLC, its model of edges",
     .states = iec::kEdgeStates,
     .operations = kFallOperations},
}};

}  // namespace matiec
}  // namespace rung
