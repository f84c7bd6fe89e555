#include "analysis/simulator_elements.h"

#include <algorithm>
#include <array>

#include "analysis/simulator_elements_iec.h"
#include "analysis/simulator_elements_ldmicro.h"
#include "analysis/simulator_elements_logix.h"
#include "analysis/simulator_elements_matiec.h"
#include "analysis/simulator_elements_melsec.h"
#include "analysis/simulator_elements_plclib.h"
#include "analysis/simulator_elements_s7.h"

namespace rung {
namespace {

// bool T(int n, float d, bool v), Sensors and Materials 32(12), section 2.1.
// `parameter` is the whole part of d*1000, so `t > d*1000` is `t > parameter`.
bool timer_yun(SimulatedElement& e, std::int64_t parameter, bool v,
               ElementClock& clock) {
  if (v && !e.started) {
    e.t0 = clock.now;
    e.started = true;
  }
  // Before the first start d1[n] counts from power-up, but then v is false.
  const std::int64_t t = clock.now - e.t0;
  return reached(t, parameter + 1, clock) && v;
}

/// unsigned long millis(), and what the listings subtract from it.
std::uint32_t millis(std::int64_t now) {
  return static_cast<std::uint32_t>(now);
}
std::int64_t millis_since(std::int64_t t0, std::int64_t now) {
  return static_cast<std::uint32_t>(millis(now) - millis(t0));
}
constexpr std::int64_t kRollover = std::int64_t{1} << 32;

// The same as it runs on the controller: `t` is an unsigned long.
bool timer_yun_rollover(SimulatedElement& e, std::int64_t parameter, bool v,
                        ElementClock& clock) {
  const bool starts = v && !e.started;
  if (starts) {
    e.t0 = clock.now;
    e.started = true;
  }
  const std::int64_t t = millis_since(e.t0, clock.now);
  const bool over = t > parameter;
  if (e.started && !starts) {
    // Also where it has just begun anew: 0 is a time like any other.
    const std::int64_t event =
        over ? kRollover : std::min(kRollover, parameter + 1);
    clock.next_event = std::min(clock.next_event, event - t);
  }
  return over && v;
}

// bool TR(int n, bool v)
bool timer_yun_reset(SimulatedElement& e, bool v) {
  if (v) e.started = false;
  return v;
}

// function T(n, d, v), I/O simulator for boolean ladder scripts, section 3.2.
bool timer_sim(SimulatedElement& e, std::int64_t parameter, bool v,
               ElementClock& clock) {
  if (v) {
    if (!e.started) {
      e.t0 = clock.now;
      e.started = true;
    }
  } else {
    e.t0 = clock.now;
    e.started = false;
  }
  return reached(clock.now - e.t0, parameter, clock);
}

// function TOF(n, d, v), ibid. TimerTOFInit is undefined before the first
// call, which behaves as 0: outTimerTOF is undefined as long, too.
bool timer_off_sim(SimulatedElement& e, std::int64_t parameter, bool v,
                   ElementClock& clock) {
  if (v) {
    e.started = true;
    e.out = true;
  }
  if (!v && e.started) {
    e.t0 = clock.now;
    e.started = false;
  }
  if (!e.started && e.out) {
    if (reached(clock.now - e.t0, parameter, clock)) e.out = false;
  }
  return e.out;
}

// bool Cnt(int n, int cnt, bool v), Sensors and Materials 32(12).
bool counter_yun(SimulatedElement& e, std::int64_t count, bool v) {
  if (e.count < count && v != e.last && v) e.count += 1;
  const bool result = e.count >= count;
  e.last = v;
  return result;
}

// bool CR(int n, bool v): the last input is kept.
bool counter_yun_reset(SimulatedElement& e, bool v) {
  if (v) e.count = 0;
  return v;
}

// function C(n, count, v, vd, Reset), I/O simulator, section 3.2. The result
// is taken before the count is cut back, and nothing bounds it below.
bool counter_sim(SimulatedElement& e, std::int64_t count, bool v, bool down,
                 bool reset) {
  if (reset) {
    e.last = false;
    e.last_down = false;
    e.count = 0;
    return false;
  }
  if (v != e.last && v) e.count += 1;
  if (down != e.last_down && down) e.count -= 1;
  const bool result = e.count == count;
  e.last = v;
  e.last_down = down;
  if (e.count > 50 * count) e.count = count + 1;
  return result;
}

bool edge(SimulatedElement& e, bool v, bool wanted) {
  const bool changed = v != e.last;
  e.last = v;
  return changed && v == wanted;
}

using E = SimulatedElement;
using In = ElementInputs;

std::int64_t count_step(E& e, const In& in, ElementClock& /*clock*/) {
  return counter_yun(e, in.parameter, in.bit(0)) ? 1 : 0;
}

constexpr std::array<SimulatedOperation, 12> kOperations = {{
    {"timer-yun-rollover", "T",
     [](E& e, const In& in, ElementClock& clock) -> std::int64_t {
       return timer_yun_rollover(e, in.parameter, in.bit(0), clock) ? 1 : 0;
     }},
    {"timer-yun-rollover", "TR",
     [](E& e, const In& in, ElementClock&) -> std::int64_t {
       return timer_yun_reset(e, in.bit(0)) ? 1 : 0;
     }},
    {"timer-yun", "T",
     [](E& e, const In& in, ElementClock& clock) -> std::int64_t {
       return timer_yun(e, in.parameter, in.bit(0), clock) ? 1 : 0;
     }},
    {"timer-yun", "TR",
     [](E& e, const In& in, ElementClock&) -> std::int64_t {
       return timer_yun_reset(e, in.bit(0)) ? 1 : 0;
     }},
    {"timer-sim", "T",
     [](E& e, const In& in, ElementClock& clock) -> std::int64_t {
       return timer_sim(e, in.parameter, in.bit(0), clock) ? 1 : 0;
     }},
    {"timer-off-sim", "TOF",
     [](E& e, const In& in, ElementClock& clock) -> std::int64_t {
       return timer_off_sim(e, in.parameter, in.bit(0), clock) ? 1 : 0;
     }},
    {"counter-yun", "C", count_step},
    {"counter-yun", "Cnt", count_step},
    {"counter-yun", "CR",
     [](E& e, const In& in, ElementClock&) -> std::int64_t {
       return counter_yun_reset(e, in.bit(0)) ? 1 : 0;
     }},
    {"counter-sim", "C",
     [](E& e, const In& in, ElementClock&) -> std::int64_t {
       return counter_sim(e, in.parameter, in.bit(0), in.bit(1), in.bit(2)) ? 1
                                                                            : 0;
     }},
    {"edge", "RISE",
     [](E& e, const In& in, ElementClock&) -> std::int64_t {
       return edge(e, in.bit(0), true) ? 1 : 0;
     }},
    {"edge", "FALL",
     [](E& e, const In& in, ElementClock&) -> std::int64_t {
       return edge(e, in.bit(0), false) ? 1 : 0;
     }},
}};

bool is_started(const E& e) { return e.started; }

constexpr std::array<SimulatedShape, 6> kShapes = {{
    {"timer-yun-rollover", is_started,
     [](const E& e, std::int64_t preset, std::int64_t now) {
       return e.started && millis_since(e.t0, now) > preset;
     },
     nullptr, true},
    {"timer-yun", is_started,
     [](const E& e, std::int64_t preset, std::int64_t now) {
       return e.started && now - e.t0 > preset;
     }},
    {"timer-sim", is_started,
     [](const E& e, std::int64_t preset, std::int64_t now) {
       return (e.started ? now - e.t0 : 0) >= preset;
     }},
    {"timer-off-sim", [](const E& e) { return e.out && !e.started; },
     [](const E& e, std::int64_t, std::int64_t) { return e.out; }},
    {"counter-yun", nullptr,
     [](const E& e, std::int64_t count, std::int64_t) {
       return e.count >= count;
     }},
    {"counter-sim", nullptr,
     [](const E& e, std::int64_t count, std::int64_t) {
       return e.count == count;
     }},
}};

/// One line a dialect.
std::span<const SimulatedDialect> dialects() {
  static const std::array all = {
      SimulatedDialect{kOperations, kShapes},
      simulated_iec(),
      simulated_matiec(),
      simulated_melsec(),
      simulated_ldmicro(),
      simulated_plclib(),
      simulated_s7(),
      simulated_logix(),
  };
  return all;
}

}  // namespace

const SimulatedOperation* find_simulated(const ElementKind& kind,
                                         const ElementOperation& operation) {
  for (const SimulatedDialect& dialect : dialects()) {
    for (const SimulatedOperation& row : dialect.operations) {
      if (row.kind == kind.id && row.operation == operation.name) return &row;
    }
  }
  return nullptr;
}

const SimulatedShape* find_shape(const ElementKind& kind) {
  for (const SimulatedDialect& dialect : dialects()) {
    for (const SimulatedShape& row : dialect.shapes) {
      if (row.kind == kind.id) return &row;
    }
  }
  return nullptr;
}

bool same_but_for_time(const SimulatedElement& a, const SimulatedElement& b) {
  return a.count == b.count && a.started == b.started && a.out == b.out &&
         a.last == b.last && a.last_down == b.last_down;
}

bool reached(std::int64_t t, std::int64_t limit, ElementClock& clock) {
  if (t >= limit) return true;
  if (t > 0) clock.next_event = std::min(clock.next_event, limit - t);
  return false;
}

bool is_running(const SimulatedShape* shape, const SimulatedElement& element) {
  return shape != nullptr && shape->running != nullptr &&
         shape->running(element);
}

std::int64_t elapsed_ms(const SimulatedShape* shape,
                        const SimulatedElement& element, std::int64_t now) {
  if (is_running(shape, element)) {
    return shape->rolls_over ? millis_since(element.t0, now) : now - element.t0;
  }
  return shape != nullptr && shape->kept != nullptr ? shape->kept(element) : 0;
}

}  // namespace rung
