#include "analysis/simulator_elements_iec.h"

#include <algorithm>
#include <array>

namespace rung {
namespace {

// Written from the bodies and diagrams of IEC 61131-3, section 2.5.2.3.

constexpr std::int64_t kPvMin = -32'768;
constexpr std::int64_t kPvMax = 32'767;

// M: the CLK of the execution before.
bool rising(bool& m, bool clk) {
  const bool q = clk && !m;
  m = clk;
  return q;
}

bool on_delay(SimulatedElement& e, const ElementInputs& in,
              ElementClock& clock) {
  const bool v = in.bit(0);
  if (rising(e.last, v)) e.t0 = clock.now;
  e.started = v;
  return v && reached(clock.now - e.t0, in.parameter, clock);
}

bool off_delay(SimulatedElement& e, const ElementInputs& in,
               ElementClock& clock) {
  const bool was = e.last;
  e.last = in.bit(0);
  if (e.last) {
    e.started = false;
    return true;
  }
  if (was) {
    e.t0 = clock.now;
    e.started = true;
  }
  return e.started && !reached(clock.now - e.t0, in.parameter, clock);
}

// A pulse that has ended waits for IN to be false.
bool pulse(SimulatedElement& e, const ElementInputs& in, ElementClock& clock) {
  if (!e.started) {
    if (!in.bit(0)) return false;
    e.started = true;
    e.t0 = clock.now;
  }
  if (!reached(clock.now - e.t0, in.parameter, clock)) return true;
  if (!in.bit(0)) e.started = false;
  return false;
}

std::int64_t timer_value(SimulatedElement& e, const ElementInputs& in,
                         ElementClock& clock) {
  return e.started ? std::min(clock.now - e.t0, in.parameter) : 0;
}

std::int64_t count_value(SimulatedElement& e, const ElementInputs& /*in*/,
                         ElementClock& /*clock*/) {
  return e.count;
}

// CTU: CU, R, PV.
bool count_up(SimulatedElement& e, const ElementInputs& in) {
  const bool cu = rising(e.last, in.bit(0));
  if (in.bit(1)) {
    e.count = 0;
  } else if (cu && e.count < kPvMax) {
    e.count = e.count + 1;
  }
  e.out = e.count >= in.value[2];
  return e.out;
}

// CTD: CD, LD, PV.
bool count_down(SimulatedElement& e, const ElementInputs& in) {
  const bool cd = rising(e.last, in.bit(0));
  if (in.bit(1)) {
    e.count = in.value[2];
  } else if (cd && e.count > kPvMin) {
    e.count = e.count - 1;
  }
  e.out = e.count <= 0;
  return e.out;
}

// CTUD: CU, CD, R, LD, PV.
bool count_up_down(SimulatedElement& e, const ElementInputs& in) {
  const bool cu = rising(e.last, in.bit(0));
  const bool cd = rising(e.last_down, in.bit(1));
  if (in.bit(2)) {
    e.count = 0;
  } else if (in.bit(3)) {
    e.count = in.value[4];
  } else if (!(cu && cd)) {
    if (cu && e.count < kPvMax) {
      e.count = e.count + 1;
    } else if (cd && e.count > kPvMin) {
      e.count = e.count - 1;
    }
  }
  e.out = e.count >= in.value[4];
  return e.out;
}

// F_TRIG keeps the negation of CLK, which is false at first: there a CLK that
// never was true falls.
bool falling_trigger(SimulatedElement& e, bool clk) {
  return rising(e.last, !clk);
}

bool set_dominant(SimulatedElement& e, bool s1, bool r) {
  if (r) e.out = false;
  if (s1) e.out = true;
  return e.out;
}

bool reset_dominant(SimulatedElement& e, bool s, bool r1) {
  if (s) e.out = true;
  if (r1) e.out = false;
  return e.out;
}

using E = SimulatedElement;
using In = ElementInputs;

constexpr std::array<SimulatedOperation, 17> kOperations = {{
    {"ton", "TON",
     [](E& e, const In& in, ElementClock& clock) -> std::int64_t {
       return on_delay(e, in, clock) ? 1 : 0;
     }},
    {"ton", "TON.ET", timer_value},
    {"tof", "TOF",
     [](E& e, const In& in, ElementClock& clock) -> std::int64_t {
       return off_delay(e, in, clock) ? 1 : 0;
     }},
    {"tof", "TOF.ET", timer_value},
    {"tp", "TP",
     [](E& e, const In& in, ElementClock& clock) -> std::int64_t {
       return pulse(e, in, clock) ? 1 : 0;
     }},
    {"tp", "TP.ET", timer_value},
    {"ctu", "CTU",
     [](E& e, const In& in, ElementClock&) -> std::int64_t {
       return count_up(e, in) ? 1 : 0;
     }},
    {"ctu", "CTU.CV", count_value},
    {"ctd", "CTD",
     [](E& e, const In& in, ElementClock&) -> std::int64_t {
       return count_down(e, in) ? 1 : 0;
     }},
    {"ctd", "CTD.CV", count_value},
    {"ctud", "CTUD",
     [](E& e, const In& in, ElementClock&) -> std::int64_t {
       return count_up_down(e, in) ? 1 : 0;
     }},
    {"ctud", "CTUD.QD",
     [](E& e, const In&, ElementClock&) -> std::int64_t {
       return e.count <= 0 ? 1 : 0;
     }},
    {"ctud", "CTUD.CV", count_value},
    {"r-trig", "R_TRIG",
     [](E& e, const In& in, ElementClock&) -> std::int64_t {
       return rising(e.last, in.bit(0)) ? 1 : 0;
     }},
    {"f-trig", "F_TRIG",
     [](E& e, const In& in, ElementClock&) -> std::int64_t {
       return falling_trigger(e, in.bit(0)) ? 1 : 0;
     }},
    {"sr", "SR",
     [](E& e, const In& in, ElementClock&) -> std::int64_t {
       return set_dominant(e, in.bit(0), in.bit(1)) ? 1 : 0;
     }},
    {"rs", "RS",
     [](E& e, const In& in, ElementClock&) -> std::int64_t {
       return reset_dominant(e, in.bit(0), in.bit(1)) ? 1 : 0;
     }},
}};

bool is_started(const E& e) { return e.started; }
bool is_out(const E& e, std::int64_t /*parameter*/, std::int64_t /*now*/) {
  return e.out;
}

constexpr std::array<SimulatedShape, 6> kShapes = {{
    {"ton", is_started,
     [](const E& e, std::int64_t preset, std::int64_t now) {
       return e.last && now - e.t0 >= preset;
     }},
    {"tof", is_started,
     [](const E& e, std::int64_t preset, std::int64_t now) {
       return e.last || (e.started && now - e.t0 < preset);
     }},
    {"tp", is_started,
     [](const E& e, std::int64_t preset, std::int64_t now) {
       return e.started && now - e.t0 < preset;
     }},
    {"ctu", nullptr, is_out},
    {"ctd", nullptr, is_out},
    {"ctud", nullptr, is_out},
}};

}  // namespace

SimulatedDialect simulated_iec() { return {kOperations, kShapes}; }

}  // namespace rung
