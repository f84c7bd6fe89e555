#include <array>

#include "check/elements.h"
#include "check/elements_blocks.h"

namespace rung::check {
namespace {

// --- FX family, from its programming manual ----------------------------------

// A coil that is driven times from its second execution on; RST, as long as it
// is driven, holds the device.

constexpr std::size_t kHeld = 0;
constexpr std::size_t kOn = 1;
constexpr std::size_t kOut = 2;
constexpr std::size_t kElapsed = 3;
constexpr std::array<ElementState, 4> kTimerStates = {
    {{"held"}, {"on"}, {"out"}, {"elapsed", StateShape::Clock}}};

Value fx_timer(Element& e) {
  const Value goes_on = e.argument(0) & e[kOn];
  e[kElapsed] = choose(~goes_on, 0, e[kElapsed]);
  e[kOut] = goes_on & (e[kElapsed] >= e.preset());
  e[kOn] = e.argument(0) & ~e[kHeld];
  return e[kOut];
}

Value fx_retentive(Element& e) {
  const Value expires = e.argument(0) & e[kOn] & (e[kElapsed] >= e.preset());
  e[kOut] = e[kOut] | expires;
  e[kOn] = e.argument(0) & ~e[kHeld];
  return e[kOut];
}

Value fx_reset(Element& e) {
  const Value v = e.argument(0);
  e[kHeld] = v;
  e[kOn] = e[kOn] & ~v;
  e[kOut] = e[kOut] & ~v;
  e[kElapsed] = choose(v, 0, e[kElapsed]);
  return e[kOut];
}

std::int64_t at_most_preset(std::int64_t preset) {
  return preset < 0 ? 0 : preset;
}

constexpr std::size_t kLast = 1;
constexpr std::size_t kValue = 3;
constexpr std::array<ElementState, 4> kCounterStates = {
    {{"held"},
     {"last"},
     {"out"},
     {"value", StateShape::Count, nought, at_most_preset}}};

Value fx_counter(Element& e) {
  const Value counts =
      rises(e, kLast, e.argument(0)) & ~e[kHeld] & (e[kValue] < e.preset());
  e[kValue] = choose(counts, e[kValue] + 1, e[kValue]);
  e[kOut] = e[kOut] | (~e[kHeld] & (e[kValue] >= e.preset()));
  return e[kOut];
}

Value fx_counter_reset(Element& e) {
  const Value v = e.argument(0);
  e[kHeld] = v;
  e[kValue] = choose(v, 0, e[kValue]);
  e[kOut] = e[kOut] & ~v;
  return e[kOut];
}

Value fx_value(Element& e) { return e[kValue]; }
Value fx_out(Element& e) { return e[kOut]; }
Value fx_on(Element& e) { return e[kOn]; }

// --- LDmicro, from intcode.cpp -----------------------------------------------

constexpr std::size_t kRuns = 0;
constexpr std::size_t kTime = 1;
constexpr std::array<ElementState, 2> kOnStates = {
    {{"on"}, {"elapsed", StateShape::Clock}}};

Value ld_on_delay(Element& e) {
  const Value in = e.argument(0);
  e[kTime] = choose(~in, 0, e[kTime]);
  e[kRuns] = in;
  return in & (e[kTime] >= e.preset());
}

Value ld_reset(Element& e) {
  const Value v = e.argument(0);
  e[kTime] = choose(v, 0, e[kTime]);
  e[kRuns] = e[kRuns] & ~v;
  return v;
}

constexpr std::size_t kFallen = 1;
constexpr std::size_t kOffTime = 2;
constexpr std::array<ElementState, 3> kOffStates = {
    {{"on"}, {"fallen"}, {"elapsed", StateShape::Clock}}};

Value ld_off_delay(Element& e) {
  const Value in = e.argument(0);
  e[kFallen] = ~in & (e[kRuns] | e[kFallen]);
  e[kOffTime] = choose(in, 0, e[kOffTime]);
  e[kRuns] = in;
  return in | (e[kFallen] & (e[kOffTime] < e.preset()));
}

// It counts again, as if its input had just been true.
Value ld_off_reset(Element& e) {
  const Value v = e.argument(0);
  e[kRuns] = e[kRuns] | v;
  e[kFallen] = e[kFallen] & ~v;
  e[kOffTime] = choose(v, 0, e[kOffTime]);
  return v;
}

Value ld_retentive(Element& e) {
  e[kRuns] = e.argument(0);
  return e[kTime] >= e.preset();
}

constexpr std::array<Operation, 2> kTimer = {
    {{"OUT.T", fx_timer}, {"RST.T", fx_reset, false}}};
constexpr std::array<Operation, 2> kRetentive = {
    {{"OUT.TR", fx_retentive}, {"RST.TR", fx_reset, false}}};
constexpr std::array<Operation, 3> kCounter = {
    {{"OUT.C", fx_counter},
     {"RST.C", fx_counter_reset, false},
     {"C.VALUE", fx_value, false}}};
constexpr std::array<Operation, 2> kLdOn = {
    {{"TON", ld_on_delay}, {"TON.RES", ld_reset, false}}};
constexpr std::array<Operation, 2> kLdOff = {
    {{"TOF", ld_off_delay}, {"TOF.RES", ld_off_reset, false}}};
constexpr std::array<Operation, 2> kLdRetentive = {
    {{"RTO", ld_retentive}, {"RTO.RES", ld_reset, false}}};

Value ld_runs(Element& e) { return e[kRuns]; }

constexpr std::array<Kind, 6> kKinds = {{
    {"timer-melsec", kTimerStates, kTimer, fx_on, fx_out, kElapsed},
    {"timer-retentive-melsec", kTimerStates, kRetentive, fx_on, fx_out,
     kElapsed},
    {"counter-melsec", kCounterStates, kCounter, nullptr, fx_out, kValue},
    {"ton-ldmicro", kOnStates, kLdOn, ld_runs,
     [](Element& e) { return e[kRuns] & (e[kTime] >= e.preset()); }, kTime},
    {"tof-ldmicro", kOffStates, kLdOff, [](Element& e) { return e[kFallen]; },
     [](Element& e) {
       return e[kRuns] | (e[kFallen] & (e[kOffTime] < e.preset()));
     },
     kOffTime},
    {"rto-ldmicro", kOnStates, kLdRetentive, ld_runs,
     [](Element& e) { return e[kTime] >= e.preset(); }, kTime},
}};

}  // namespace

std::span<const Kind> controller_kinds() { return kKinds; }

}  // namespace rung::check
