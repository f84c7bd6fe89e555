// Frames on a stream of bytes (docs/link.md): COBS, so that a zero byte stands
// between two frames and nowhere else, and a CRC-32 behind the content. After
// any garbage the next zero byte is the beginning of a frame.
//
// Bytes are handed over one at a time: nothing here waits, and the same code
// serves the controller and the host.
#ifndef RUNGPROOF_FRAME_H
#define RUNGPROOF_FRAME_H

#include <stdint.h>

namespace rungproof {

const uint8_t kFrameContent = 60;
const uint8_t kFrameBytes = kFrameContent + 4;  // with the CRC
/// On the wire at most: a zero in front, COBS, a zero behind.
const uint8_t kFrameWire = kFrameBytes + 3;

/// Takes bytes, gives contents. What is no whole frame is dropped.
class FrameReader {
 public:
  FrameReader();

  /// True: a frame is whole, its content stands until the next call.
  bool put(uint8_t byte);
  const uint8_t* content() const { return bytes_; }
  uint8_t size() const { return content_; }

 private:
  bool end();
  void append(uint8_t byte);

  uint8_t bytes_[kFrameBytes];
  uint8_t size_;     // decoded so far
  uint8_t content_;  // of the frame that is whole
  uint8_t left_;     // bytes up to where the next group begins
  bool first_;       // no group yet: the first has no zero in front
  bool broken_;      // until the next zero byte
};

/// Takes a content, gives bytes.
class FrameWriter {
 public:
  FrameWriter();

  /// Whether bytes wait for next(); the content may not be touched then.
  bool busy() const { return state_ != Idle; }
  /// kFrameContent bytes to be filled.
  uint8_t* content() { return bytes_; }
  void send(uint8_t size);
  /// The next byte for the wire, or -1.
  int16_t next();

 private:
  enum State : uint8_t { Idle, Front, Group, Body };

  uint8_t bytes_[kFrameBytes];
  uint8_t size_;  // with the CRC
  uint8_t at_;
  uint8_t group_end_;
  State state_;
};

inline void put16(uint8_t* to, uint16_t value) {
  to[0] = static_cast<uint8_t>(value & 0xffU);
  to[1] = static_cast<uint8_t>(value >> 8);
}
inline void put32(uint8_t* to, uint32_t value) {
  put16(to, static_cast<uint16_t>(value & 0xffffU));
  put16(to + 2, static_cast<uint16_t>(value >> 16));
}
inline uint16_t get16(const uint8_t* from) {
  return static_cast<uint16_t>(from[0] | (uint16_t{from[1]} << 8));
}
inline uint32_t get32(const uint8_t* from) {
  return get16(from) | (uint32_t{get16(from + 2)} << 16);
}

}  // namespace rungproof

#endif
