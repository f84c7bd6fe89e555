#include "analysis/simulator_elements_matiec.h"

#include <algorithm>
#include <array>

namespace rung {
namespace {

using E = SimulatedElement;
using In = ElementInputs;

// --- matiec: the bodies of lib/timer.txt and lib/counter.txt -----------------

// STATE is `count`: 0 reset, 1 counting, 2 set. PREV_IN is `last`, START_TIME
// `t0`, Q `out`.
constexpr std::int64_t kReset = 0;
constexpr std::int64_t kCounting = 1;
constexpr std::int64_t kSet = 2;

void start_timer(E& e, const ElementClock& clock) {
  e.count = kCounting;
  e.t0 = clock.now;
}

std::int64_t ton(E& e, const In& in, ElementClock& clock) {
  const bool input = in.bit(0);
  if (e.count == kReset && !e.last && input) {
    start_timer(e, clock);
    e.out = false;
  } else if (!input) {
    e.out = false;
    e.count = kReset;
  } else if (e.count == kCounting &&
             reached(clock.now - e.t0, in.parameter, clock)) {
    e.count = kSet;
    e.out = true;
  }
  e.last = input;
  return e.out ? 1 : 0;
}

std::int64_t tof(E& e, const In& in, ElementClock& clock) {
  const bool input = in.bit(0);
  if (e.count == kReset && e.last && !input) {
    start_timer(e, clock);
  } else if (input) {
    e.count = kReset;
  } else if (e.count == kCounting &&
             reached(clock.now - e.t0, in.parameter, clock)) {
    e.count = kSet;
  }
  e.out = input || e.count == kCounting;
  e.last = input;
  return e.out ? 1 : 0;
}

std::int64_t tp(E& e, const In& in, ElementClock& clock) {
  const bool input = in.bit(0);
  if (e.count == kReset && !e.last && input) {
    start_timer(e, clock);
    e.out = true;
  } else if (e.count == kCounting &&
             reached(clock.now - e.t0, in.parameter, clock)) {
    e.count = kSet;
    e.out = false;
  }
  if (e.count == kSet && !input) e.count = kReset;
  e.last = input;
  return e.out ? 1 : 0;
}

std::int64_t timer_value(E& e, const In& in, ElementClock& clock) {
  if (e.count == kSet) return in.parameter;
  return e.count == kCounting ? std::min(clock.now - e.t0, in.parameter) : 0;
}

bool rising(bool& m, bool clk) {
  const bool q = clk && !m;
  m = clk;
  return q;
}

std::int64_t ctu(E& e, const In& in, ElementClock& /*clock*/) {
  const bool cu = rising(e.last, in.bit(0));
  const std::int64_t pv = in.value[2];
  if (in.bit(1)) {
    e.count = 0;
  } else if (cu && e.count < pv) {
    ++e.count;
  }
  e.out = e.count >= pv;
  return e.out ? 1 : 0;
}

std::int64_t ctd(E& e, const In& in, ElementClock& /*clock*/) {
  const bool cd = rising(e.last, in.bit(0));
  if (in.bit(1)) {
    e.count = in.value[2];
  } else if (cd && e.count > 0) {
    --e.count;
  }
  e.out = e.count <= 0;
  return e.out ? 1 : 0;
}

std::int64_t ctud(E& e, const In& in, ElementClock& /*clock*/) {
  const bool cd = rising(e.last_down, in.bit(1));
  const bool cu = rising(e.last, in.bit(0));
  const std::int64_t pv = in.value[4];
  if (in.bit(2)) {
    e.count = 0;
  } else if (in.bit(3)) {
    e.count = pv;
  } else if (!(cu && cd)) {
    if (cu && e.count < pv) {
      ++e.count;
    } else if (cd && e.count > 0) {
      --e.count;
    }
  }
  e.out = e.count >= pv;
  return e.out ? 1 : 0;
}

std::int64_t count_value(E& e, const In& /*in*/, ElementClock& /*clock*/) {
  return e.count;
}

// --- ESBMC-PLC: timers count scans, the first one included -------------------

// `t0` is the last scan in which nothing was timed.
std::int64_t scan_ton(E& e, const In& in, ElementClock& clock) {
  if (!in.bit(0)) e.t0 = clock.now;
  e.out = in.bit(0) && reached(clock.now - e.t0, in.parameter, clock);
  return e.out ? 1 : 0;
}

std::int64_t scan_tof(E& e, const In& in, ElementClock& clock) {
  if (in.bit(0)) {
    e.t0 = clock.now;
    e.out = true;
  } else if (e.out) {
    e.out = !reached(clock.now - e.t0, in.parameter, clock);
  }
  return e.out ? 1 : 0;
}

std::int64_t scan_value(E& e, const In& in, ElementClock& clock) {
  const std::int64_t elapsed = clock.now - e.t0;
  return reached(elapsed, in.parameter, clock) ? in.parameter : elapsed;
}

std::int64_t scan_falling(E& e, const In& in, ElementClock& /*clock*/) {
  const bool q = e.last && !in.bit(0);
  e.last = in.bit(0);
  return q ? 1 : 0;
}

constexpr std::array<SimulatedOperation, 20> kOperations = {{
    {"ton-matiec", "TON", ton},
    {"ton-matiec", "TON.ET", timer_value},
    {"tof-matiec", "TOF", tof},
    {"tof-matiec", "TOF.ET", timer_value},
    {"tp-matiec", "TP", tp},
    {"tp-matiec", "TP.ET", timer_value},
    {"ctu-matiec", "CTU", ctu},
    {"ctu-matiec", "CTU.CV", count_value},
    {"ctd-matiec", "CTD", ctd},
    {"ctd-matiec", "CTD.CV", count_value},
    {"ctud-matiec", "CTUD", ctud},
    {"ctud-matiec", "CTUD.QD",
     [](E& e, const In&, ElementClock&) -> std::int64_t {
       return e.count <= 0 ? 1 : 0;
     }},
    {"ctud-matiec", "CTUD.CV", count_value},
    {"ton-esbmc", "TON", scan_ton},
    {"ton-esbmc", "TON.ET", scan_value},
    {"tof-esbmc", "TOF", scan_tof},
    {"tof-esbmc", "TOF.ET", scan_value},
    {"tp-esbmc", "TP", scan_ton},
    {"tp-esbmc", "TP.ET", scan_value},
    {"f-trig-esbmc", "F_TRIG", scan_falling},
}};

bool is_counting(const E& e) { return e.count == kCounting; }
bool is_always(const E& /*e*/) { return true; }
bool is_out(const E& e, std::int64_t /*parameter*/, std::int64_t /*now*/) {
  return e.out;
}

constexpr std::array<SimulatedShape, 9> kShapes = {{
    {"ton-matiec", is_counting, is_out},
    {"tof-matiec", is_counting, is_out},
    {"tp-matiec", is_counting, is_out},
    {"ctu-matiec", nullptr, is_out},
    {"ctd-matiec", nullptr, is_out},
    {"ctud-matiec", nullptr, is_out},
    {"ton-esbmc", is_always, is_out},
    {"tof-esbmc", is_always, is_out},
    {"tp-esbmc", is_always, is_out},
}};

}  // namespace

SimulatedDialect simulated_matiec() { return {kOperations, kShapes}; }

}  // namespace rung
