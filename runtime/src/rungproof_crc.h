// CRC-32 of IEEE 802.3, byte by byte and without a table: a table costs more
// flash than a controller has to spare. Internal.
#ifndef RUNGPROOF_CRC_H
#define RUNGPROOF_CRC_H

#include <stdint.h>

namespace rungproof {

/// Start with kCrcStart, add every byte, complement at the end.
const uint32_t kCrcStart = 0xffffffffU;

inline uint32_t crc_add(uint32_t crc, uint8_t byte) {
  crc ^= byte;
  for (uint8_t bit = 0; bit != 8; ++bit) {
    crc = (crc & 1U) != 0 ? (crc >> 1) ^ 0xedb88320U : crc >> 1;
  }
  return crc;
}

/// Of bytes in RAM.
inline uint32_t crc_of(const uint8_t* bytes, uint16_t size) {
  uint32_t crc = kCrcStart;
  for (uint16_t at = 0; at != size; ++at) crc = crc_add(crc, bytes[at]);
  return ~crc;
}

}  // namespace rungproof

#endif
