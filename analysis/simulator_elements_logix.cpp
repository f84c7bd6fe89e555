#include "analysis/simulator_elements_logix.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>

namespace rung {
namespace {

// Written from the flow charts of TON, TOF, RTO and RES in the instructions
// manual (1756-RM003). `started` is EN, `out` DN, `count` ACC of an RTO.

using E = SimulatedElement;
using In = ElementInputs;

std::int64_t on_delay(E& e, const In& in, ElementClock& clock) {
  if (!in.bit(0)) {
    e.started = false;
    return 0;
  }
  if (!e.started) {
    e.started = true;
    e.t0 = clock.now;
    return 0;
  }
  return reached(clock.now - e.t0, in.parameter, clock) ? 1 : 0;
}

// `last`: EN; `started`: it times.
std::int64_t off_delay(E& e, const In& in, ElementClock& clock) {
  if (in.bit(0)) {
    e.last = true;
    e.started = false;
    return 1;
  }
  if (e.last) {
    e.last = false;
    e.started = true;
    e.t0 = clock.now;
  }
  return e.started && !reached(clock.now - e.t0, in.parameter, clock) ? 1 : 0;
}

// t0: the execution before.
std::int64_t retentive(E& e, const In& in, ElementClock& clock) {
  if (in.bit(0) && e.started) {
    e.count = std::min(e.count + clock.now - e.t0, in.parameter);
    if (e.count >= in.parameter) e.out = true;
  }
  e.started = in.bit(0);
  e.t0 = clock.now;
  return e.out ? 1 : 0;
}

std::int64_t reset(E& e, const In& in, ElementClock& /*clock*/) {
  if (in.bit(0)) {
    e.started = false;
    e.out = false;
    e.count = 0;
  }
  return in.bit(0) ? 1 : 0;
}

// CU and CD are set before the first scan: `last` and `last_down` are false
// where they are.
std::int64_t count(E& e, const In& in, bool& idle, std::int64_t by) {
  constexpr std::int64_t kTop = std::numeric_limits<std::int32_t>::max();
  constexpr std::int64_t kBottom = std::numeric_limits<std::int32_t>::min();
  if (in.bit(0) && idle) e.count += by;
  if (e.count > kTop) e.count = kBottom;
  if (e.count < kBottom) e.count = kTop;
  idle = !in.bit(0);
  return e.count >= in.parameter ? 1 : 0;
}

std::int64_t count_up(E& e, const In& in, ElementClock& /*clock*/) {
  return count(e, in, e.last, 1);
}

std::int64_t count_down(E& e, const In& in, ElementClock& /*clock*/) {
  return count(e, in, e.last_down, -1);
}

std::int64_t reset_counter(E& e, const In& in, ElementClock& /*clock*/) {
  if (in.bit(0)) {
    e.count = 0;
    e.last = true;
    e.last_down = true;
  }
  return in.bit(0) ? 1 : 0;
}

constexpr std::array<SimulatedOperation, 9> kOperations = {{
    {"ton-logix", "TON", on_delay},
    {"ton-logix", "TON.RES", reset},
    {"tof-logix", "TOF", off_delay},
    {"rto-logix", "RTO", retentive},
    {"rto-logix", "RTO.RES", reset},
    {"counter-logix", "CTU", count_up},
    {"counter-logix", "CTD", count_down},
    {"counter-logix", "CTU.ACC",
     [](E& e, const In&, ElementClock&) { return e.count; }},
    {"counter-logix", "CTU.RES", reset_counter},
}};

bool is_started(const E& e) { return e.started; }

constexpr std::array<SimulatedShape, 4> kShapes = {{
    {"ton-logix", is_started,
     [](const E& e, std::int64_t preset, std::int64_t now) {
       return e.started && now - e.t0 >= preset;
     }},
    {"tof-logix", is_started,
     [](const E& e, std::int64_t preset, std::int64_t now) {
       return e.last || (e.started && now - e.t0 < preset);
     }},
    {"rto-logix", nullptr,
     [](const E& e, std::int64_t, std::int64_t) { return e.out; },
     [](const E& e) { return e.count; }},
    {"counter-logix", nullptr,
     [](const E& e, std::int64_t preset, std::int64_t) {
       return e.count >= preset;
     }},
}};

}  // namespace

SimulatedDialect simulated_logix() { return {kOperations, kShapes}; }

}  // namespace rung
