#include "analysis/simulator_elements_ldmicro.h"

#include <array>

namespace rung {
namespace {

// Written from ELEM_TON, ELEM_TOF, ELEM_RTO and ELEM_RES of intcode.cpp. The
// tool increments a variable in each execution that counts; here the variable
// is the time since then, `now - t0`, while it counts (`started`).

using E = SimulatedElement;
using In = ElementInputs;

// IF rung THEN (IF t < P THEN rung := 0; t := t + 1) ELSE t := 0
std::int64_t on_delay(E& e, const In& in, ElementClock& clock) {
  if (!in.bit(0)) {
    e.started = false;
    return 0;
  }
  if (!e.started) e.t0 = clock.now;
  e.started = true;
  return reached(clock.now - e.t0, in.parameter, clock) ? 1 : 0;
}

// IF NOT rung THEN (IF t < P THEN t := t + 1; rung := 1) ELSE t := 0.
// At first t is P: not armed. `last`: t is 0.
std::int64_t off_delay(E& e, const In& in, ElementClock& clock) {
  if (in.bit(0)) {
    e.last = true;
    e.started = false;
    return 1;
  }
  if (e.last) {
    e.t0 = clock.now;
    e.started = true;
    e.last = false;
  }
  if (!e.started) return 0;
  return reached(clock.now - e.t0, in.parameter, clock) ? 0 : 1;
}

// IF t < P THEN (IF rung THEN t := t + 1; rung := 0) ELSE rung := 1.
// `count` is the time that had passed when it stopped.
std::int64_t retentive(E& e, const In& in, ElementClock& clock) {
  std::int64_t passed = e.started ? clock.now - e.t0 : e.count;
  if (!e.started) e.t0 = clock.now - e.count;
  if (e.started && !in.bit(0)) e.count = passed;
  const bool counts = in.bit(0);
  const bool was = e.started;
  e.started = counts;
  if (passed >= in.parameter) return 1;
  if (counts && was) return reached(passed, in.parameter, clock) ? 1 : 0;
  return 0;
}

std::int64_t reset_on(E& e, const In& in, ElementClock& /*clock*/) {
  if (in.bit(0)) {
    e.started = false;
    e.count = 0;
  }
  return in.bit(0) ? 1 : 0;
}

std::int64_t reset_off(E& e, const In& in, ElementClock& /*clock*/) {
  if (in.bit(0)) {
    e.last = true;
    e.started = false;
  }
  return in.bit(0) ? 1 : 0;
}

constexpr std::array<SimulatedOperation, 6> kOperations = {{
    {"ton-ldmicro", "TON", on_delay},
    {"ton-ldmicro", "TON.RES", reset_on},
    {"tof-ldmicro", "TOF", off_delay},
    {"tof-ldmicro", "TOF.RES", reset_off},
    {"rto-ldmicro", "RTO", retentive},
    {"rto-ldmicro", "RTO.RES", reset_on},
}};

bool is_started(const E& e) { return e.started; }

constexpr std::array<SimulatedShape, 3> kShapes = {{
    {"ton-ldmicro", is_started,
     [](const E& e, std::int64_t preset, std::int64_t now) {
       return e.started && now - e.t0 >= preset;
     }},
    {"tof-ldmicro", is_started,
     [](const E& e, std::int64_t preset, std::int64_t now) {
       return e.last || (e.started && now - e.t0 < preset);
     }},
    {"rto-ldmicro", is_started,
     [](const E& e, std::int64_t preset, std::int64_t now) {
       return (e.started ? now - e.t0 : e.count) >= preset;
     },
     [](const E& e) { return e.count; }},
}};

}  // namespace

SimulatedDialect simulated_ldmicro() { return {kOperations, kShapes}; }

}  // namespace rung
