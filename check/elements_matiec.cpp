#include <array>

#include "check/elements.h"
#include "check/elements_blocks.h"

namespace rung::check {
namespace {

// matiec, from the bodies in lib/timer.txt and lib/counter.txt. STATE is 0, 1
// (`timing`) or 2 (`over`).

constexpr std::size_t kPrev = 0;
constexpr std::size_t kTiming = 1;
constexpr std::size_t kOver = 2;
constexpr std::size_t kElapsed = 3;
constexpr std::array<ElementState, 4> kTimerStates = {
    {{"prev"}, {"timing"}, {"over"}, {"elapsed", StateShape::Clock}}};

Value is_idle(Element& e) { return ~e[kTiming] & ~e[kOver]; }

/// STATE 1 to STATE 2, in the branch that does not start.
Value expires(Element& e, Value starts) {
  return ~starts & e[kTiming] & (e[kElapsed] >= e.preset());
}

/// The clock begins where the timer starts and stands at 0 when it is idle.
void set_state(Element& e, Value starts, Value timing, Value over, Value in) {
  e[kTiming] = timing;
  e[kOver] = over;
  e[kElapsed] = choose(starts | ~timing, 0, e[kElapsed]);
  e[kPrev] = in;
}

/// TON times while its input is true, TOF while it is false.
void delay(Element& e, Value starts, Value goes_on) {
  const Value fires = expires(e, starts) & goes_on;
  const Value stays = ~starts & goes_on;
  set_state(e, starts, starts | (stays & e[kTiming] & ~fires),
            stays & (e[kOver] | fires), e.argument(0));
}

Value ton(Element& e) {
  const Value in = e.argument(0);
  delay(e, is_idle(e) & ~e[kPrev] & in, in);
  return e[kOver];
}

Value tof(Element& e) {
  const Value in = e.argument(0);
  delay(e, is_idle(e) & e[kPrev] & ~in, ~in);
  return in | e[kTiming];
}

Value tp(Element& e) {
  const Value in = e.argument(0);
  const Value starts = is_idle(e) & ~e[kPrev] & in;
  const Value fires = expires(e, starts);
  set_state(e, starts, starts | (e[kTiming] & ~fires), (e[kOver] | fires) & in,
            in);
  return e[kTiming];
}

Value elapsed_time(Element& e) {
  const Value timing = smaller(e[kElapsed], e.preset());
  return choose(e[kOver], e.preset(), choose(~e[kTiming], 0, timing));
}

// --- counters: up to PV, down to 0 -------------------------------------------

Value ctu(Element& e) {
  const Value edge = rises(e, kUpEdge, e.argument(0));
  const Value counts = edge & (e[kCount] < e.argument(2));
  const Value next = choose(counts, e[kCount] + 1, e[kCount]);
  e[kCount] = choose(e.argument(1), 0, next);
  return e[kUpOut] = e[kCount] >= e.argument(2);
}

Value ctd(Element& e) {
  const Value counts = rises(e, kUpEdge, e.argument(0)) & (e[kCount] > 0);
  const Value next = choose(counts, e[kCount] - 1, e[kCount]);
  e[kCount] = choose(e.argument(1), e.argument(2), next);
  return e[kUpOut] = e[kCount] <= 0;
}

// One edge at a time: with both nothing is counted. An up edge at PV does not
// keep a down edge from counting, but there is none in that execution.
Value ctud(Element& e) {
  const Value up = rises(e, kUpEdge, e.argument(0));
  const Value down = rises(e, kDownEdge, e.argument(1));
  const Value counts_up = up & ~down & (e[kCount] < e.argument(4));
  const Value counts_down = down & ~up & (e[kCount] > 0);
  Value next = choose(counts_up, e[kCount] + 1, e[kCount]);
  next = choose(counts_down, e[kCount] - 1, next);
  next = choose(e.argument(3), e.argument(4), next);
  e[kCount] = choose(e.argument(2), 0, next);
  return e[kBothOut] = e[kCount] >= e.argument(4);
}

// --- ESBMC-PLC: its timers count the scan that starts them -------------------

constexpr std::size_t kScanOn = 0;
constexpr std::size_t kScanElapsed = 1;
constexpr std::array<ElementState, 2> kScanStates = {
    {{"on"}, {"elapsed", StateShape::Clock}}};

Value scan_on_delay(Element& e) {
  const Value in = e.argument(0);
  e[kScanElapsed] = choose(~in, 0, e[kScanElapsed]);
  return e[kScanOn] = in & (e[kScanElapsed] >= e.preset());
}

Value scan_off_delay(Element& e) {
  const Value in = e.argument(0);
  e[kScanElapsed] = choose(in, 0, e[kScanElapsed]);
  return e[kScanOn] = in | (e[kScanOn] & (e[kScanElapsed] < e.preset()));
}

Value scan_time(Element& e) { return smaller(e[kScanElapsed], e.preset()); }

constexpr std::array<ElementState, 1> kEdgeStates = {{{"M"}}};

Value falls(Element& e) {
  const Value before = e[0];
  e[0] = e.argument(0);
  return before & ~e[0];
}

constexpr std::array<Operation, 2> kTon = {
    {{"TON", ton}, {"TON.ET", elapsed_time, false}}};
constexpr std::array<Operation, 2> kTof = {
    {{"TOF", tof}, {"TOF.ET", elapsed_time, false}}};
constexpr std::array<Operation, 2> kTp = {
    {{"TP", tp}, {"TP.ET", elapsed_time, false}}};
constexpr std::array<Operation, 2> kCtu = {
    {{"CTU", ctu}, {"CTU.CV", count_value, false}}};
constexpr std::array<Operation, 2> kCtd = {
    {{"CTD", ctd}, {"CTD.CV", count_value, false}}};
constexpr std::array<Operation, 3> kCtud = {{{"CTUD", ctud},
                                             {"CTUD.QD", count_is_zero, false},
                                             {"CTUD.CV", count_value, false}}};
constexpr std::array<Operation, 2> kScanTon = {
    {{"TON", scan_on_delay}, {"TON.ET", scan_time, false}}};
constexpr std::array<Operation, 2> kScanTof = {
    {{"TOF", scan_off_delay}, {"TOF.ET", scan_time, false}}};
constexpr std::array<Operation, 2> kScanTp = {
    {{"TP", scan_on_delay}, {"TP.ET", scan_time, false}}};
constexpr std::array<Operation, 1> kFalling = {{{"F_TRIG", falls}}};

Value is_timing(Element& e) { return e[kTiming]; }
Value is_scan_on(Element& e) { return e[kScanOn]; }
Value always(Element& e) { return e.bit(true); }

constexpr std::array<Kind, 10> kKinds = {{
    {"ton-matiec", kTimerStates, kTon, is_timing,
     [](Element& e) { return e[kOver]; }, kElapsed},
    {"tof-matiec", kTimerStates, kTof, is_timing,
     [](Element& e) { return e[kPrev] | e[kTiming]; }, kElapsed},
    {"tp-matiec", kTimerStates, kTp, is_timing, is_timing, kElapsed},
    {"ctu-matiec", kUpCounterStates, kCtu, nullptr, up_is_out, kCount},
    {"ctd-matiec", kDownCounterStates, kCtd, nullptr, up_is_out, kCount},
    {"ctud-matiec", kBothCounterStates, kCtud, nullptr, both_is_out, kCount},
    {"ton-esbmc", kScanStates, kScanTon, always, is_scan_on, kScanElapsed},
    {"tof-esbmc", kScanStates, kScanTof, always, is_scan_on, kScanElapsed},
    {"tp-esbmc", kScanStates, kScanTp, always, is_scan_on, kScanElapsed},
    {"f-trig-esbmc", kEdgeStates, kFalling},
}};

}  // namespace

std::span<const Kind> matiec_kinds() { return kKinds; }

}  // namespace rung::check
