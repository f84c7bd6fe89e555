#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>

#include "analysis/element.h"

namespace rung {

/// The simulator's own elements, written from the published listings with
/// absolute times. Nothing here reads the step texts of element_kinds().

enum class ElementCode : std::uint8_t {
  TimerYun,
  TimerYunReset,
  TimerSim,
  TimerOffSim,
  CounterYun,
  CounterYunReset,
  CounterSim,
  Rise,
  Fall,
  OnDelay,  // IEC 61131-3, from here on
  OffDelay,
  Pulse,
  TimerElapsed,
  CountUp,
  CountDown,
  CountUpDown,
  CountedDown,  // CTUD.QD
  CountValue,
  RisingTrigger,
  FallingTrigger,
  SetDominant,
  ResetDominant,
};

/// By the names of kind and operation alone; no value for an element that the
/// simulator does not know.
std::optional<ElementCode> find_element_code(const ElementKind& kind,
                                             const ElementOperation& operation);

/// What the listings keep in arrays by index; their names stand behind.
struct SimulatedElement {
  std::int64_t t0 = 0;     // d1, d1TOF: the clock when the timer started
  std::int64_t count = 0;  // Cs; CV
  bool started = false;    // TimerInit, TimerTOFInit
  bool out = false;        // outTimerTOF; Q, Q1
  bool last = false;       // vlast; M
  bool last_down = false;  // vlastD
};

/// Equal in everything that is not a point in time.
bool same_but_for_time(const SimulatedElement& a, const SimulatedElement& b);

struct ElementClock {
  static constexpr std::int64_t kNever =
      std::numeric_limits<std::int64_t>::max();

  std::int64_t now = 0;  // millis(), ttick
  /// Over the comparisons of this scan that were false for a timer that had
  /// been running: the ms after which the first of them becomes true.
  std::int64_t next_event = kNever;
};

/// The operands of a call, in the order of the operation's parameters.
struct ElementInputs {
  std::int64_t parameter = 0;  // ElementCall::parameter
  std::array<std::int64_t, 5> value = {0, 0, 0, 0, 0};  // a bit is 0 or 1
  bool bit(std::size_t index) const { return value[index] != 0; }
};

/// One call. Returns its result: of a bit, 0 or 1.
std::int64_t execute_element(ElementCode code, SimulatedElement& element,
                             const ElementInputs& inputs, ElementClock& clock);

/// What properties observe of an instance whose largest preset or count is
/// `parameter`: T(0).elapsed and T(0).q or C(0).q.
enum class ElementShape : std::uint8_t {
  TimerYun,
  TimerSim,
  TimerOffSim,
  CounterYun,
  CounterSim,
  Edge,
  OnDelay,
  OffDelay,
  Pulse,
  Counter,  // of IEC 61131-3: `out` is its first output
};
/// No value for an operation that kinds of several shapes have.
std::optional<ElementShape> shape_of(ElementCode code);
/// The time runs on from scan to scan; where it does not, elapsed_ms() is 0.
bool is_running(ElementShape shape, const SimulatedElement& element);
std::int64_t elapsed_ms(ElementShape shape, const SimulatedElement& element,
                        std::int64_t now);
bool is_done(ElementShape shape, const SimulatedElement& element,
             std::int64_t parameter, std::int64_t now);

}  // namespace rung
