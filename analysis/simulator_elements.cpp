#include "analysis/simulator_elements.h"

#include <algorithm>
#include <array>

#include "analysis/simulator_elements_iec.h"

namespace rung {
namespace {

struct CodeRow {
  std::string_view kind;
  std::string_view operation;
  ElementCode code;
};
constexpr std::array<CodeRow, 27> kCodes = {{
    {"timer-yun", "T", ElementCode::TimerYun},
    {"timer-yun", "TR", ElementCode::TimerYunReset},
    {"timer-sim", "T", ElementCode::TimerSim},
    {"timer-off-sim", "TOF", ElementCode::TimerOffSim},
    {"counter-yun", "C", ElementCode::CounterYun},
    {"counter-yun", "Cnt", ElementCode::CounterYun},
    {"counter-yun", "CR", ElementCode::CounterYunReset},
    {"counter-sim", "C", ElementCode::CounterSim},
    {"edge", "RISE", ElementCode::Rise},
    {"edge", "FALL", ElementCode::Fall},
    {"ton", "TON", ElementCode::OnDelay},
    {"ton", "TON.ET", ElementCode::TimerElapsed},
    {"tof", "TOF", ElementCode::OffDelay},
    {"tof", "TOF.ET", ElementCode::TimerElapsed},
    {"tp", "TP", ElementCode::Pulse},
    {"tp", "TP.ET", ElementCode::TimerElapsed},
    {"ctu", "CTU", ElementCode::CountUp},
    {"ctu", "CTU.CV", ElementCode::CountValue},
    {"ctd", "CTD", ElementCode::CountDown},
    {"ctd", "CTD.CV", ElementCode::CountValue},
    {"ctud", "CTUD", ElementCode::CountUpDown},
    {"ctud", "CTUD.QD", ElementCode::CountedDown},
    {"ctud", "CTUD.CV", ElementCode::CountValue},
    {"r-trig", "R_TRIG", ElementCode::RisingTrigger},
    {"f-trig", "F_TRIG", ElementCode::FallingTrigger},
    {"sr", "SR", ElementCode::SetDominant},
    {"rs", "RS", ElementCode::ResetDominant},
}};

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

}  // namespace

std::optional<ElementCode> find_element_code(
    const ElementKind& kind, const ElementOperation& operation) {
  for (const CodeRow& row : kCodes) {
    if (row.kind == kind.id && row.operation == operation.name) return row.code;
  }
  return std::nullopt;
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

std::int64_t execute_element(ElementCode code, SimulatedElement& element,
                             const ElementInputs& inputs, ElementClock& clock) {
  const std::int64_t parameter = inputs.parameter;
  const bool v = inputs.bit(0);
  switch (code) {
    case ElementCode::TimerYun:
      return timer_yun(element, parameter, v, clock) ? 1 : 0;
    case ElementCode::TimerYunReset:
      return timer_yun_reset(element, v) ? 1 : 0;
    case ElementCode::TimerSim:
      return timer_sim(element, parameter, v, clock) ? 1 : 0;
    case ElementCode::TimerOffSim:
      return timer_off_sim(element, parameter, v, clock) ? 1 : 0;
    case ElementCode::CounterYun:
      return counter_yun(element, parameter, v) ? 1 : 0;
    case ElementCode::CounterYunReset:
      return counter_yun_reset(element, v) ? 1 : 0;
    case ElementCode::CounterSim:
      return counter_sim(element, parameter, v, inputs.bit(1), inputs.bit(2))
                 ? 1
                 : 0;
    case ElementCode::Rise:
      return edge(element, v, true) ? 1 : 0;
    case ElementCode::Fall:
      return edge(element, v, false) ? 1 : 0;
    case ElementCode::OnDelay:
    case ElementCode::OffDelay:
    case ElementCode::Pulse:
    case ElementCode::TimerElapsed:
    case ElementCode::CountUp:
    case ElementCode::CountDown:
    case ElementCode::CountUpDown:
    case ElementCode::CountedDown:
    case ElementCode::CountValue:
    case ElementCode::RisingTrigger:
    case ElementCode::FallingTrigger:
    case ElementCode::SetDominant:
    case ElementCode::ResetDominant:
      return execute_block(code, element, inputs, clock);
  }
  return 0;
}

std::optional<ElementShape> shape_of(ElementCode code) {
  switch (code) {
    case ElementCode::TimerYun:
    case ElementCode::TimerYunReset:
      return ElementShape::TimerYun;
    case ElementCode::TimerSim:
      return ElementShape::TimerSim;
    case ElementCode::TimerOffSim:
      return ElementShape::TimerOffSim;
    case ElementCode::CounterYun:
    case ElementCode::CounterYunReset:
      return ElementShape::CounterYun;
    case ElementCode::CounterSim:
      return ElementShape::CounterSim;
    case ElementCode::OnDelay:
      return ElementShape::OnDelay;
    case ElementCode::OffDelay:
      return ElementShape::OffDelay;
    case ElementCode::Pulse:
      return ElementShape::Pulse;
    case ElementCode::CountUp:
    case ElementCode::CountDown:
    case ElementCode::CountUpDown:
      return ElementShape::Counter;
    case ElementCode::Rise:
    case ElementCode::Fall:
    case ElementCode::RisingTrigger:
    case ElementCode::FallingTrigger:
    case ElementCode::SetDominant:
    case ElementCode::ResetDominant:
      return ElementShape::Edge;
    case ElementCode::TimerElapsed:
    case ElementCode::CountedDown:
    case ElementCode::CountValue:
      return std::nullopt;
  }
  return std::nullopt;
}

bool is_running(ElementShape shape, const SimulatedElement& element) {
  switch (shape) {
    case ElementShape::TimerYun:
    case ElementShape::TimerSim:
      return element.started;
    case ElementShape::TimerOffSim:
      return element.out && !element.started;
    case ElementShape::OnDelay:
    case ElementShape::OffDelay:
    case ElementShape::Pulse:
      return element.started;
    case ElementShape::CounterYun:
    case ElementShape::CounterSim:
    case ElementShape::Counter:
    case ElementShape::Edge:
      return false;
  }
  return false;
}

std::int64_t elapsed_ms(ElementShape shape, const SimulatedElement& element,
                        std::int64_t now) {
  return is_running(shape, element) ? now - element.t0 : 0;
}

bool is_done(ElementShape shape, const SimulatedElement& element,
             std::int64_t parameter, std::int64_t now) {
  switch (shape) {
    case ElementShape::TimerYun:
      return element.started && now - element.t0 > parameter;
    case ElementShape::TimerSim:
      return elapsed_ms(shape, element, now) >= parameter;
    case ElementShape::TimerOffSim:
      return element.out;
    case ElementShape::CounterYun:
      return element.count >= parameter;
    case ElementShape::CounterSim:
      return element.count == parameter;
    case ElementShape::OnDelay:
      return element.last && now - element.t0 >= parameter;
    case ElementShape::OffDelay:
      return element.last || (element.started && now - element.t0 < parameter);
    case ElementShape::Pulse:
      return element.started && now - element.t0 < parameter;
    case ElementShape::Counter:
      return element.out;
    case ElementShape::Edge:
      return false;
  }
  return false;
}

}  // namespace rung
