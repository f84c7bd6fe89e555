// The numbers of the postfix format, version 1: docs/postfix.md says what they
// mean. The host tools have a table of their own (base/postfix_format.h); a
// test compares the two.
#ifndef RUNGPROOF_FORMAT_H
#define RUNGPROOF_FORMAT_H

#include <stdint.h>

namespace rungproof {

enum : uint8_t {
  kMagic0 = 0x9e,
  kMagic1 = 'R',
  kMagic2 = 'P',
  kMagic3 = 'F',
  kVersion = 1,
  kFlagShortCircuit = 1,
  kDialects = 3,  // none, yun, sim
  kHeaderBytes = 48,
  kRangeBytes = 12,  // of a word cell: initial, low, high
  kSlotBytes = 5,    // kind, index
};

/// Byte offsets of the header's fields.
enum : uint8_t {
  kAtVersion = 4,
  kAtFlags = 6,
  kAtDialect = 7,
  kAtLength = 8,
  kAtChecksum = 12,
  kAtScanMin = 16,
  kAtScanMax = 20,
  kAtBits = 24,
  kAtWords = 26,
  kAtSlots = 28,
  kAtBitStack = 30,
  kAtWordStack = 32,
  kAtBranches = 34,
  kAtCodeBytes = 36,
  kAtNameBytes = 40,
  kAtNoteBytes = 44,
};

/// A cell's attribute byte.
enum : uint8_t {
  kRoleMask = 3,
  kInitialBit = 4,
  kAttributeMask = kRoleMask | kInitialBit,
};

enum Opcode : uint8_t {
  kEnd = 0x00,
  // Bits.
  kFalse = 0x01,
  kTrue = 0x02,
  kReadBit = 0x03,
  kWriteBit = 0x04,
  kNot = 0x05,
  kAnd = 0x06,
  kOr = 0x07,
  kXor = 0x08,
  kSkipFalse = 0x09,
  kSkipTrue = 0x0a,
  kWide = 0x0f,  // prefix: the next instruction's address has two bytes
  // Words.
  kPush8 = 0x10,
  kPush16 = 0x11,
  kPush32 = 0x12,
  kReadWord = 0x13,
  kWriteWord = 0x14,
  kAdd = 0x15,
  kSubtract = 0x16,
  kMultiply = 0x17,
  kDivide = 0x18,
  kNegate = 0x19,
  kWrap16 = 0x1a,
  kToWord = 0x1b,
  kToBit = 0x1c,
  kEqual = 0x20,
  kNotEqual = 0x21,
  kLess = 0x22,
  kLessEqual = 0x23,
  kGreater = 0x24,
  kGreaterEqual = 0x25,
  // Elements. The first of a kind is the kind's number in the slot table.
  kTimerYun = 0x40,
  kTimerYunReset = 0x41,
  kTimerSim = 0x42,
  kOffDelaySim = 0x43,
  kCounterYun = 0x48,
  kCounterYunReset = 0x49,
  kCounterSim = 0x4a,
  kRise = 0x50,
  kFall = 0x51,
};

/// What an element instruction takes and which slots it may work on.
struct ElementShape {
  uint8_t kind;      // 0: there is no such instruction
  uint8_t operands;  // bits it pops; it pushes one
  bool parameter;    // four bytes follow the slot number
};

inline ElementShape element_shape(uint8_t opcode) {
  switch (opcode) {
    case kTimerYun:
    case kTimerSim:
    case kOffDelaySim:
    case kCounterYun:
      return ElementShape{opcode, 1, true};
    case kCounterSim:
      return ElementShape{opcode, 3, true};
    case kTimerYunReset:
      return ElementShape{kTimerYun, 1, false};
    case kCounterYunReset:
      return ElementShape{kCounterYun, 1, false};
    case kRise:
    case kFall:
      return ElementShape{kRise, 1, false};
    default:
      return ElementShape{0, 0, false};
  }
}

inline bool is_element_kind(uint8_t kind) {
  return kind != 0 && element_shape(kind).kind == kind;
}

inline bool is_timer_kind(uint8_t kind) {
  return kind == kTimerYun || kind == kTimerSim || kind == kOffDelaySim;
}

}  // namespace rungproof

#endif
