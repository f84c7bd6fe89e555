// Instructions on words: exact, or a fault.
#include "rungproof_bytes.h"
#include "rungproof_format.h"
#include "rungproof_run.h"

namespace rungproof {
namespace {

uint32_t magnitude(int32_t value) {
  const uint32_t bits = static_cast<uint32_t>(value);
  return value < 0 ? 0U - bits : bits;
}

// By magnitudes: a 64-bit product is dear on an 8-bit controller.
RUNGPROOF_APART bool product_fits(int32_t left, int32_t right) {
  const uint32_t limit = 0x7fffffffU + ((left ^ right) < 0 ? 1U : 0U);
  const uint32_t b = magnitude(right);
  return b == 0 || magnitude(left) <= limit / b;
}

// == != < <= > >=, in the order of their opcodes.
RUNGPROOF_APART uint8_t compare(uint8_t opcode, int32_t left, int32_t right) {
  const bool equal = left == right;
  bool result = opcode < kLess ? equal : left < right;
  if (opcode == kLessEqual || opcode == kGreater) result = result || equal;
  if (opcode == kNotEqual || opcode >= kGreater) result = !result;
  return result ? 1 : 0;
}

// `bits` is the right operand and becomes the result.
RUNGPROOF_APART Fault arithmetic(uint8_t opcode, int32_t left, uint32_t& bits) {
  const int32_t right = to_signed(bits);
  uint32_t result = static_cast<uint32_t>(left);
  int32_t lost = 0;  // negative: the result left 32 bits
  if (opcode == kAdd) {
    result += bits;
    lost = (to_signed(result) ^ left) & (to_signed(result) ^ right);
  } else if (opcode == kMultiply) {
    result *= bits;
    if (!product_fits(left, right)) lost = -1;
  } else if (opcode == kDivide && right != -1) {
    result = static_cast<uint32_t>(left / right);
  } else if (opcode == kDivide) {
    result = 0U - result;
    lost = left & to_signed(result);
  } else {  // kSubtract; kNegate, with nothing on the left
    result -= bits;
    lost = (left ^ right) & (left ^ to_signed(result));
  }
  bits = result;
  return lost < 0 ? Fault::Overflow : Fault::None;
}

}  // namespace

void push_word(Run& run, uint8_t opcode, uint16_t address) {
  int32_t value = 0;
  if (opcode == kPush8) {
    value = (next8(run) ^ 0x80) - 0x80;
  } else if (opcode == kPush16) {
    value = to_signed16(next16(run));
  } else if (opcode == kPush32) {
    value = next32(run);
  } else {
    value = run.words[address];
  }
  *run.word_top++ = value;
}

Fault write_word(Run& run, uint16_t address) {
  const int32_t value = *--run.word_top;
  if (in_range(run.program, run.ranges, address, value) != value) {
    return Fault::Range;
  }
  run.words[address] = value;
  return Fault::None;
}

// All instructions take their operands and leave their results here, which is
// shorter than each of them doing it.
Fault step_word(Run& run, uint8_t opcode, uint8_t shape) {
  int32_t* top = run.word_top;
  const uint8_t count = shape & kShapeWordsIn;
  int32_t right = 0;
  int32_t left = 0;
  if (count != 0) right = *--top;
  if (count > (1 << 2)) left = *--top;
  uint32_t bits = static_cast<uint32_t>(right);
  Fault fault = Fault::None;
  if (opcode == kWrap16) {
    bits = static_cast<uint32_t>(to_signed16(bits));
  } else if (opcode == kToWord) {
    bits = pop_bit(run);
  } else if (opcode == kToBit) {
    push_bit(run, right != 0 ? 1 : 0);
  } else if (opcode >= kEqual) {
    push_bit(run, compare(opcode, left, right));
  } else {
    fault = arithmetic(opcode, left, bits);
  }
  if ((shape & kShapeWordOut) != 0) *top++ = to_signed(bits);
  run.word_top = top;
  return fault;
}

}  // namespace rungproof
