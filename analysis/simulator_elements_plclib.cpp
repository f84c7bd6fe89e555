#include "analysis/simulator_elements_plclib.h"

#include <array>

namespace rung {
namespace {

using E = SimulatedElement;
using In = ElementInputs;

// The listings: of the thesis, in its appendix; of the published library,
// plcLib.cpp. There a timer is idle when its variable is 0; here when it is not
// `started`, for a clock that begins with 0 is a time like any other.

// timerDelay, and the published timerOn: `limit` is where it is over.
bool on_delay(E& e, bool scan_value, std::int64_t limit, ElementClock& clock) {
  if (!scan_value) {
    e.started = false;
    return false;
  }
  if (!e.started) {
    e.started = true;
    e.t0 = clock.now;
    return false;
  }
  return reached(clock.now - e.t0, limit, clock);
}

// The thesis's timerOn, and the published timerOff.
bool off_delay(E& e, bool scan_value, std::int64_t limit, ElementClock& clock) {
  if (scan_value) {
    e.started = true;
    e.t0 = clock.now;
    return true;
  }
  if (!e.started) return false;
  return !reached(clock.now - e.t0, limit, clock);
}

bool timer_pulse(E& e, bool scan_value, std::int64_t period,
                 ElementClock& clock) {
  if (!scan_value && !e.started) return false;
  if (!e.started) {
    e.started = true;
    e.t0 = clock.now;
    return true;
  }
  if (!reached(clock.now - e.t0, period, clock)) return true;
  if (!scan_value) e.started = false;
  return false;
}

// A pair of variables. timer1State is a time where `started`, 1 where `last`,
// else 0; timer2State is a time where `out`, 1 where `last_down`, else 0. At
// most one is a time: t0.
bool is_zero(bool time, bool one) { return !time && !one; }

std::int64_t since(const E& e, const ElementClock& clock) {
  // millis() - 0, as long as both are 0.
  return e.started || e.out ? clock.now - e.t0 : clock.now;
}

bool first_half(E& e, bool scan_value, std::int64_t period,
                ElementClock& clock) {
  if (!scan_value) {
    e.out = false;
    e.last_down = false;
    e.started = false;
    e.last = true;
    return false;
  }
  if (!is_zero(e.out, e.last_down)) return false;
  if (e.last) {
    e.last = false;
    e.started = true;
    e.t0 = clock.now;
  } else if (reached(since(e, clock), period, clock)) {
    e.started = false;
    e.last_down = true;
  }
  return true;
}

// True: the second period is active.
bool second_half(E& e, bool scan_value, std::int64_t period,
                 ElementClock& clock) {
  if (!scan_value || !is_zero(e.started, e.last)) return false;
  if (e.last_down) {
    e.last_down = false;
    e.out = true;
    e.t0 = clock.now;
  } else if (reached(since(e, clock), period, clock)) {
    e.out = false;
    e.last = true;
  }
  return true;
}

// `t0` is the beginning of the scan of the last run, which stood anywhere in
// it; so does this one.
bool task_runs(E& e, bool chosen, std::int64_t period, ElementClock& clock) {
  if (!chosen) return false;
  const std::int64_t wait = period - clock.longest_scan + 1;
  if (e.started && !reached(clock.now - e.t0, wait, clock)) return false;
  e.started = true;
  e.t0 = clock.now;
  return true;
}

constexpr std::array<SimulatedOperation, 10> kOperations = {{
    {"timer-plclib", "timerDelay",
     [](E& e, const In& in, ElementClock& clock) -> std::int64_t {
       return on_delay(e, in.bit(0), in.parameter + 1, clock) ? 1 : 0;
     }},
    {"timer-plclib", "timerOn",
     [](E& e, const In& in, ElementClock& clock) -> std::int64_t {
       return off_delay(e, in.bit(0), in.parameter + 1, clock) ? 1 : 0;
     }},
    {"timer-plclib14", "timerOn",
     [](E& e, const In& in, ElementClock& clock) -> std::int64_t {
       return on_delay(e, in.bit(0), in.parameter, clock) ? 1 : 0;
     }},
    {"timer-plclib14", "timerOff",
     [](E& e, const In& in, ElementClock& clock) -> std::int64_t {
       return off_delay(e, in.bit(0), in.parameter, clock) ? 1 : 0;
     }},
    {"timer-plclib14", "timerPulse",
     [](E& e, const In& in, ElementClock& clock) -> std::int64_t {
       return timer_pulse(e, in.bit(0), in.parameter, clock) ? 1 : 0;
     }},
    {"cycle-plclib", "m8013.first",
     [](E& e, const In& in, ElementClock& clock) -> std::int64_t {
       return first_half(e, in.bit(0), in.parameter, clock) ? 1 : 0;
     }},
    {"cycle-plclib", "m8013.second",
     [](E& e, const In& in, ElementClock& clock) -> std::int64_t {
       const bool low = second_half(e, in.bit(0), in.parameter, clock);
       return in.bit(0) && !low ? 1 : 0;
     }},
    {"cycle-plclib14", "timerCycle.first",
     [](E& e, const In& in, ElementClock& clock) -> std::int64_t {
       return first_half(e, in.bit(0), in.parameter, clock) ? 1 : 0;
     }},
    {"cycle-plclib14", "timerCycle.second",
     [](E& e, const In& in, ElementClock& clock) -> std::int64_t {
       return second_half(e, in.bit(0), in.parameter, clock) ? 1 : 0;
     }},
    {"task-plclib", "runs",
     [](E& e, const In& in, ElementClock& clock) -> std::int64_t {
       return task_runs(e, in.bit(0), in.parameter, clock) ? 1 : 0;
     }},
}};

bool is_started(const E& e) { return e.started; }

constexpr std::array<SimulatedShape, 2> kShapes = {{
    {"timer-plclib", is_started,
     [](const E& e, std::int64_t period, std::int64_t now) {
       return e.started && now - e.t0 > period;
     }},
    {"timer-plclib14", is_started,
     [](const E& e, std::int64_t period, std::int64_t now) {
       return e.started && now - e.t0 >= period;
     }},
}};

}  // namespace

SimulatedDialect simulated_plclib() { return {kOperations, kShapes}; }

}  // namespace rung
