#include "analysis/simulator_elements_s7.h"

#include <array>

namespace rung {
namespace {

// Written from the timing diagrams of "Statement List for S7-300 and S7-400"
// and from what awlsim does where they say nothing.
//
// last: the result at the last start instruction; started: the time runs or has
// run out; out: the status that SS and SA keep.

using E = SimulatedElement;
using In = ElementInputs;
using Clock = ElementClock;

bool rises(bool& last, bool v) {
  const bool edge = v && !last;
  last = v;
  return edge;
}

void start(E& e, const Clock& clock) {
  e.started = true;
  e.t0 = clock.now;
}

bool is_over(const E& e, std::int64_t preset, Clock& clock) {
  return reached(clock.now - e.t0, preset, clock);
}

std::int64_t pulse_status(E& e, const In& in, Clock& clock) {
  return e.started && !is_over(e, in.parameter, clock) ? 1 : 0;
}

std::int64_t delay_status(E& e, const In& in, Clock& clock) {
  return e.started && is_over(e, in.parameter, clock) ? 1 : 0;
}

std::int64_t stored_status(E& e, const In& in, Clock& clock) {
  return e.out || delay_status(e, in, clock) != 0 ? 1 : 0;
}

std::int64_t off_status(E& e, const In& in, Clock& clock) {
  return e.out && delay_status(e, in, clock) == 0 ? 1 : 0;
}

/// SI and SE: the time runs as long as the result is on.
void run_with_input(E& e, bool v, const Clock& clock) {
  if (rises(e.last, v)) start(e, clock);
  if (!v) e.started = false;
}

std::int64_t pulse(E& e, const In& in, Clock& clock) {
  run_with_input(e, in.bit(0), clock);
  return pulse_status(e, in, clock);
}

std::int64_t delay(E& e, const In& in, Clock& clock) {
  run_with_input(e, in.bit(0), clock);
  return delay_status(e, in, clock);
}

std::int64_t extended(E& e, const In& in, Clock& clock) {
  if (rises(e.last, in.bit(0))) start(e, clock);
  return pulse_status(e, in, clock);
}

std::int64_t stored(E& e, const In& in, Clock& clock) {
  if (delay_status(e, in, clock) != 0) e.out = true;
  if (rises(e.last, in.bit(0))) start(e, clock);
  return stored_status(e, in, clock);
}

std::int64_t off_delay(E& e, const In& in, Clock& clock) {
  const bool was = e.last;
  e.last = in.bit(0);
  if (e.last && !was) {
    e.out = true;
    e.started = false;
  }
  if (was && !e.last) {
    e.out = true;
    start(e, clock);
  }
  return off_status(e, in, clock);
}

std::int64_t reset_timer(E& e, const In& in, Clock& /*clock*/) {
  if (in.bit(0)) {
    e.started = false;
    e.out = false;
  }
  return in.value[0];
}

// Counters: last and last_down are the results at the last ZV and ZR, started
// that at the last S, out that at the last FR.

std::int64_t count_status(E& e, const In& /*in*/, Clock& /*clock*/) {
  return e.count > 0 ? 1 : 0;
}

std::int64_t count_value(E& e, const In& /*in*/, Clock& /*clock*/) {
  return e.count;
}

std::int64_t count_up(E& e, const In& in, Clock& clock) {
  if (rises(e.last, in.bit(0)) && e.count < 999) ++e.count;
  return count_status(e, in, clock);
}

std::int64_t count_down(E& e, const In& in, Clock& clock) {
  if (rises(e.last_down, in.bit(0)) && e.count > 0) --e.count;
  return count_status(e, in, clock);
}

std::int64_t set_count(E& e, const In& in, Clock& clock) {
  if (rises(e.started, in.bit(0))) e.count = in.value[1];
  return count_status(e, in, clock);
}

std::int64_t reset_count(E& e, const In& in, Clock& /*clock*/) {
  if (in.bit(0)) e.count = 0;
  return in.value[0];
}

std::int64_t release(E& e, const In& in, Clock& clock) {
  if (rises(e.out, in.bit(0))) e.last = e.last_down = e.started = false;
  return count_status(e, in, clock);
}

constexpr std::array<SimulatedOperation, 22> kOperations = {{
    {"pulse-s7", "SI", pulse},
    {"pulse-s7", "SI.Q", pulse_status},
    {"pulse-s7", "SI.R", reset_timer},
    {"extended-pulse-s7", "SV", extended},
    {"extended-pulse-s7", "SV.Q", pulse_status},
    {"extended-pulse-s7", "SV.R", reset_timer},
    {"delay-s7", "SE", delay},
    {"delay-s7", "SE.Q", delay_status},
    {"delay-s7", "SE.R", reset_timer},
    {"stored-delay-s7", "SS", stored},
    {"stored-delay-s7", "SS.Q", stored_status},
    {"stored-delay-s7", "SS.R", reset_timer},
    {"off-delay-s7", "SA", off_delay},
    {"off-delay-s7", "SA.Q", off_status},
    {"off-delay-s7", "SA.R", reset_timer},
    {"counter-s7", "Z.UP", count_up},
    {"counter-s7", "Z.DOWN", count_down},
    {"counter-s7", "Z.S", set_count},
    {"counter-s7", "Z.R", reset_count},
    {"counter-s7", "Z.FR", release},
    {"counter-s7", "Z.Q", count_status},
    {"counter-s7", "Z.VALUE", count_value},
}};

bool runs(const E& e) { return e.started; }

bool is_pulse(const E& e, std::int64_t preset, std::int64_t now) {
  return e.started && now - e.t0 < preset;
}

bool is_delayed(const E& e, std::int64_t preset, std::int64_t now) {
  return e.started && now - e.t0 >= preset;
}

constexpr std::array<SimulatedShape, 6> kShapes = {{
    {.kind = "pulse-s7", .running = runs, .done = is_pulse},
    {.kind = "extended-pulse-s7", .running = runs, .done = is_pulse},
    {.kind = "delay-s7", .running = runs, .done = is_delayed},
    {.kind = "stored-delay-s7",
     .running = runs,
     .done =
         [](const E& e, std::int64_t preset, std::int64_t now) {
           return e.out || is_delayed(e, preset, now);
         }},
    {.kind = "off-delay-s7",
     .running = runs,
     .done =
         [](const E& e, std::int64_t preset, std::int64_t now) {
           return e.out && !is_delayed(e, preset, now);
         }},
    {.kind = "counter-s7",
     .done = [](const E& e, std::int64_t,
                std::int64_t) { return e.count > 0; }},
}};

}  // namespace

SimulatedDialect simulated_s7() { return {kOperations, kShapes}; }

}  // namespace rung
