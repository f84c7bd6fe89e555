#include "rungproof_bytes.h"

#include "rungproof_format.h"

namespace rungproof {

uint8_t read8(const Source& program, Offset at) {
#ifdef __AVR__
  return program.space == Space::Flash ? pgm_read_byte(program.bytes + at)
                                       : program.bytes[at];
#else
  return program.bytes[at];
#endif
}

uint16_t read16(const Source& program, Offset at) {
  const uint16_t high = read8(program, at + 1);
  return static_cast<uint16_t>(read8(program, at) | (high << 8));
}

uint32_t read32(const Source& program, Offset at) {
  return read16(program, at) |
         (static_cast<uint32_t>(read16(program, at + 2)) << 16);
}

int32_t in_range(const Source& program, Offset ranges, Offset word,
                 int32_t value) {
  const Offset at = ranges + Offset{kRangeBytes} * word;
  const int32_t low = to_signed(read32(program, at + 4));
  if (value < low) return low;
  const int32_t high = to_signed(read32(program, at + 8));
  return value > high ? high : value;
}

}  // namespace rungproof
