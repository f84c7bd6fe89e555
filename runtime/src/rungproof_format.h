// The numbers of the postfix format, version 1: docs/postfix.md says what they
// mean. The host tools have a table of their own (base/postfix_format.h); a
// test compares the two.
#ifndef RUNGPROOF_FORMAT_H
#define RUNGPROOF_FORMAT_H

#include <stdint.h>

namespace rungproof {

const uint8_t kMagic0 = 0x9e;
const uint8_t kMagic1 = 'R';
const uint8_t kMagic2 = 'P';
const uint8_t kMagic3 = 'F';
const uint8_t kVersion = 1;
const uint8_t kFlagShortCircuit = 1;
const uint8_t kDialects = 3;  // none, yun, sim
const uint8_t kHeaderBytes = 48;
const uint8_t kRangeBytes = 12;  // of a word cell: initial, low, high
const uint8_t kSlotBytes = 5;    // kind, index

/// Byte offsets of the header's fields.
const uint8_t kAtVersion = 4;
const uint8_t kAtFlags = 6;
const uint8_t kAtDialect = 7;
const uint8_t kAtLength = 8;
const uint8_t kAtChecksum = 12;
const uint8_t kAtScanMin = 16;
const uint8_t kAtScanMax = 20;
const uint8_t kAtBits = 24;
const uint8_t kAtWords = 26;
const uint8_t kAtSlots = 28;
const uint8_t kAtBitStack = 30;
const uint8_t kAtWordStack = 32;
const uint8_t kAtBranches = 34;
const uint8_t kAtCodeBytes = 36;
const uint8_t kAtNameBytes = 40;
const uint8_t kAtNoteBytes = 44;

/// A cell's attribute byte.
const uint8_t kRoleMask = 3;
const uint8_t kInitialBit = 4;
const uint8_t kAttributeMask = kRoleMask | kInitialBit;

const uint8_t kEnd = 0x00;
// Bits.
const uint8_t kFalse = 0x01;
const uint8_t kTrue = 0x02;
const uint8_t kReadBit = 0x03;
const uint8_t kWriteBit = 0x04;
const uint8_t kNot = 0x05;
const uint8_t kAnd = 0x06;
const uint8_t kOr = 0x07;
const uint8_t kXor = 0x08;
const uint8_t kSkipFalse = 0x09;
const uint8_t kSkipTrue = 0x0a;
const uint8_t kWide =
    0x0f;  // prefix: the next instruction's address has two bytes
// Words.
const uint8_t kPush8 = 0x10;
const uint8_t kPush16 = 0x11;
const uint8_t kPush32 = 0x12;
const uint8_t kReadWord = 0x13;
const uint8_t kWriteWord = 0x14;
const uint8_t kAdd = 0x15;
const uint8_t kSubtract = 0x16;
const uint8_t kMultiply = 0x17;
const uint8_t kDivide = 0x18;
const uint8_t kNegate = 0x19;
const uint8_t kWrap16 = 0x1a;
const uint8_t kToWord = 0x1b;
const uint8_t kToBit = 0x1c;
const uint8_t kEqual = 0x20;
const uint8_t kNotEqual = 0x21;
const uint8_t kLess = 0x22;
const uint8_t kLessEqual = 0x23;
const uint8_t kGreater = 0x24;
const uint8_t kGreaterEqual = 0x25;
// Elements. The first of a kind is the kind's number in the slot table.
const uint8_t kTimerYun = 0x40;
const uint8_t kTimerYunReset = 0x41;
const uint8_t kTimerSim = 0x42;
const uint8_t kOffDelaySim = 0x43;
const uint8_t kCounterYun = 0x48;
const uint8_t kCounterYunReset = 0x49;
const uint8_t kCounterSim = 0x4a;
const uint8_t kRise = 0x50;
const uint8_t kFall = 0x51;

/// What an instruction takes and leaves, in a byte: the bits that it pops (2
/// bits), the words (2), whether it pushes a bit, a word; and its operands.
/// The verifier and the machine go by the same table.
const uint8_t kShapeBitsIn = 0x03;
const uint8_t kShapeWordsIn = 0x0c;
const uint8_t kShapeBitOut = 0x10;
const uint8_t kShapeWordOut = 0x20;
const uint8_t kShapeAddress = 0x40;  // an address follows
const uint8_t kShapePreset = 0x80;   // and behind it a preset
const uint8_t kNoShape = 0xff;       // there is no such instruction

uint8_t shape_of(uint8_t opcode);

inline bool is_element(uint8_t opcode) { return opcode >= kTimerYun; }

/// The kind of slot that an element instruction works on: the first
/// instruction of the kind.
inline uint8_t kind_of(uint8_t opcode) {
  return opcode == kOffDelaySim ? kOffDelaySim
                                : static_cast<uint8_t>(opcode & 0xfeU);
}

inline bool is_element_kind(uint8_t kind) {
  return is_element(kind) && shape_of(kind) != kNoShape &&
         kind_of(kind) == kind;
}

inline bool is_timer_kind(uint8_t kind) {
  return kind >= kTimerYun && kind < kCounterYun;
}

}  // namespace rungproof

#endif
