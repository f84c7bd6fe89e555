#include "analysis/simulator_elements_iec.h"

#include <algorithm>

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

std::int64_t elapsed(const SimulatedElement& e, std::int64_t preset,
                     std::int64_t now) {
  return e.started ? std::min(now - e.t0, preset) : 0;
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

}  // namespace

std::int64_t execute_block(ElementCode code, SimulatedElement& element,
                           const ElementInputs& inputs, ElementClock& clock) {
  switch (code) {
    case ElementCode::OnDelay:
      return on_delay(element, inputs, clock) ? 1 : 0;
    case ElementCode::OffDelay:
      return off_delay(element, inputs, clock) ? 1 : 0;
    case ElementCode::Pulse:
      return pulse(element, inputs, clock) ? 1 : 0;
    case ElementCode::TimerElapsed:
      return elapsed(element, inputs.parameter, clock.now);
    case ElementCode::CountUp:
      return count_up(element, inputs) ? 1 : 0;
    case ElementCode::CountDown:
      return count_down(element, inputs) ? 1 : 0;
    case ElementCode::CountUpDown:
      return count_up_down(element, inputs) ? 1 : 0;
    case ElementCode::CountedDown:
      return element.count <= 0 ? 1 : 0;
    case ElementCode::CountValue:
      return element.count;
    case ElementCode::RisingTrigger:
      return rising(element.last, inputs.bit(0)) ? 1 : 0;
    case ElementCode::FallingTrigger:
      return falling_trigger(element, inputs.bit(0)) ? 1 : 0;
    case ElementCode::SetDominant:
      return set_dominant(element, inputs.bit(0), inputs.bit(1)) ? 1 : 0;
    case ElementCode::ResetDominant:
      return reset_dominant(element, inputs.bit(0), inputs.bit(1)) ? 1 : 0;
    default:
      return 0;  // the scripts' own: execute_element() has them
  }
}

}  // namespace rung
