#include <array>

#include "check/elements.h"
#include "check/elements_blocks.h"

namespace rung::check {
namespace {

// The standard function blocks, from the tables and diagrams of IEC 61131-3,
// section 2.5.2.3. A timer looks at its clock in every execution.

constexpr std::size_t kOn = 0;
constexpr std::size_t kOnElapsed = 1;
constexpr std::array<ElementState, 2> kOnStates = {
    {{"on"}, {"elapsed", StateShape::Clock}}};

Value ton(Element& e) {
  const Value in = e.argument(0);
  e[kOnElapsed] = choose(~in, 0, e[kOnElapsed]);
  e[kOn] = in;
  return in & (e[kOnElapsed] >= e.preset());
}

constexpr std::size_t kFallen = 1;
constexpr std::size_t kOffElapsed = 2;
constexpr std::array<ElementState, 3> kOffStates = {
    {{"on"}, {"fallen"}, {"elapsed", StateShape::Clock}}};

Value tof(Element& e) {
  const Value in = e.argument(0);
  e[kFallen] = ~in & (e[kOn] | e[kFallen]);
  e[kOffElapsed] = choose(in, 0, e[kOffElapsed]);
  e[kOn] = in;
  return in | (e[kFallen] & (e[kOffElapsed] < e.preset()));
}

constexpr std::array<ElementState, 2> kPulseStates = {
    {{"started"}, {"elapsed", StateShape::Clock}}};

Value tp(Element& e) {
  const Value in = e.argument(0);
  const Value runs = e[kOn] | in;
  const Value q = runs & (e[kOnElapsed] < e.preset());
  e[kOn] = q | (runs & in);  // it ends when Q and IN are false
  e[kOnElapsed] = choose(~e[kOn], 0, e[kOnElapsed]);
  return q;
}

Value elapsed_time(Element& e) { return smaller(e[kOnElapsed], e.preset()); }
Value off_elapsed_time(Element& e) {
  return smaller(e[kOffElapsed], e.preset());
}

// --- counters ----------------------------------------------------------------

constexpr std::int64_t kMost = 32767;
constexpr std::int64_t kLeast = -32768;

Value ctu(Element& e) {
  const Value counts = rises(e, kUpEdge, e.argument(0)) & (e[kCount] < kMost);
  const Value next = choose(counts, e[kCount] + 1, e[kCount]);
  e[kCount] = choose(e.argument(1), 0, next);
  return e[kUpOut] = e[kCount] >= e.argument(2);
}

Value ctd(Element& e) {
  const Value counts = rises(e, kUpEdge, e.argument(0)) & (e[kCount] > kLeast);
  const Value next = choose(counts, e[kCount] - 1, e[kCount]);
  e[kCount] = choose(e.argument(1), e.argument(2), next);
  return e[kUpOut] = e[kCount] <= 0;
}

Value ctud(Element& e) {
  const Value up = rises(e, kUpEdge, e.argument(0));
  const Value down = rises(e, kDownEdge, e.argument(1));
  const Value counts_up = up & ~down & (e[kCount] < kMost);
  const Value counts_down = down & ~up & (e[kCount] > kLeast);
  Value next = choose(counts_up, e[kCount] + 1, e[kCount]);
  next = choose(counts_down, e[kCount] - 1, next);
  next = choose(e.argument(3), e.argument(4), next);
  e[kCount] = choose(e.argument(2), 0, next);
  return e[kBothOut] = e[kCount] >= e.argument(4);
}

// --- edges and latches -------------------------------------------------------

constexpr std::array<ElementState, 1> kEdgeStates = {{{"M"}}};

Value r_trig(Element& e) { return rises(e, 0, e.argument(0)); }

// M holds the negation: false before the first execution.
Value f_trig(Element& e) { return rises(e, 0, ~e.argument(0)); }

constexpr std::array<ElementState, 1> kLatchStates = {{{"Q1"}}};

Value sr(Element& e) { return e[0] = e.argument(0) | (~e.argument(1) & e[0]); }

Value rs(Element& e) { return e[0] = ~e.argument(1) & (e.argument(0) | e[0]); }

constexpr std::array<Operation, 2> kTon = {
    {{"TON", ton}, {"TON.ET", elapsed_time, false}}};
constexpr std::array<Operation, 2> kTof = {
    {{"TOF", tof}, {"TOF.ET", off_elapsed_time, false}}};
constexpr std::array<Operation, 2> kTp = {
    {{"TP", tp}, {"TP.ET", elapsed_time, false}}};
constexpr std::array<Operation, 2> kCtu = {
    {{"CTU", ctu}, {"CTU.CV", count_value, false}}};
constexpr std::array<Operation, 2> kCtd = {
    {{"CTD", ctd}, {"CTD.CV", count_value, false}}};
constexpr std::array<Operation, 3> kCtud = {{{"CTUD", ctud},
                                             {"CTUD.QD", count_is_zero, false},
                                             {"CTUD.CV", count_value, false}}};
constexpr std::array<Operation, 1> kRTrig = {{{"R_TRIG", r_trig}}};
constexpr std::array<Operation, 1> kFTrig = {{{"F_TRIG", f_trig}}};
constexpr std::array<Operation, 1> kSr = {{{"SR", sr}}};
constexpr std::array<Operation, 1> kRs = {{{"RS", rs}}};

Value is_on(Element& e) { return e[kOn]; }

constexpr std::array<Kind, 10> kKinds = {{
    {"ton", kOnStates, kTon, is_on,
     [](Element& e) { return e[kOn] & (e[kOnElapsed] >= e.preset()); },
     kOnElapsed},
    {"tof", kOffStates, kTof, [](Element& e) { return e[kFallen]; },
     [](Element& e) {
       return e[kOn] | (e[kFallen] & (e[kOffElapsed] < e.preset()));
     },
     kOffElapsed},
    {"tp", kPulseStates, kTp, is_on,
     [](Element& e) { return e[kOn] & (e[kOnElapsed] < e.preset()); },
     kOnElapsed},
    {"ctu", kUpCounterStates, kCtu, nullptr, up_is_out, kCount},
    {"ctd", kDownCounterStates, kCtd, nullptr, up_is_out, kCount},
    {"ctud", kBothCounterStates, kCtud, nullptr, both_is_out, kCount},
    {"r-trig", kEdgeStates, kRTrig},
    {"f-trig", kEdgeStates, kFTrig},
    {"sr", kLatchStates, kSr},
    {"rs", kLatchStates, kRs},
}};

}  // namespace

std::span<const Kind> iec_kinds() { return kKinds; }

}  // namespace rung::check
