#include "rungproof_frame.h"

#include "rungproof_crc.h"

namespace rungproof {

FrameReader::FrameReader()
    : size_(0), content_(0), left_(0), first_(true), broken_(false) {}

bool FrameReader::put(uint8_t byte) {
  if (byte == 0) return end();
  if (broken_) return false;
  if (left_ != 0) {
    --left_;
    append(byte);
    return false;
  }
  // A group: so many bytes, and a zero between two groups. One of 255 bytes,
  // behind which COBS has no zero, is longer than a frame and ends as broken.
  if (!first_) append(0);
  first_ = false;
  left_ = static_cast<uint8_t>(byte - 1);
  return false;
}

void FrameReader::append(uint8_t byte) {
  if (size_ == kFrameBytes) {
    broken_ = true;
    return;
  }
  bytes_[size_++] = byte;
}

bool FrameReader::end() {
  const uint8_t size = size_;
  const bool whole = !broken_ && left_ == 0 && size > 4;
  size_ = 0;
  left_ = 0;
  first_ = true;
  broken_ = false;
  if (!whole) return false;
  content_ = static_cast<uint8_t>(size - 4);
  return crc_of(bytes_, content_) == get32(bytes_ + content_);
}

FrameWriter::FrameWriter() : size_(0), at_(0), group_end_(0), state_(Idle) {}

void FrameWriter::send(uint8_t size) {
  put32(bytes_ + size, crc_of(bytes_, size));
  size_ = static_cast<uint8_t>(size + 4);
  at_ = 0;
  // The zero in front ends whatever garbage the line has picked up.
  state_ = Front;
}

int16_t FrameWriter::next() {
  if (state_ == Idle) return -1;
  if (state_ == Front) {
    state_ = Group;
    return 0;
  }
  if (state_ == Body) {
    if (at_ != group_end_) return bytes_[at_++];
    if (at_ == size_) {
      state_ = Idle;
      return 0;
    }
    ++at_;  // the zero that the next group stands for
  }
  state_ = Body;
  group_end_ = at_;
  while (group_end_ != size_ && bytes_[group_end_] != 0) ++group_end_;
  return static_cast<int16_t>(group_end_ - at_ + 1);
}

}  // namespace rungproof
