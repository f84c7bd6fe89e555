#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <string_view>

#include "analysis/element.h"

namespace rung {

/// The simulator's own elements, written from the published listings with
/// absolute times. Nothing here reads the step texts of element_kinds().

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

  std::int64_t now = 0;           // millis(), ttick
  std::int64_t longest_scan = 0;  // ms
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

/// One operation of the simulator's: executes a call and returns its result; of
/// a bit, 0 or 1. `kind` and `operation` are the names in element_kinds().
struct SimulatedOperation {
  std::string_view kind;
  std::string_view operation;
  std::int64_t (*execute)(SimulatedElement& element,
                          const ElementInputs& inputs,
                          ElementClock& clock) = nullptr;
};

/// What properties observe of a kind that has `.q` or a clock: T(0).elapsed and
/// T(0).q. Where `running` is null there is no clock. `parameter` is the
/// largest preset or count of the instance.
struct SimulatedShape {
  std::string_view kind;
  /// The time runs on from scan to scan; where not, the elapsed time is that
  /// of `kept`, or 0.
  bool (*running)(const SimulatedElement& element) = nullptr;
  bool (*done)(const SimulatedElement& element, std::int64_t parameter,
               std::int64_t now) = nullptr;
  std::int64_t (*kept)(const SimulatedElement& element) = nullptr;
  /// The clock is read as a number of 32 bits.
  bool rolls_over = false;
};

/// What one dialect adds; simulator_elements.cpp lists them.
struct SimulatedDialect {
  std::span<const SimulatedOperation> operations;
  std::span<const SimulatedShape> shapes;
};

/// By the names of kind and operation alone; null for an element that the
/// simulator does not know.
const SimulatedOperation* find_simulated(const ElementKind& kind,
                                         const ElementOperation& operation);
/// Null: nothing is observed of it.
const SimulatedShape* find_shape(const ElementKind& kind);

bool is_running(const SimulatedShape* shape, const SimulatedElement& element);
std::int64_t elapsed_ms(const SimulatedShape* shape,
                        const SimulatedElement& element, std::int64_t now);

/// `t >= limit`; where it is false for a running timer, it is an event to come.
/// A timer that was started in this very scan is none: as long as nothing else
/// changes, it is started again in every scan.
bool reached(std::int64_t t, std::int64_t limit, ElementClock& clock);

}  // namespace rung
