#include <array>

#include "check/elements.h"

namespace rung::check {
namespace {

// The two script dialects, from the listings of their papers (semantics page,
// section 1), and the edges that both have.

constexpr std::size_t kStarted = 0;
constexpr std::size_t kElapsed = 1;

constexpr std::array<ElementState, 2> kTimerStates = {{
    {"started"},
    {"elapsed", StateShape::Clock},
}};

Value is_started(Element& e) { return e[kStarted]; }

// Yun: only TR stops what T started.
Value timer_yun(Element& e) {
  const Value v = e.argument(0);
  const Value starts = v & ~e[kStarted];
  e[kElapsed] = choose(starts, 0, e[kElapsed]);
  e[kStarted] = e[kStarted] | v;
  return v & (e[kElapsed] > e.preset());
}

Value timer_yun_reset(Element& e) {
  const Value v = e.argument(0);
  e[kStarted] = choose(v, e.bit(false), e[kStarted]);
  e[kElapsed] = choose(v, 0, e[kElapsed]);
  return v;
}

// The same where the clock has 32 bits: a call sees the time modulo 2^32.
Value timer_yun_rollover(Element& e) {
  constexpr std::int64_t kTurn = std::int64_t{1} << 32;
  e[kElapsed] = choose(e[kElapsed] >= kTurn, e[kElapsed] - kTurn, e[kElapsed]);
  return timer_yun(e);
}

// Sim: a false input sets the start to now, in every scan.
Value timer_sim(Element& e) {
  const Value v = e.argument(0);
  const Value keeps = v & e[kStarted];
  e[kElapsed] = choose(~keeps, 0, e[kElapsed]);
  e[kStarted] = v;
  return e[kElapsed] >= e.preset();
}

constexpr std::size_t kArmed = 0;
constexpr std::size_t kOut = 1;
constexpr std::size_t kOffElapsed = 2;

constexpr std::array<ElementState, 3> kOffDelayStates = {{
    {"armed"},
    {"out"},
    {"elapsed", StateShape::Clock},
}};

Value off_delay(Element& e) {
  const Value v = e.argument(0);
  const Value falls = ~v & e[kArmed];
  const Value since = choose(falls, 0, e[kOffElapsed]);
  const Value expires = ~v & e[kOut] & (since >= e.preset());
  e[kOut] = v | (e[kOut] & ~expires);
  e[kArmed] = v;
  // Nothing is timed while the input is on, or after the end.
  e[kOffElapsed] = choose(v | ~e[kOut], 0, since);
  return e[kOut];
}

// --- counters ----------------------------------------------------------------

constexpr std::size_t kValue = 0;
constexpr std::size_t kLast = 1;
constexpr std::size_t kLastDown = 2;

std::int64_t zero(std::int64_t) { return 0; }
std::int64_t at_most_preset(std::int64_t preset) {
  return preset < 0 ? 0 : preset;
}

constexpr std::array<ElementState, 2> kCounterYunStates = {{
    {"value", StateShape::Count, zero, at_most_preset},
    {"last"},
}};

Value counter_yun(Element& e) {
  const Value v = e.argument(0);
  const Value counts = (e[kValue] < e.preset()) & v & ~e[kLast];
  e[kValue] = choose(counts, e[kValue] + 1, e[kValue]);
  e[kLast] = v;
  return e[kValue] >= e.preset();
}

Value counter_yun_reset(Element& e) {
  e[kValue] = choose(e.argument(0), 0, e[kValue]);
  return e.argument(0);
}

std::int64_t fifty_fold(std::int64_t preset) {
  return preset < 0 ? 0 : 50 * preset + 1;
}

// It has no lower bound; certificates speak of -32768 where it is below.
constexpr std::array<ElementState, 3> kCounterSimStates = {{
    {"value", StateShape::Count, nullptr, fifty_fold, -32768},
    {"last_up"},
    {"last_down"},
}};

Value counter_sim(Element& e) {
  const Value reset = e.argument(2);
  const Value up = e.argument(0) & ~reset;
  const Value down = e.argument(1) & ~reset;
  Value count = choose(reset, 0, e[kValue]);
  count = choose(up & ~e[kLast], count + 1, count);
  count = choose(down & ~e[kLastDown], count - 1, count);
  const Value result = ~reset & (count == e.preset());
  const Value restarts = ~reset & (count > e.preset() * e.number(50));
  e[kValue] = choose(restarts, e.preset() + 1, count);
  e[kLast] = up;
  e[kLastDown] = down;
  return result;
}

// --- edges -------------------------------------------------------------------

constexpr std::array<ElementState, 1> kEdgeStates = {{{"last"}}};

Value rise(Element& e) {
  const Value before = e[0];
  e[0] = e.argument(0);
  return e[0] & ~before;
}

Value fall(Element& e) {
  const Value before = e[0];
  e[0] = e.argument(0);
  return before & ~e[0];
}

constexpr std::array<Operation, 2> kTimerYun = {
    {{"T", timer_yun}, {"TR", timer_yun_reset, false}}};
constexpr std::array<Operation, 2> kTimerYunRollover = {
    {{"T", timer_yun_rollover}, {"TR", timer_yun_reset, false}}};
constexpr std::array<Operation, 1> kTimerSim = {{{"T", timer_sim}}};
constexpr std::array<Operation, 1> kOffDelay = {{{"TOF", off_delay}}};
constexpr std::array<Operation, 3> kCounterYun = {
    {{"C", counter_yun},
     {"Cnt", counter_yun},
     {"CR", counter_yun_reset, false}}};
constexpr std::array<Operation, 1> kCounterSim = {{{"C", counter_sim}}};
constexpr std::array<Operation, 2> kEdge = {{{"RISE", rise}, {"FALL", fall}}};

Value timer_yun_done(Element& e) {
  return e[kStarted] & (e[kElapsed] > e.preset());
}

constexpr std::array<Kind, 7> kKinds = {{
    {"timer-yun", kTimerStates, kTimerYun, is_started, timer_yun_done,
     kElapsed},
    {"timer-yun-rollover", kTimerStates, kTimerYunRollover, is_started,
     timer_yun_done, kElapsed},
    {"timer-sim", kTimerStates, kTimerSim, is_started,
     [](Element& e) { return e[kElapsed] >= e.preset(); }, kElapsed},
    {"timer-off-sim", kOffDelayStates, kOffDelay,
     [](Element& e) { return e[kOut] & ~e[kArmed]; },
     [](Element& e) { return e[kOut]; }, kOffElapsed},
    {"counter-yun", kCounterYunStates, kCounterYun, nullptr,
     [](Element& e) { return e[kValue] >= e.preset(); }, kValue},
    {"counter-sim", kCounterSimStates, kCounterSim, nullptr,
     [](Element& e) { return e[kValue] == e.preset(); }, kValue},
    {"edge", kEdgeStates, kEdge},
}};

}  // namespace

std::span<const Kind> script_kinds() { return kKinds; }

}  // namespace rung::check
