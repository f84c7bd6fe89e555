// Timers, counters and edges: docs/postfix.md, section 2.
#include "rungproof_bytes.h"
#include "rungproof_format.h"
#include "rungproof_run.h"

namespace rungproof {
namespace {

const uint8_t kFlag0 = 1;
const uint8_t kFlag1 = 2;
const int32_t kWordMax = 0x7fffffff;

// Whether `elapsed` ms have passed `preset`, which may be below zero.
bool past(uint32_t elapsed, int32_t preset) {
  return preset < 0 || elapsed > static_cast<uint32_t>(preset);
}
bool reached(uint32_t elapsed, int32_t preset) {
  return preset <= 0 || past(elapsed, preset - 1);
}

// value > 50 * preset, where the product may leave 32 bits.
bool above_fifty_times(int32_t value, int32_t preset) {
  const int32_t most = kWordMax / 50;
  if (preset > most) return false;
  return preset < -most || value > 50 * preset;
}

// kFlag0: last up, kFlag1: last down.
Fault count_sim(Run& run, int32_t preset, uint8_t& flags, int32_t& count) {
  const uint8_t reset = pop_bit(run);
  const uint8_t down = pop_bit(run);
  const uint8_t up = run.bit;
  run.bit = 0;
  const uint8_t last = flags;
  flags = 0;
  if (reset != 0) {
    count = 0;
    return Fault::None;
  }
  flags = static_cast<uint8_t>(up | (down << 1));
  const uint8_t rising = flags & static_cast<uint8_t>(~last);
  const int8_t change = static_cast<int8_t>((rising & kFlag0) - (rising >> 1));
  if (!add(count, change)) return Fault::Overflow;
  run.bit = count == preset ? 1 : 0;
  if (above_fifty_times(count, preset)) count = preset + 1;
  return Fault::None;
}

}  // namespace

Fault step_element(Run& run, uint8_t opcode, uint16_t slot) {
  int32_t preset = 0;
  if ((shape_of(opcode) & kShapePreset) != 0) preset = next32(run);
  uint8_t flags = run.slot_flags[slot];
  uint32_t counted = run.slot_values[slot];
  Fault fault = Fault::None;
  const uint8_t v = run.bit;
  bool result = v != 0;
  switch (opcode) {
    case kTimerYun:  // kFlag0: started
      if (flags == 0) {
        counted = 0;
        flags = v;
      }
      result = v != 0 && past(counted, preset);
      break;
    case kTimerYunReset:
      if (v != 0) flags = 0;
      break;
    case kTimerSim:  // kFlag0: started
      if (v == 0 || flags == 0) counted = 0;
      flags = v;
      result = reached(counted, preset);
      break;
    case kOffDelaySim:  // kFlag0: armed, kFlag1: out
      if (v != 0) {
        flags = kFlag0 | kFlag1;
      } else {
        if ((flags & kFlag0) != 0) counted = 0;
        flags &= kFlag1;
        if (reached(counted, preset)) flags = 0;
      }
      result = flags != 0;
      break;
    case kCounterYun:  // kFlag0: last; never below 0
      if (v != 0 && flags == 0 && to_signed(counted) < preset) ++counted;
      flags = v;
      result = to_signed(counted) >= preset;
      break;
    case kCounterYunReset:
      if (v != 0) counted = 0;
      break;
    case kCounterSim: {
      int32_t count = to_signed(counted);
      fault = count_sim(run, preset, flags, count);
      counted = static_cast<uint32_t>(count);
      result = run.bit != 0;
      break;
    }
    default:  // kRise, kFall; kFlag0: last
      result = v != flags && v == (opcode == kRise ? 1 : 0);
      flags = v;
  }
  run.slot_flags[slot] = flags;
  run.slot_values[slot] = counted;
  run.bit = result ? 1 : 0;
  return fault;
}

}  // namespace rungproof
