#include <algorithm>
#include <array>

#include "analysis/element.h"
#include "analysis/elements_iec.h"
#include "analysis/elements_ldmicro.h"
#include "analysis/elements_logix.h"
#include "analysis/elements_matiec.h"
#include "analysis/elements_melsec.h"
#include "analysis/elements_plclib.h"
#include "analysis/elements_s7.h"

namespace rung {
namespace {

using enum ParameterKind;

// Elapsed times count from the call that started them and are 0 while nothing
// is timed; `now` advances between scans only, so all calls of a scan read the
// same clock.

// --- timer, yun dialect ------------------------------------------------------

constexpr std::array<ElementState, 2> kTimerYunStates = {{
    {.name = "started", .type = StateType::Bit},
    {.name = "elapsed", .type = StateType::Clock, .running = "started"},
}};
constexpr std::array<ElementParameter, 3> kTimerParameters = {
    {{"n", Index}, {"d", Seconds}, {"v", Bit}}};
constexpr std::array<ElementParameter, 2> kResetParameters = {
    {{"n", Index}, {"v", Bit}}};
constexpr std::array<ElementUpdate, 2> kTimerYunStart = {{
    {"elapsed", "v && !started ? 0 : elapsed"},
    {"started", "started || v"},
}};
constexpr std::array<ElementUpdate, 2> kTimerYunReset = {{
    {"elapsed", "v ? 0 : elapsed"},
    {"started", "started && !v"},
}};
constexpr std::array<ElementOperation, 2> kTimerYunOperations = {{
    {.name = "T",
     .parameters = kTimerParameters,
     .updates = kTimerYunStart,
     .result = "v && elapsed' > p",
     .rounding = SecondsRounding::Floor,
     .opcode = 0x40},
    {.name = "TR",
     .parameters = kResetParameters,
     .updates = kTimerYunReset,
     .result = "v",
     .resets = true,
     .opcode = 0x41},
}};

// The listing subtracts two readings of millis(), 32 bits wide, so that a timer
// that nobody resets begins anew after 49.7 days.
constexpr std::array<ElementUpdate, 3> kTimerYunRolloverStart = {{
    {"elapsed", "elapsed < 4294967296 ? elapsed : elapsed - 4294967296"},
    {"elapsed", "v && !started ? 0 : elapsed'"},
    {"started", "started || v"},
}};
constexpr std::array<ElementOperation, 2> kTimerYunRolloverOperations = {{
    {.name = "T",
     .parameters = kTimerParameters,
     .updates = kTimerYunRolloverStart,
     .result = "v && elapsed' > p",
     .rounding = SecondsRounding::Floor},
    {.name = "TR",
     .parameters = kResetParameters,
     .updates = kTimerYunReset,
     .result = "v",
     .resets = true},
}};

// --- timers, sim dialect -----------------------------------------------------

constexpr std::array<ElementState, 2> kTimerSimStates = {{
    {.name = "started", .type = StateType::Bit},
    {.name = "elapsed", .type = StateType::Clock, .running = "started"},
}};
constexpr std::array<ElementUpdate, 2> kTimerSimStep = {{
    {"elapsed", "v && started ? elapsed : 0"},
    {"started", "v"},
}};
constexpr std::array<ElementOperation, 1> kTimerSimOperations = {{
    {.name = "T",
     .parameters = kTimerParameters,
     .updates = kTimerSimStep,
     .result = "elapsed' >= p",
     .opcode = 0x42},
}};

constexpr std::array<ElementState, 3> kOffDelayStates = {{
    {.name = "armed", .type = StateType::Bit},
    {.name = "out", .type = StateType::Bit},
    {.name = "elapsed", .type = StateType::Clock, .running = "out && !armed"},
}};
constexpr std::array<ElementUpdate, 4> kOffDelayStep = {{
    {"elapsed", "!v && armed ? 0 : elapsed"},
    {"armed", "v"},
    {"out", "v || out && elapsed' < p"},
    {"elapsed", "out' && !armed' ? elapsed' : 0"},
}};
constexpr std::array<ElementOperation, 1> kOffDelayOperations = {{
    {.name = "TOF",
     .parameters = kTimerParameters,
     .updates = kOffDelayStep,
     .result = "out'",
     .opcode = 0x43},
}};

// --- counter, yun dialect ----------------------------------------------------

constexpr std::array<ElementState, 2> kCounterYunStates = {{
    {.name = "value", .type = StateType::Count, .low = "0", .high = "p"},
    {.name = "last", .type = StateType::Bit},
}};
constexpr std::array<ElementParameter, 3> kCounterYunParameters = {
    {{"n", Index}, {"count", Count}, {"v", Bit}}};
constexpr std::array<ElementUpdate, 2> kCounterYunStep = {{
    {"value", "value < p && v && !last ? value + 1 : value"},
    {"last", "v"},
}};
constexpr std::array<ElementUpdate, 1> kCounterYunReset = {{
    {"value", "v ? 0 : value"},
}};
// `Cnt` is the controller's own name of `C`.
constexpr std::array<ElementOperation, 3> kCounterYunOperations = {{
    {.name = "C",
     .parameters = kCounterYunParameters,
     .updates = kCounterYunStep,
     .result = "value' >= p",
     .opcode = 0x48},
    {.name = "Cnt",
     .parameters = kCounterYunParameters,
     .updates = kCounterYunStep,
     .result = "value' >= p",
     .opcode = 0x48},
    {.name = "CR",
     .parameters = kResetParameters,
     .updates = kCounterYunReset,
     .result = "v",
     .resets = true,
     .opcode = 0x49},
}};

// --- counter, sim dialect ----------------------------------------------------

// The script's counter has no lower bound. Below kCountFloor the encoding is
// wider than the program: there an up-count may or may not take effect
// (`any` is a free bit), so proofs hold for every depth, and a run that goes
// so deep is checked by the simulator like any other.
constexpr std::array<ElementState, 3> kCounterSimStates = {{
    {.name = "value",
     .type = StateType::Count,
     .low = "-32768",
     .high = "50 * p + 1"},
    {.name = "last_up", .type = StateType::Bit},
    {.name = "last_down", .type = StateType::Bit},
}};
constexpr std::array<ElementParameter, 5> kCounterSimParameters = {
    {{"n", Index},
     {"count", Count},
     {"up", Bit},
     {"down", Bit},
     {"reset", Bit}}};
constexpr std::array<ElementUpdate, 6> kCounterSimStep = {{
    {"value",
     "reset ? 0 : up && !last_up && (value > -32768 || any) ? value + 1 : "
     "value"},
    {"value",
     "!reset && down && !last_down && value' > -32768 ? value' - 1 : value'"},
    {"last_up", "up && !reset"},
    {"last_down", "down && !reset"},
    {"q", "!reset && value' == p"},
    {"value", "!reset && value' > 50 * p ? p + 1 : value'"},
}};
constexpr std::array<ElementOperation, 1> kCounterSimOperations = {{
    {.name = "C",
     .parameters = kCounterSimParameters,
     .updates = kCounterSimStep,
     .result = "q",
     .opcode = 0x4a},
}};

// --- edges -------------------------------------------------------------------

constexpr std::array<ElementState, 1> kEdgeStates = {{
    {.name = "last", .type = StateType::Bit},
}};
constexpr std::array<ElementUpdate, 1> kEdgeStep = {{{"last", "v"}}};
constexpr std::array<ElementOperation, 2> kEdgeOperations = {{
    {.name = "RISE",
     .parameters = kResetParameters,
     .updates = kEdgeStep,
     .result = "v && !last",
     .opcode = 0x50},
    {.name = "FALL",
     .parameters = kResetParameters,
     .updates = kEdgeStep,
     .result = "!v && last",
     .opcode = 0x51},
}};

constexpr std::array<ElementKind, 7> kScriptKinds = {{
    {.id = "timer-yun",
     .letter = "T",
     .dialect = "yun",
     .family = ElementFamily::Timer,
     .summary = "On-delay timer that only TR resets: once started it runs on, "
                "and a second activation without TR has no delay.",
     .source = "Sensors and Materials 32(12), 2020, section 2.1",
     .states = kTimerYunStates,
     .operations = kTimerYunOperations,
     .done = "started && elapsed > p",
     .value = "elapsed",
     .keeps = true,
     .rollover = "timer-yun-rollover"},
    {.id = "timer-yun-rollover",
     .letter = "T",
     .dialect = "yun-rollover",
     .family = ElementFamily::Timer,
     .summary = "The timer of `yun` on a clock of 32 bits: after 49.7 days its "
                "time begins anew.",
     .source = "Sensors and Materials 32(12), 2020, section 2.1",
     .states = kTimerYunStates,
     .operations = kTimerYunRolloverOperations,
     .done = "started && elapsed > p",
     .value = "elapsed",
     .keeps = true},
    {.id = "timer-sim",
     .letter = "T",
     .dialect = "sim",
     .family = ElementFamily::Timer,
     .summary = "On-delay timer: true when its input has been true for the "
                "preset; with preset 0 it is true always.",
     .source = "I/O simulator for boolean ladder scripts, section 3.2",
     .states = kTimerSimStates,
     .operations = kTimerSimOperations,
     .done = "elapsed >= p",
     .value = "elapsed"},
    {.id = "timer-off-sim",
     .letter = "TOF",
     .dialect = "sim",
     .family = ElementFamily::Timer,
     .summary = "Off-delay timer: follows its input up at once and down after "
                "the preset.",
     .source = "I/O simulator for boolean ladder scripts, section 3.2",
     .states = kOffDelayStates,
     .operations = kOffDelayOperations,
     .done = "out",
     .value = "elapsed"},
    {.id = "counter-yun",
     .letter = "C",
     .dialect = "yun",
     .family = ElementFamily::Counter,
     .summary = "Counts rising edges up to its preset; CR clears it.",
     .source = "Sensors and Materials 32(12), 2020, section 2.1",
     .states = kCounterYunStates,
     .operations = kCounterYunOperations,
     .done = "value >= p",
     .value = "value"},
    {.id = "counter-sim",
     .letter = "C",
     .dialect = "sim",
     .family = ElementFamily::Counter,
     .summary = "Counts up and down on rising edges; true when the value "
                "equals the preset, and no longer when it is past it.",
     .source = "I/O simulator for boolean ladder scripts, section 3.2",
     .states = kCounterSimStates,
     .operations = kCounterSimOperations,
     .done = "value == p",
     .value = "value"},
    {.id = "edge",
     .letter = "E",
     .dialect = "",
     .family = ElementFamily::Edge,
     .summary = "Edge memory: true in the scan in which its input changed.",
     .source = "IEC 61131-3, R_TRIG; FALL needs a true scan before",
     .states = kEdgeStates,
     .operations = kEdgeOperations,
     .done = {},
     .value = {}},
}};

constexpr auto kKinds = [] {
  std::array<ElementKind, kScriptKinds.size() + iec::kKinds.size() +
                              matiec::kKinds.size() + melsec::kKinds.size() +
                              ldmicro_elements::kKinds.size() +
                              plclib::kKinds.size() + s7::kKinds.size() +
                              logix::kKinds.size()>
      all = {};
  std::size_t count = 0;
  for (const ElementKind& kind : kScriptKinds) all[count++] = kind;
  for (const ElementKind& kind : iec::kKinds) all[count++] = kind;
  for (const ElementKind& kind : matiec::kKinds) all[count++] = kind;
  for (const ElementKind& kind : melsec::kKinds) all[count++] = kind;
  for (const ElementKind& kind : ldmicro_elements::kKinds) all[count++] = kind;
  for (const ElementKind& kind : plclib::kKinds) all[count++] = kind;
  for (const ElementKind& kind : s7::kKinds) all[count++] = kind;
  for (const ElementKind& kind : logix::kKinds) all[count++] = kind;
  return all;
}();

}  // namespace

std::span<const ElementKind> element_kinds() { return kKinds; }

bool ElementKind::is_in(std::string_view wanted) const {
  if (dialect.empty()) return true;
  for (std::string_view rest = dialect; !rest.empty();) {
    const std::size_t end = std::min(rest.find(' '), rest.size());
    if (rest.substr(0, end) == wanted) return true;
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  return false;
}

FoundOperation find_operation(std::string_view dialect, std::string_view name) {
  for (const ElementKind& kind : kKinds) {
    if (!kind.is_in(dialect)) continue;
    for (const ElementOperation& operation : kind.operations) {
      if (operation.name == name) return {&kind, &operation};
    }
  }
  return {};
}

FoundOperation find_operation(std::uint8_t opcode) {
  if (opcode == 0) return {};
  for (const ElementKind& kind : kKinds) {
    for (const ElementOperation& operation : kind.operations) {
      if (operation.opcode == opcode) return {&kind, &operation};
    }
  }
  return {};
}

}  // namespace rung
