#include "rungproof_format.h"

#include "rungproof_bytes.h"

namespace rungproof {
namespace {

const uint8_t kNone = kNoShape;
const uint8_t kPushBit = kShapeBitOut;
const uint8_t kPushWord = kShapeWordOut;
const uint8_t kBit = 1 | kShapeBitOut;
const uint8_t kTwoBits = 2 | kShapeBitOut;
const uint8_t kWord = 1 << 2 | kShapeWordOut;
const uint8_t kTwoWords = 2 << 2 | kShapeWordOut;
const uint8_t kCompare = 2 << 2 | kShapeBitOut;
const uint8_t kPreset = kBit | kShapeAddress | kShapePreset;
const uint8_t kSlot = kBit | kShapeAddress;

const uint8_t kGap = kTimerYun - kGreaterEqual - 1;
const uint8_t kLast = kFall - kGap;

// Without the gap between words and elements.
const uint8_t kShapes[] RUNGPROOF_FLASH = {
    0,  // end
    kPushBit,
    kPushBit,                  // false true
    kPushBit | kShapeAddress,  // read a bit
    1 | kShapeAddress,         // write a bit
    kBit,                      // !
    kTwoBits,
    kTwoBits,
    kTwoBits,  // && || ^
    1,
    1,  // skips: what stays, stays there
    kNone,
    kNone,
    kNone,
    kNone,
    kNone,  // 0b-0e, the prefix
    kPushWord,
    kPushWord,
    kPushWord,                  // push
    kPushWord | kShapeAddress,  // read a word
    1 << 2 | kShapeAddress,     // write a word
    kTwoWords,
    kTwoWords,
    kTwoWords,
    kTwoWords,  // + - * /
    kWord,
    kWord,                  // neg wrap16
    1 | kShapeWordOut,      // to_word
    1 << 2 | kShapeBitOut,  // to_bit
    kNone,
    kNone,
    kNone,  // 1d-1f
    kCompare,
    kCompare,
    kCompare,
    kCompare,
    kCompare,
    kCompare,
    kPreset,
    kSlot,  // T, TR (yun)
    kPreset,
    kPreset,  // T, TOF (sim)
    kNone,
    kNone,
    kNone,
    kNone,  // 44-47
    kPreset,
    kSlot,                                            // C, CR (yun)
    3 | kShapeBitOut | kShapeAddress | kShapePreset,  // C (sim)
    kNone,
    kNone,
    kNone,
    kNone,
    kNone,  // 4b-4f
    kSlot,
    kSlot,  // RISE FALL
};
static_assert(sizeof(kShapes) == kLast + 1, "a shape for each opcode");

}  // namespace

uint8_t shape_of(uint8_t opcode) {
  if (opcode > kGreaterEqual) {
    if (opcode < kTimerYun) return kNoShape;
    opcode = static_cast<uint8_t>(opcode - kGap);
  }
  return opcode <= kLast ? flash_byte(kShapes + opcode) : kNoShape;
}

}  // namespace rungproof
