// Reading a program's bytes where they lie. Internal.
#ifndef RUNGPROOF_BYTES_H
#define RUNGPROOF_BYTES_H

#include "rungproof_types.h"

namespace rungproof {

// Out of line: they are called from everywhere, and flash is scarce.
uint8_t read8(const Source& program, Offset at);
uint16_t read16(const Source& program, Offset at);
uint32_t read32(const Source& program, Offset at);

/// A byte of a table in flash.
inline uint8_t flash_byte(const uint8_t* at) {
#ifdef __AVR__
  return pgm_read_byte(at);
#else
  return *at;
#endif
}

/// `value`, or the end of a word cell's range that is nearest to it. `ranges`
/// is where the program has the ranges of its words.
int32_t in_range(const Source& program, Offset ranges, Offset word,
                 int32_t value);

/// Two's complement: what every compiler does that knows C++11, and C++20 says.
inline int32_t to_signed(uint32_t bits) { return static_cast<int32_t>(bits); }

inline int32_t to_signed16(uint32_t bits) {
  return static_cast<int16_t>(static_cast<uint16_t>(bits));
}

}  // namespace rungproof

#endif
