// Reading a program's bytes where they lie. Internal.
#ifndef RUNGPROOF_BYTES_H
#define RUNGPROOF_BYTES_H

#include <stdint.h>
#ifdef __AVR__
#include <avr/pgmspace.h>
#endif

#include "rungproof_types.h"

namespace rungproof {

inline uint8_t read8(const Source& program, Offset at) {
#ifdef __AVR__
  return program.space == Space::Flash ? pgm_read_byte(program.bytes + at)
                                       : program.bytes[at];
#else
  return program.bytes[at];
#endif
}

inline uint16_t read16(const Source& program, Offset at) {
  const uint16_t high = read8(program, at + 1);
  return static_cast<uint16_t>(read8(program, at) | (high << 8));
}

inline uint32_t read32(const Source& program, Offset at) {
  return read16(program, at) |
         (static_cast<uint32_t>(read16(program, at + 2)) << 16);
}

/// Two's complement, without relying on how a conversion out of range works.
inline int32_t to_signed(uint32_t bits) {
  return bits <= 0x7fffffffU ? static_cast<int32_t>(bits)
                             : -1 - static_cast<int32_t>(~bits);
}

inline int32_t to_signed16(uint32_t bits) {
  const int32_t low = static_cast<int32_t>(bits & 0xffffU);
  return low < 0x8000 ? low : low - 0x10000;
}

}  // namespace rungproof

#endif
