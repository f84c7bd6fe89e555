#include <array>

#include "check/elements.h"

namespace rung::check {
namespace {

// plcLib, the thesis's and the published one, from their listings. A timer is
// a variable: 0 when idle, else millis() at its start. `started`: it is not 0.

constexpr std::size_t kStarted = 0;
constexpr std::size_t kElapsed = 1;
constexpr std::array<ElementState, 2> kTimerStates = {
    {{"started"}, {"elapsed", StateShape::Clock}}};

/// The execution that sets the variable gives false; later ones give whether
/// the time has come. Returns: does a later one look at it?
Value runs_on(Element& e) {
  const Value v = e.argument(0);
  const Value looks = v & e[kStarted];
  e[kElapsed] = choose(~looks, 0, e[kElapsed]);
  e[kStarted] = v;
  return looks;
}

Value thesis_on_delay(Element& e) {
  const Value looks = runs_on(e);
  return looks & (e[kElapsed] > e.preset());
}

Value published_on_delay(Element& e) {
  const Value looks = runs_on(e);
  return looks & (e[kElapsed] >= e.preset());
}

/// The variable is set while the input is true and never cleared.
Value was_started(Element& e) {
  const Value v = e.argument(0);
  const Value before = e[kStarted];
  e[kElapsed] = choose(v, 0, e[kElapsed]);
  e[kStarted] = e[kStarted] | v;
  return before;
}

Value thesis_off_delay(Element& e) {
  const Value before = was_started(e);
  return e.argument(0) | (before & (e[kElapsed] <= e.preset()));
}

Value published_off_delay(Element& e) {
  const Value before = was_started(e);
  return e.argument(0) | (before & (e[kElapsed] < e.preset()));
}

Value pulse(Element& e) {
  const Value v = e.argument(0);
  const Value begins = ~e[kStarted] & v;
  const Value in_time = e[kStarted] & (e[kElapsed] < e.preset());
  const Value over = e[kStarted] & ~in_time;
  const Value ends = over & ~v;
  const Value goes_on = e[kStarted] & ~ends;
  e[kElapsed] = choose(~goes_on, 0, e[kElapsed]);
  e[kStarted] = begins | goes_on;
  return begins | in_time;
}

// --- a pair of variables: m8013, timerCycle ----------------------------------

// (T1, T2): (0, 0) at first; (1, 0) `armed`; (t, 0) `first`; (0, 1) `turn`;
// (0, t) `second`. With both 0 the time since power-up is what is compared.

constexpr std::size_t kArmed = 0;
constexpr std::size_t kFirst = 1;
constexpr std::size_t kTurn = 2;
constexpr std::size_t kSecond = 3;
constexpr std::size_t kTime = 4;
constexpr std::array<ElementState, 5> kCycleStates = {
    {{"armed"},
     {"first"},
     {"turn"},
     {"second"},
     {"elapsed", StateShape::Clock}}};

/// `if (T2 == 0) { if (T1 == 1) T1 = millis(); else if (time is over) ... }`.
Value first_half(Element& e) {
  const Value v = e.argument(0);
  const Value second_is_zero = ~e[kTurn] & ~e[kSecond];
  const Value in_half = v & second_is_zero;
  const Value starts = v & e[kArmed];
  const Value over = in_half & ~e[kArmed] & (e[kTime] >= e.preset());
  e[kTime] = choose(starts | ~v, 0, e[kTime]);
  e[kFirst] = v & (starts | (e[kFirst] & ~over));
  e[kTurn] = v & (e[kTurn] | over);
  e[kSecond] = v & e[kSecond];
  e[kArmed] = ~v;
  return in_half;
}

/// `if (T1 == 0) { if (T2 == 1) T2 = millis(); else if (time is over) ... }`.
Value in_second_half(Element& e) {
  const Value active = e.argument(0) & ~e[kArmed] & ~e[kFirst];
  const Value starts = active & e[kTurn];
  const Value over = active & ~e[kTurn] & (e[kTime] >= e.preset());
  e[kTime] = choose(starts | over, 0, e[kTime]);
  e[kSecond] = starts | (e[kSecond] & ~over);
  e[kArmed] = e[kArmed] | over;
  e[kTurn] = e[kTurn] & ~active;
  return active;
}

Value m8013_second(Element& e) {
  const Value low = in_second_half(e);
  return e.argument(0) & ~low;
}

// --- tasks -------------------------------------------------------------------

// A run stands anywhere in its scan, so the next one may be up to the longest
// scan further away than the beginnings of the two scans.
Value task_runs(Element& e) {
  const Value may =
      ~e[kStarted] | (e[kElapsed] + e.longest_scan() > e.preset());
  const Value runs = e.argument(0) & may;
  e[kElapsed] = choose(runs, 0, e[kElapsed]);
  e[kStarted] = e[kStarted] | runs;
  return runs;
}

constexpr std::array<ElementState, 2> kTaskStates = {
    {{"ran"}, {"elapsed", StateShape::Clock}}};

constexpr std::array<Operation, 2> kThesis = {
    {{"timerDelay", thesis_on_delay}, {"timerOn", thesis_off_delay}}};
constexpr std::array<Operation, 3> kPublished = {
    {{"timerOn", published_on_delay},
     {"timerOff", published_off_delay},
     {"timerPulse", pulse}}};
constexpr std::array<Operation, 2> kPulsing = {
    {{"m8013.first", first_half, false}, {"m8013.second", m8013_second}}};
constexpr std::array<Operation, 2> kCycle = {
    {{"timerCycle.first", first_half, false},
     {"timerCycle.second", in_second_half}}};
constexpr std::array<Operation, 1> kTask = {{{"runs", task_runs}}};

Value is_started(Element& e) { return e[kStarted]; }
Value cycle_runs(Element& e) { return ~e[kArmed] & ~e[kTurn]; }

constexpr std::array<Kind, 5> kKinds = {{
    {"timer-plclib", kTimerStates, kThesis, is_started,
     [](Element& e) { return e[kStarted] & (e[kElapsed] > e.preset()); },
     kElapsed},
    {"timer-plclib14", kTimerStates, kPublished, is_started,
     [](Element& e) { return e[kStarted] & (e[kElapsed] >= e.preset()); },
     kElapsed},
    {"cycle-plclib", kCycleStates, kPulsing, cycle_runs},
    {"cycle-plclib14", kCycleStates, kCycle, cycle_runs},
    {"task-plclib", kTaskStates, kTask, is_started},
}};

}  // namespace

std::span<const Kind> plclib_kinds() { return kKinds; }

}  // namespace rung::check
