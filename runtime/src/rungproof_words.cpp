// Instructions on words: exact, or a fault.
#include "rungproof_bytes.h"
#include "rungproof_format.h"
#include "rungproof_run.h"

namespace rungproof {
namespace {

uint32_t magnitude(int32_t value) {
  const uint32_t bits = static_cast<uint32_t>(value);
  return value < 0 ? ~bits + 1U : bits;
}

bool subtract(int32_t& left, int32_t right) {
  const uint32_t a = static_cast<uint32_t>(left);
  const uint32_t b = static_cast<uint32_t>(right);
  left = to_signed(a - b);
  return to_signed((a ^ b) & (a ^ (a - b))) >= 0;
}

// By magnitudes: a 64-bit product is dear on an 8-bit controller.
bool multiply(int32_t& left, int32_t right) {
  const uint32_t a = magnitude(left);
  const uint32_t b = magnitude(right);
  const uint32_t negative = (left < 0) != (right < 0) ? 1 : 0;
  if (b != 0 && a > (0x7fffffffU + negative) / b) return false;
  left = to_signed((a * b ^ (0U - negative)) + negative);
  return true;
}

// The divisor is a constant other than 0.
bool divide(int32_t& left, int32_t right) {
  if (right != -1) {
    left /= right;
    return true;
  }
  const int32_t value = left;
  left = 0;
  return subtract(left, value);
}

// == != < <= > >=, in the order of their opcodes.
uint8_t compare(uint8_t opcode, int32_t left, int32_t right) {
  const bool equal = left == right;
  bool result = opcode < kLess ? equal : left < right;
  if (opcode == kLessEqual || opcode == kGreater) result = result || equal;
  if (opcode == kNotEqual || opcode >= kGreater) result = !result;
  return result ? 1 : 0;
}

}  // namespace

bool add(int32_t& sum, int32_t more) {
  const uint32_t a = static_cast<uint32_t>(sum);
  const uint32_t b = static_cast<uint32_t>(more);
  sum = to_signed(a + b);
  return to_signed((a ^ (a + b)) & (b ^ (a + b))) >= 0;
}

// All instructions take their operands and leave their results here, which is
// shorter than each of them doing it.
Fault step_word(Run& run, uint8_t opcode, uint16_t address) {
  const uint8_t shape = shape_of(opcode);
  int32_t left = 0;
  int32_t right = 0;
  if ((shape & kShapeWordsIn) != 0) left = *--run.word_top;
  if ((shape & kShapeWordsIn) > (1 << 2)) {
    right = left;
    left = *--run.word_top;
  }
  bool exact = true;
  switch (opcode) {
    case kPush8:
      left = (next8(run) ^ 0x80) - 0x80;
      break;
    case kPush16:
      left = to_signed16(next16(run));
      break;
    case kPush32:
      left = next32(run);
      break;
    case kReadWord:
      left = run.words[address];
      break;
    case kWriteWord:
      if (in_range(run.program, run.ranges, address, left) != left) {
        return Fault::Range;
      }
      run.words[address] = left;
      break;
    case kAdd:
      exact = add(left, right);
      break;
    case kNegate:
      right = left;
      left = 0;
      exact = subtract(left, right);
      break;
    case kSubtract:
      exact = subtract(left, right);
      break;
    case kMultiply:
      exact = multiply(left, right);
      break;
    case kDivide:
      exact = divide(left, right);
      break;
    case kWrap16:
      left = to_signed16(static_cast<uint32_t>(left));
      break;
    case kToWord:
      left = pop_bit(run);
      break;
    case kToBit:
      push_bit(run, left != 0 ? 1 : 0);
      break;
    default:
      push_bit(run, compare(opcode, left, right));
  }
  if ((shape & kShapeWordOut) != 0) *run.word_top++ = left;
  return exact ? Fault::None : Fault::Overflow;
}

}  // namespace rungproof
