#include "rungproof_bytes.h"

#ifdef __AVR__
#include <string.h>
#endif

#include "rungproof_format.h"

namespace rungproof {

#ifdef __AVR__

// The controller's byte order is the program's.
uint8_t read8(const Source& program, Offset at) {
  const uint8_t* const from = program.bytes + at;
  return program.space == Space::Flash ? pgm_read_byte(from) : *from;
}

uint16_t read16(const Source& program, Offset at) {
  const uint8_t* const from = program.bytes + at;
  if (program.space == Space::Flash) return pgm_read_word(from);
  uint16_t value;
  memcpy(&value, from, sizeof value);
  return value;
}

uint32_t read32(const Source& program, Offset at) {
  const uint8_t* const from = program.bytes + at;
  if (program.space == Space::Flash) return pgm_read_dword(from);
  uint32_t value;
  memcpy(&value, from, sizeof value);
  return value;
}

#else

uint8_t read8(const Source& program, Offset at) { return program.bytes[at]; }

uint16_t read16(const Source& program, Offset at) {
  const uint8_t* const from = program.bytes + at;
  return static_cast<uint16_t>(from[0] | from[1] << 8);
}

uint32_t read32(const Source& program, Offset at) {
  return read16(program, at) | uint32_t{read16(program, at + 2)} << 16;
}

#endif

int32_t in_range(const Source& program, Offset ranges, Offset word,
                 int32_t value) {
  const Offset at = ranges + Offset{kRangeBytes} * word;
  const int32_t low = to_signed(read32(program, at + 4));
  if (value < low) return low;
  const int32_t high = to_signed(read32(program, at + 8));
  return value > high ? high : value;
}

}  // namespace rungproof
