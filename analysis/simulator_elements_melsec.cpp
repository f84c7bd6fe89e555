#include "analysis/simulator_elements_melsec.h"

#include <array>

namespace rung {
namespace {

// Written from the FX3 programming manual, sections 4.5, 4.6 and 7.13: a
// timer's contact is switched where its coil is executed, and while RST is
// driven the device is kept in the reset status.
//
// started: the coil was driven at its last execution; last_down: kept in reset;
// count: a counter's value, or the ms that a retentive timer has kept.

std::int64_t out_timer(SimulatedElement& e, const ElementInputs& in,
                       ElementClock& clock) {
  if (!in.bit(0)) {
    e.started = false;
    e.out = false;
  } else if (e.started) {
    e.out = reached(clock.now - e.t0, in.parameter, clock);
  } else if (!e.last_down) {
    e.started = true;
    e.t0 = clock.now;
  }
  return e.out ? 1 : 0;
}

std::int64_t out_retentive(SimulatedElement& e, const ElementInputs& in,
                           ElementClock& clock) {
  const bool driven = in.bit(0);
  if (driven && e.started && reached(clock.now - e.t0, in.parameter, clock)) {
    e.out = true;
  }
  if (e.started && !driven) {
    e.count = clock.now - e.t0;
    e.started = false;
  } else if (!e.started && driven && !e.last_down) {
    e.t0 = clock.now - e.count;
    e.started = true;
  }
  return e.out ? 1 : 0;
}

std::int64_t out_counter(SimulatedElement& e, const ElementInputs& in,
                         ElementClock& /*clock*/) {
  const bool counts = in.bit(0) && !e.last;
  e.last = in.bit(0);
  if (e.last_down) return e.out ? 1 : 0;
  if (counts && e.count < in.parameter) e.count = e.count + 1;
  if (e.count >= in.parameter) e.out = true;
  return e.out ? 1 : 0;
}

std::int64_t reset(SimulatedElement& e, const ElementInputs& in,
                   ElementClock& /*clock*/) {
  e.last_down = in.bit(0);
  if (e.last_down) {
    e.started = false;
    e.out = false;
    e.count = 0;
  }
  return e.out ? 1 : 0;
}

std::int64_t counter_value(SimulatedElement& e, const ElementInputs& /*in*/,
                           ElementClock& /*clock*/) {
  return e.count;
}

bool times(const SimulatedElement& e) { return e.started; }

std::int64_t kept(const SimulatedElement& e) { return e.count; }

bool is_on(const SimulatedElement& e, std::int64_t /*parameter*/,
           std::int64_t /*now*/) {
  return e.out;
}

constexpr std::array<SimulatedOperation, 7> kOperations = {{
    {"timer-melsec", "OUT.T", out_timer},
    {"timer-melsec", "RST.T", reset},
    {"timer-retentive-melsec", "OUT.TR", out_retentive},
    {"timer-retentive-melsec", "RST.TR", reset},
    {"counter-melsec", "OUT.C", out_counter},
    {"counter-melsec", "RST.C", reset},
    {"counter-melsec", "C.VALUE", counter_value},
}};

constexpr std::array<SimulatedShape, 3> kShapes = {{
    {.kind = "timer-melsec", .running = times, .done = is_on},
    {.kind = "timer-retentive-melsec",
     .running = times,
     .done = is_on,
     .kept = kept},
    {.kind = "counter-melsec", .done = is_on},
}};

}  // namespace

SimulatedDialect simulated_melsec() { return {kOperations, kShapes}; }

}  // namespace rung
