#include "rungproof_machine.h"

#include "rungproof_bytes.h"
#include "rungproof_format.h"
#include "rungproof_verifier.h"

namespace rungproof {
namespace {

const int32_t kWordMax = 0x7fffffff;
const int32_t kWordMin = -kWordMax - 1;
const uint32_t kForever = 0xffffffffU;

const uint8_t kFlag0 = 1;
const uint8_t kFlag1 = 2;

bool header_present(const Source& program, uint32_t length) {
  return length >= kHeaderBytes && read8(program, 0) == kMagic0 &&
         read8(program, 1) == kMagic1 && read8(program, 2) == kMagic2 &&
         read8(program, 3) == kMagic3 &&
         read16(program, kAtVersion) == kVersion;
}

bool add(int32_t a, int32_t b, int32_t& result) {
  if (b > 0 ? a > kWordMax - b : a < kWordMin - b) return false;
  result = a + b;
  return true;
}

uint32_t magnitude(int32_t value) {
  return value < 0 ? ~static_cast<uint32_t>(value) + 1U
                   : static_cast<uint32_t>(value);
}

// By magnitudes: a 64-bit product is dear on an 8-bit controller.
bool multiply(int32_t a, int32_t b, int32_t& result) {
  const uint32_t left = magnitude(a);
  const uint32_t right = magnitude(b);
  const bool negative = (a < 0) != (b < 0);
  const uint32_t limit = negative ? 0x80000000U : 0x7fffffffU;
  if (right != 0 && left > limit / right) return false;
  const uint32_t product = left * right;
  result = to_signed(negative ? ~product + 1U : product);
  return true;
}

// Whether `elapsed` ms have passed `preset`, which may be below zero.
bool past(uint32_t elapsed, int32_t preset) {
  return preset < 0 || elapsed > static_cast<uint32_t>(preset);
}
bool reached(uint32_t elapsed, int32_t preset) {
  return preset < 0 || elapsed >= static_cast<uint32_t>(preset);
}

// value > 50 * preset, where the product may leave 32 bits.
bool above_fifty_times(int32_t value, int32_t preset) {
  if (preset > kWordMax / 50) return false;
  if (preset < kWordMin / 50) return true;
  return value > 50 * preset;
}

}  // namespace

Machine::Machine()
    : program_(nullptr, Space::Flash),
      layout_(),
      memory_(nullptr),
      memory_words_(0),
      used_(0),
      words_(nullptr),
      slot_values_(nullptr),
      word_stack_(nullptr),
      bits_(nullptr),
      slot_flags_(nullptr),
      bit_stack_(nullptr),
      pc_(0),
      word_top_(nullptr),
      bit_top_(nullptr),
      scan_min_(0),
      scan_max_(0),
      refused_at_(0),
      refusal_(Refusal::TooShort),
      fault_(Fault::None),
      interval_held_(true) {}

uint32_t Machine::memory_words(const uint8_t* program, uint32_t length,
                               Space space) {
  const Source source(program, space);
  if (!header_present(source, length)) return 0;
  return words_needed(read_layout(source));
}

Refusal Machine::begin(const uint8_t* program, uint32_t length,
                       uint32_t* memory, uint32_t memory_words, Space space) {
  program_ = Source(nullptr, Space::Flash);
  layout_ = Layout();
  memory_ = memory;
  memory_words_ = memory_words;
  used_ = 0;
  return replace(program, length, space);
}

Refusal Machine::replace(const uint8_t* program, uint32_t length, Space space) {
  const Source source(program, space);
  const Refusal refusal = check(source, length);
  if (refusal == Refusal::None) start(source);
  return refusal;
}

Refusal Machine::check(const Source& program, uint32_t length) {
  const Scratch scratch = {memory_ + used_, memory_words_ - used_};
  Verifier verifier(program, length, memory_words_, scratch);
  refusal_ = verifier.verify();
  refused_at_ = verifier.at();
  return refusal_;
}

void Machine::start(const Source& program) {
  program_ = program;
  layout_ = read_layout(program);
  scan_min_ = read32(program, kAtScanMin);
  scan_max_ = read32(program, kAtScanMax);
  used_ = words_to_run(layout_);
  uint32_t* const memory = memory_;
  // Signed words and bytes may alias the caller's array.
  words_ = reinterpret_cast<int32_t*>(memory);
  slot_values_ = memory + layout_.word_count;
  word_stack_ = words_ + layout_.word_count + layout_.slot_count;
  bits_ = reinterpret_cast<uint8_t*>(word_stack_ + layout_.word_stack);
  slot_flags_ = bits_ + layout_.bit_count;
  bit_stack_ = slot_flags_ + layout_.slot_count;
  reset();
}

void Machine::reset() {
  fault_ = Fault::None;
  interval_held_ = true;
  if (program_.bytes == nullptr) return;
  for (uint16_t bit = 0; bit != layout_.bit_count; ++bit) {
    const uint8_t attribute = read8(program_, layout_.attributes + bit);
    bits_[bit] = (attribute & kInitialBit) != 0 ? 1 : 0;
  }
  for (uint16_t word = 0; word != layout_.word_count; ++word) {
    words_[word] = to_signed(
        read32(program_, layout_.ranges + Offset{kRangeBytes} * word));
  }
  for (uint16_t slot = 0; slot != layout_.slot_count; ++slot) {
    slot_values_[slot] = 0;
    slot_flags_[slot] = 0;
  }
}

bool Machine::scan(uint32_t dt_ms) {
  if (program_.bytes == nullptr || fault_ != Fault::None) return false;
  if (dt_ms < scan_min_ || dt_ms > scan_max_) interval_held_ = false;
  // Every timer grows, also one that nothing has started: starting sets it to
  // 0. It stays at its end, so no preset is passed twice in 49 days.
  for (uint16_t slot = 0; slot != layout_.slot_count; ++slot) {
    const Offset at = layout_.slots + Offset{kSlotBytes} * slot;
    if (!is_timer_kind(read8(program_, at))) continue;
    uint32_t& elapsed = slot_values_[slot];
    elapsed = dt_ms > kForever - elapsed ? kForever : elapsed + dt_ms;
  }
  return run();
}

// The stacks need no check here: begin() has computed every depth.
bool Machine::run() {
  pc_ = layout_.code;
  bit_top_ = bit_stack_;
  word_top_ = word_stack_;
  for (;;) {
    uint8_t opcode = read8(program_, pc_++);
    const bool wide = opcode == kWide;
    if (wide) opcode = read8(program_, pc_++);
    if (opcode == kEnd) return true;
    bool ok = true;
    if (opcode < kWide) {
      step_bit(opcode, wide);
    } else if (opcode < kTimerYun) {
      ok = step_word(opcode, wide);
    } else {
      ok = step_element(opcode, wide);
    }
    if (!ok) return false;
  }
}

uint16_t Machine::address(bool wide) {
  if (!wide) return read8(program_, pc_++);
  pc_ += 2;
  return read16(program_, pc_ - 2);
}

void Machine::step_bit(uint8_t opcode, bool wide) {
  uint8_t* const top = bit_top_;
  switch (opcode) {
    case kFalse:
    case kTrue:
      *bit_top_++ = opcode == kTrue ? 1 : 0;
      break;
    case kReadBit:
      *bit_top_++ = bits_[address(wide)];
      break;
    case kWriteBit:
      bits_[address(wide)] = *--bit_top_;
      break;
    case kNot:
      top[-1] ^= 1;
      break;
    case kAnd:
      top[-2] &= top[-1];
      --bit_top_;
      break;
    case kOr:
      top[-2] |= top[-1];
      --bit_top_;
      break;
    case kXor:
      top[-2] ^= top[-1];
      --bit_top_;
      break;
    default: {  // kSkipFalse, kSkipTrue: a deciding value stays, else it goes
      const uint16_t offset = address(true);
      if ((top[-1] != 0) == (opcode == kSkipTrue)) {
        pc_ += offset;
      } else {
        --bit_top_;
      }
    }
  }
}

bool Machine::step_word(uint8_t opcode, bool wide) {
  switch (opcode) {
    case kPush8: {
      const int16_t byte = read8(program_, pc_++);
      *word_top_++ = byte < 0x80 ? byte : byte - 0x100;
      return true;
    }
    case kPush16:
      *word_top_++ = to_signed16(address(true));
      return true;
    case kPush32:
      *word_top_++ = to_signed(read32(program_, pc_));
      pc_ += 4;
      return true;
    case kReadWord:
      *word_top_++ = words_[address(wide)];
      return true;
    case kWriteWord:
      return write_word(address(wide));
    case kWrap16:
      word_top_[-1] = to_signed16(static_cast<uint32_t>(word_top_[-1]));
      return true;
    case kToWord:
      *word_top_++ = *--bit_top_;
      return true;
    case kToBit:
      *bit_top_++ = *--word_top_ != 0 ? 1 : 0;
      return true;
    default:
      if (opcode < kEqual) return arithmetic(opcode);
      compare(opcode);
      return true;
  }
}

bool Machine::arithmetic(uint8_t opcode) {
  bool ok = true;
  if (opcode == kNegate) {
    int32_t& value = word_top_[-1];
    ok = value != kWordMin;
    if (ok) value = -value;
  } else {
    const int32_t right = *--word_top_;
    int32_t& left = word_top_[-1];
    if (opcode == kAdd) {
      ok = add(left, right, left);
    } else if (opcode == kSubtract) {
      // -right may not exist, ~right does: a - b is a + ~b + 1.
      int32_t almost = 0;
      ok = right >= 0 ? add(left, -right, left)
                      : add(left, ~right, almost) && add(almost, 1, left);
    } else if (opcode == kMultiply) {
      ok = multiply(left, right, left);
    } else {
      ok = left != kWordMin || right != -1;
      if (ok) left /= right;
    }
  }
  if (!ok) fault_ = Fault::Overflow;
  return ok;
}

void Machine::compare(uint8_t opcode) {
  word_top_ -= 2;
  const int32_t left = word_top_[0];
  const int32_t right = word_top_[1];
  bool result = false;
  switch (opcode) {
    case kEqual:
      result = left == right;
      break;
    case kNotEqual:
      result = left != right;
      break;
    case kLess:
      result = left < right;
      break;
    case kLessEqual:
      result = left <= right;
      break;
    case kGreater:
      result = left > right;
      break;
    default:
      result = left >= right;
  }
  *bit_top_++ = result ? 1 : 0;
}

bool Machine::write_word(uint16_t word) {
  const Offset at = layout_.ranges + Offset{kRangeBytes} * word;
  const int32_t value = *--word_top_;
  if (value < to_signed(read32(program_, at + 4)) ||
      value > to_signed(read32(program_, at + 8))) {
    fault_ = Fault::Range;
    return false;
  }
  words_[word] = value;
  return true;
}

bool Machine::step_element(uint8_t opcode, bool wide) {
  const uint16_t slot = address(wide);
  int32_t preset = 0;
  if (element_shape(opcode).parameter) {
    preset = to_signed(read32(program_, pc_));
    pc_ += 4;
  }
  if (opcode == kCounterSim) return count_sim(slot, preset);

  uint8_t& flags = slot_flags_[slot];
  uint32_t& counted = slot_values_[slot];
  const bool v = bit_top_[-1] != 0;
  bool result = v;
  switch (opcode) {
    case kTimerYun:  // kFlag0: started
      if (v && flags == 0) {
        counted = 0;
        flags = kFlag0;
      }
      result = v && past(counted, preset);
      break;
    case kTimerYunReset:
      if (v) flags = 0;
      break;
    case kTimerSim:  // kFlag0: started
      if (!v || flags == 0) counted = 0;
      flags = v ? kFlag0 : 0;
      result = reached(counted, preset);
      break;
    case kOffDelaySim:  // kFlag0: armed, kFlag1: out
      if (v) {
        flags = kFlag0 | kFlag1;
      } else {
        if ((flags & kFlag0) != 0) counted = 0;
        flags &= kFlag1;
        if (reached(counted, preset)) flags = 0;
      }
      result = (flags & kFlag1) != 0;
      break;
    case kCounterYun:  // kFlag0: last; never below 0
      if (v && flags == 0 && to_signed(counted) < preset) ++counted;
      flags = v ? kFlag0 : 0;
      result = to_signed(counted) >= preset;
      break;
    case kCounterYunReset:
      if (v) counted = 0;
      break;
    default:  // kRise, kFall; kFlag0: last
      result = v != (flags != 0) && v == (opcode == kRise);
      flags = v ? kFlag0 : 0;
  }
  bit_top_[-1] = result ? 1 : 0;
  return true;
}

// kFlag0: last up, kFlag1: last down.
bool Machine::count_sim(uint16_t slot, int32_t preset) {
  const bool up = bit_top_[-3] != 0;
  const bool down = bit_top_[-2] != 0;
  const bool reset = bit_top_[-1] != 0;
  bit_top_ -= 2;
  uint8_t& flags = slot_flags_[slot];
  int32_t count = reset ? 0 : to_signed(slot_values_[slot]);
  bool result = false;
  if (!reset) {
    int32_t change = 0;
    if (up && (flags & kFlag0) == 0) ++change;
    if (down && (flags & kFlag1) == 0) --change;
    if (!add(count, change, count)) {
      fault_ = Fault::Overflow;
      return false;
    }
    result = count == preset;
    if (above_fifty_times(count, preset)) count = preset + 1;
  }
  flags =
      reset ? 0 : static_cast<uint8_t>((up ? kFlag0 : 0) | (down ? kFlag1 : 0));
  slot_values_[slot] = static_cast<uint32_t>(count);
  bit_top_[-1] = result ? 1 : 0;
  return true;
}

Role Machine::role(uint32_t cell) const {
  if (program_.bytes == nullptr || cell >= cell_count()) return Role::Memory;
  return static_cast<Role>(
      read8(program_, layout_.attributes + static_cast<Offset>(cell)) &
      kRoleMask);
}

int32_t Machine::value(uint32_t cell) const {
  if (program_.bytes == nullptr || cell >= cell_count()) return 0;
  return cell < layout_.bit_count ? bits_[cell]
                                  : words_[cell - layout_.bit_count];
}

bool Machine::set(uint32_t cell, int32_t value) {
  if (program_.bytes == nullptr || cell >= cell_count() ||
      role(cell) != Role::Input) {
    return false;
  }
  if (cell < layout_.bit_count) {
    bits_[cell] = value != 0 ? 1 : 0;
    return true;
  }
  const uint16_t word = static_cast<uint16_t>(cell - layout_.bit_count);
  const Offset at = layout_.ranges + Offset{kRangeBytes} * word;
  const int32_t low = to_signed(read32(program_, at + 4));
  const int32_t high = to_signed(read32(program_, at + 8));
  words_[word] = value < low ? low : value > high ? high : value;
  return words_[word] == value;
}

uint32_t Machine::find(const char* name) const {
  Offset at = layout_.names;
  uint32_t cell = 0;
  for (; cell != cell_count(); ++cell) {
    const uint8_t size = read8(program_, at++);
    uint8_t same = 0;
    while (same != size && name[same] != '\0' &&
           static_cast<uint8_t>(name[same]) == read8(program_, at + same)) {
      ++same;
    }
    if (same == size && name[same] == '\0') break;
    at += size;
  }
  return cell;
}

uint8_t Machine::name(uint32_t cell, char* buffer, uint8_t size) const {
  if (program_.bytes == nullptr || cell >= cell_count()) return 0;
  Offset at = layout_.names;
  for (; cell != 0; --cell) at += 1U + read8(program_, at);
  const uint8_t length = read8(program_, at++);
  for (uint8_t byte = 0; byte != length && byte != size; ++byte) {
    buffer[byte] = static_cast<char>(read8(program_, at + byte));
  }
  return length;
}

}  // namespace rungproof
