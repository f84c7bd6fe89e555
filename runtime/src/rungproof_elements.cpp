// Timers, counters and edges: docs/postfix.md, section 2.
#include "rungproof_bytes.h"
#include "rungproof_format.h"
#include "rungproof_run.h"

namespace rungproof {
namespace {

const uint8_t kFlag0 = 1;
const uint8_t kFlag1 = 2;
const int32_t kWordMax = 0x7fffffff;

// value > 50 * preset, where the product may leave 32 bits.
bool above_fifty_times(int32_t value, int32_t preset) {
  const int32_t most = kWordMax / 50;
  if (preset > most) return false;
  return preset < -most || value > 50 * preset;
}

// C (sim). kFlag0: last up, kFlag1: last down.
Fault count_sim(Run& run, uint8_t& flags, uint32_t& value) {
  const int32_t preset = next32(run);
  const uint8_t reset = pop_bit(run);
  const uint8_t now = static_cast<uint8_t>((pop_bit(run) << 1) | run.bit);
  run.bit = 0;
  if (reset != 0) {
    flags = 0;
    value = 0;
    return Fault::None;
  }
  const uint8_t rising = now & static_cast<uint8_t>(~flags);
  flags = now;
  uint32_t sum = value;
  if (rising == kFlag0 && ++sum == 0x80000000U) return Fault::Overflow;
  if (rising == kFlag1 && sum-- == 0x80000000U) return Fault::Overflow;
  if (to_signed(sum) == preset) run.bit = 1;
  if (above_fifty_times(to_signed(sum), preset)) {
    sum = static_cast<uint32_t>(preset) + 1U;
  }
  value = sum;
  return Fault::None;
}

// Timers and the counter of the yun dialect: a value that grows, and a limit.
struct Limit {
  bool passed;  // by every value: the preset is below zero
  uint32_t value;
  bool reached(uint32_t by) const { return passed || by >= value; }
};

uint8_t step_limited(uint8_t opcode, uint8_t v, const Limit& limit,
                     uint8_t& flags, uint32_t& value) {
  switch (opcode) {
    case kTimerYun:  // kFlag0: started
      if (flags == 0) {
        value = 0;
        flags = v;
      }
      break;
    case kTimerSim:  // kFlag0: started
      if (v == 0 || flags == 0) value = 0;
      flags = v;
      break;
    case kOffDelaySim:  // kFlag0: armed, kFlag1: out
      if (v != 0) {
        flags = kFlag0 | kFlag1;
      } else {
        if ((flags & kFlag0) != 0) value = 0;
        flags &= kFlag1;
      }
      break;
    default:  // kCounterYun; kFlag0: last
      if (v != 0 && flags == 0 && !limit.reached(value)) ++value;
      flags = v;
  }
  uint8_t result = limit.reached(value) ? 1 : 0;
  if (opcode == kTimerYun) result &= v;
  if (opcode == kOffDelaySim) {
    if (v == 0 && result != 0) flags = 0;
    result = flags != 0 ? 1 : 0;
  }
  return result;
}

}  // namespace

Fault step_element(Run& run, uint8_t opcode, uint16_t slot) {
  uint8_t& flags = run.slot_flags[slot];
  uint32_t& value = run.slot_values[slot];
  const uint8_t v = run.bit;
  switch (opcode) {
    case kCounterSim:
      return count_sim(run, flags, value);
    case kTimerYunReset:
      if (v != 0) flags = 0;
      break;
    case kCounterYunReset:
      if (v != 0) value = 0;
      break;
    case kRise:  // kFlag0: last
      run.bit &= flags ^ 1U;
      flags = v;
      break;
    case kFall:
      run.bit = flags & (v ^ 1U);
      flags = v;
      break;
    default: {
      const int32_t preset = next32(run);
      // A yun timer is done when more than its time has passed.
      const Limit limit = {preset < 0, static_cast<uint32_t>(preset) +
                                           (opcode == kTimerYun ? 1U : 0U)};
      run.bit = step_limited(opcode, v, limit, flags, value);
    }
  }
  return Fault::None;
}

}  // namespace rungproof
