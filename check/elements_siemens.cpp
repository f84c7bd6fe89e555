#include <array>

#include "check/elements.h"
#include "check/elements_blocks.h"

namespace rung::check {
namespace {

// --- S7-300 and S7-400, from the timing diagrams of their statement list -----

constexpr std::size_t kLast = 0;
constexpr std::size_t kTiming = 1;
constexpr std::size_t kElapsed = 2;
constexpr std::array<ElementState, 3> kTimerStates = {
    {{"last"}, {"timing"}, {"elapsed", StateShape::Clock}}};

Value in_time(Element& e) { return e[kTiming] & (e[kElapsed] < e.preset()); }
Value is_over(Element& e) { return e[kTiming] & (e[kElapsed] >= e.preset()); }

/// SI and SE run from a rising edge as long as the result is on.
void run_with_input(Element& e) {
  const Value v = e.argument(0);
  const Value stays = v & e[kLast];
  e[kTiming] = v & (e[kTiming] | ~e[kLast]);
  e[kElapsed] = choose(~stays, 0, e[kElapsed]);
  e[kLast] = v;
}

Value pulse(Element& e) {
  run_with_input(e);
  return in_time(e);
}

Value on_delay(Element& e) {
  run_with_input(e);
  return is_over(e);
}

/// Each rising edge starts it anew; what it does then does not matter.
void start_at_edge(Element& e, std::size_t elapsed) {
  const Value edge = rises(e, kLast, e.argument(0));
  e[kTiming] = e[kTiming] | edge;
  e[elapsed] = choose(edge, 0, e[elapsed]);
}

Value extended_pulse(Element& e) {
  start_at_edge(e, kElapsed);
  return in_time(e);
}

Value reset_timer(Element& e) {
  const Value v = e.argument(0);
  e[kTiming] = e[kTiming] & ~v;
  e[kElapsed] = choose(v, 0, e[kElapsed]);
  return v;
}

constexpr std::size_t kOut = 2;
constexpr std::size_t kKept = 3;  // elapsed
constexpr std::array<ElementState, 4> kStoredStates = {
    {{"last"}, {"timing"}, {"out"}, {"elapsed", StateShape::Clock}}};

Value kept_is_over(Element& e) { return e[kTiming] & (e[kKept] >= e.preset()); }
Value stored_status(Element& e) { return e[kOut] | kept_is_over(e); }
Value off_status(Element& e) { return e[kOut] & ~kept_is_over(e); }

Value stored_delay(Element& e) {
  e[kOut] = stored_status(e);
  start_at_edge(e, kKept);
  return stored_status(e);
}

Value off_delay(Element& e) {
  const Value v = e.argument(0);
  const Value changes = v ^ e[kLast];
  e[kOut] = e[kOut] | changes;
  e[kTiming] = ~v & (e[kTiming] | e[kLast]);
  e[kKept] = choose(v, 0, e[kKept]);
  e[kLast] = v;
  return off_status(e);
}

Value reset_stored(Element& e) {
  const Value v = e.argument(0);
  e[kOut] = e[kOut] & ~v;
  e[kTiming] = e[kTiming] & ~v;
  e[kKept] = choose(v, 0, e[kKept]);
  return v;
}

constexpr std::size_t kLastUp = 0;
constexpr std::size_t kLastDown = 1;
constexpr std::size_t kLastSet = 2;
constexpr std::size_t kLastFree = 3;
constexpr std::size_t kValue = 4;
constexpr std::array<ElementState, 5> kCounterStates = {
    {{"last_up"},
     {"last_down"},
     {"last_set"},
     {"last_free"},
     {"value", StateShape::Count, least_int, most_int}}};

Value is_not_zero(Element& e) { return e[kValue] > 0; }
Value value(Element& e) { return e[kValue]; }

Value count_up(Element& e) {
  const Value counts = rises(e, kLastUp, e.argument(0)) & (e[kValue] < 999);
  e[kValue] = choose(counts, e[kValue] + 1, e[kValue]);
  return is_not_zero(e);
}

Value count_down(Element& e) {
  const Value counts = rises(e, kLastDown, e.argument(0)) & (e[kValue] > 0);
  e[kValue] = choose(counts, e[kValue] - 1, e[kValue]);
  return is_not_zero(e);
}

Value set_count(Element& e) {
  const Value sets = rises(e, kLastSet, e.argument(0));
  e[kValue] = choose(sets, e.argument(1), e[kValue]);
  return is_not_zero(e);
}

Value reset_count(Element& e) {
  e[kValue] = choose(e.argument(0), 0, e[kValue]);
  return e.argument(0);
}

Value release(Element& e) {
  const Value frees = rises(e, kLastFree, e.argument(0));
  for (const std::size_t edge : {kLastUp, kLastDown, kLastSet}) {
    e[edge] = e[edge] & ~frees;
  }
  return is_not_zero(e);
}

// --- Logix, from its instruction reference -----------------------------------

constexpr std::size_t kEnabled = 0;
constexpr std::size_t kSince = 1;
constexpr std::array<ElementState, 2> kOnStates = {
    {{"EN"}, {"elapsed", StateShape::Clock}}};

// The execution that sets EN looks at no time yet.
Value logix_on(Element& e) {
  const Value in = e.argument(0);
  e[kSince] = choose(~in, 0, e[kSince]);
  const Value done = in & e[kEnabled] & (e[kSince] >= e.preset());
  e[kEnabled] = in;
  return done;
}

Value logix_on_reset(Element& e) {
  const Value v = e.argument(0);
  e[kSince] = choose(v, 0, e[kSince]);
  e[kEnabled] = e[kEnabled] & ~v;
  return v;
}

constexpr std::size_t kFallen = 1;
constexpr std::size_t kOffSince = 2;
constexpr std::array<ElementState, 3> kOffStates = {
    {{"EN"}, {"fallen"}, {"elapsed", StateShape::Clock}}};

Value logix_off(Element& e) {
  const Value in = e.argument(0);
  e[kFallen] = ~in & (e[kEnabled] | e[kFallen]);
  e[kOffSince] = choose(in, 0, e[kOffSince]);
  e[kEnabled] = in;
  return in | (e[kFallen] & (e[kOffSince] < e.preset()));
}

std::int64_t at_most_preset(std::int64_t preset) {
  return preset < 0 ? 0 : preset;
}
std::int64_t least_dint(std::int64_t) { return INT32_MIN; }
std::int64_t most_dint(std::int64_t) { return INT32_MAX; }

// ACC grows in executions with EN, by the time since the last one.
constexpr std::size_t kDone = 1;
constexpr std::size_t kAcc = 2;
constexpr std::size_t kLap = 3;
constexpr std::array<ElementState, 4> kRetentiveStates = {
    {{"EN"},
     {"DN"},
     {"ACC", StateShape::Count, nought, at_most_preset},
     {"lap", StateShape::Clock}}};

Value logix_retentive(Element& e) {
  const Value in = e.argument(0);
  const Value times = in & e[kEnabled];
  const Value grown = smaller(e[kAcc] + e[kLap], e.preset());
  e[kAcc] = choose(times, grown, e[kAcc]);
  e[kDone] = e[kDone] | (times & (e[kAcc] >= e.preset()));
  e[kLap] = e.number(0);
  e[kEnabled] = in;
  return e[kDone];
}

Value logix_retentive_reset(Element& e) {
  const Value v = e.argument(0);
  e[kAcc] = choose(v, 0, e[kAcc]);
  e[kDone] = e[kDone] & ~v;
  e[kEnabled] = e[kEnabled] & ~v;
  return v;
}

// Edges are remembered negated: at power-up a true rung is none.
constexpr std::size_t kCounted = 0;
constexpr std::size_t kUpFree = 1;
constexpr std::size_t kDownFree = 2;
constexpr std::array<ElementState, 3> kLogixCounterStates = {
    {{"ACC", StateShape::Count, least_dint, most_dint}, {"up"}, {"down"}}};

Value logix_up(Element& e) {
  const Value counts = e.argument(0) & e[kUpFree];
  const Value next =
      choose(e[kCounted] < INT32_MAX, e[kCounted] + 1, e.number(INT32_MIN));
  e[kCounted] = choose(counts, next, e[kCounted]);
  e[kUpFree] = ~e.argument(0);
  return e[kCounted] >= e.preset();
}

Value logix_down(Element& e) {
  const Value counts = e.argument(0) & e[kDownFree];
  const Value next =
      choose(e[kCounted] > INT32_MIN, e[kCounted] - 1, e.number(INT32_MAX));
  e[kCounted] = choose(counts, next, e[kCounted]);
  e[kDownFree] = ~e.argument(0);
  return e[kCounted] >= e.preset();
}

Value logix_counter_reset(Element& e) {
  const Value v = e.argument(0);
  e[kCounted] = choose(v, 0, e[kCounted]);
  e[kUpFree] = e[kUpFree] | v;
  e[kDownFree] = e[kDownFree] | v;
  return v;
}

Value logix_acc(Element& e) { return e[kCounted]; }

constexpr std::array<Operation, 3> kSi = {
    {{"SI", pulse}, {"SI.Q", in_time, false}, {"SI.R", reset_timer, false}}};
constexpr std::array<Operation, 3> kSv = {{{"SV", extended_pulse},
                                           {"SV.Q", in_time, false},
                                           {"SV.R", reset_timer, false}}};
constexpr std::array<Operation, 3> kSe = {
    {{"SE", on_delay}, {"SE.Q", is_over, false}, {"SE.R", reset_timer, false}}};
constexpr std::array<Operation, 3> kSs = {{{"SS", stored_delay},
                                           {"SS.Q", stored_status, false},
                                           {"SS.R", reset_stored, false}}};
constexpr std::array<Operation, 3> kSa = {{{"SA", off_delay},
                                           {"SA.Q", off_status, false},
                                           {"SA.R", reset_stored, false}}};
constexpr std::array<Operation, 7> kZ = {{{"Z.UP", count_up},
                                          {"Z.DOWN", count_down},
                                          {"Z.S", set_count},
                                          {"Z.R", reset_count, false},
                                          {"Z.FR", release},
                                          {"Z.Q", is_not_zero, false},
                                          {"Z.VALUE", value, false}}};
constexpr std::array<Operation, 2> kTon = {
    {{"TON", logix_on}, {"TON.RES", logix_on_reset, false}}};
constexpr std::array<Operation, 1> kTof = {{{"TOF", logix_off}}};
constexpr std::array<Operation, 2> kRto = {
    {{"RTO", logix_retentive}, {"RTO.RES", logix_retentive_reset, false}}};
constexpr std::array<Operation, 4> kCounter = {
    {{"CTU", logix_up},
     {"CTD", logix_down},
     {"CTU.ACC", logix_acc, false},
     {"CTU.RES", logix_counter_reset, false}}};

Value is_timing(Element& e) { return e[kTiming]; }
Value is_enabled(Element& e) { return e[kEnabled]; }

constexpr std::array<Kind, 10> kKinds = {{
    {"pulse-s7", kTimerStates, kSi, is_timing, in_time, kElapsed},
    {"extended-pulse-s7", kTimerStates, kSv, is_timing, in_time, kElapsed},
    {"delay-s7", kTimerStates, kSe, is_timing, is_over, kElapsed},
    {"stored-delay-s7", kStoredStates, kSs, is_timing, stored_status, kKept},
    {"off-delay-s7", kStoredStates, kSa, is_timing, off_status, kKept},
    {"counter-s7", kCounterStates, kZ, nullptr, is_not_zero, kValue},
    {"ton-logix", kOnStates, kTon, is_enabled,
     [](Element& e) { return e[kEnabled] & (e[kSince] >= e.preset()); },
     kSince},
    {"tof-logix", kOffStates, kTof, [](Element& e) { return e[kFallen]; },
     [](Element& e) {
       return e[kEnabled] | (e[kFallen] & (e[kOffSince] < e.preset()));
     },
     kOffSince},
    {"rto-logix", kRetentiveStates, kRto, is_enabled,
     [](Element& e) { return e[kDone]; }, kAcc},
    {"counter-logix", kLogixCounterStates, kCounter, nullptr,
     [](Element& e) { return e[kCounted] >= e.preset(); }, kCounted},
}};

}  // namespace

std::span<const Kind> siemens_kinds() { return kKinds; }

}  // namespace rung::check
