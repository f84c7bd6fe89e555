#include "rungproof_machine.h"

#include "rungproof_bytes.h"
#include "rungproof_format.h"
#include "rungproof_run.h"
#include "rungproof_verifier.h"

namespace rungproof {
namespace {

const uint32_t kForever = 0xffffffffU;

}  // namespace

Machine::Machine()
    : program_(nullptr, Space::Flash),
      memory_(nullptr),
      memory_words_(0),
      used_(0),
      bits_(nullptr),
      bit_count_(0),
      word_count_(0),
      slot_count_(0),
      scan_min_(0),
      scan_max_(0),
      refused_at_(0),
      fault_at_(0),
      refusal_(Refusal::TooShort),
      fault_(Fault::None),
      interval_held_(true) {}

uint32_t Machine::memory_words(const uint8_t* program, uint32_t length,
                               Space space) {
  const Source source(program, space);
  return is_header(source, length) ? words_needed(read_layout(source)) : 0;
}

Refusal Machine::begin(const uint8_t* program, uint32_t length,
                       uint32_t* memory, uint32_t memory_words, Space space) {
  *this = Machine();
  memory_ = memory;
  memory_words_ = static_cast<Offset>(memory_words);
  return replace(program, length, space);
}

Refusal Machine::replace(const uint8_t* program, uint32_t length, Space space) {
  const Source source(program, space);
  const Refusal refusal = check(source, length);
  if (refusal == Refusal::None) start(source);
  return refusal;
}

Refusal Machine::check(const Source& program, uint32_t length) {
  const Scratch scratch = {memory_ + used_, uint32_t{memory_words_} - used_};
  Verifier verifier(program, length, memory_words_, scratch);
  refusal_ = verifier.verify();
  refused_at_ = verifier.at();
  return refusal_;
}

void Machine::start(const Source& program) {
  const Layout layout = read_layout(program);
  program_ = program;
  bit_count_ = layout.bit_count;
  word_count_ = layout.word_count;
  slot_count_ = layout.slot_count;
  scan_min_ = read32(program, kAtScanMin);
  scan_max_ = read32(program, kAtScanMax);
  used_ = static_cast<Offset>(words_to_run(layout));
  bits_ = reinterpret_cast<uint8_t*>(memory_ + layout.word_count +
                                     layout.slot_count + layout.word_stack);
  reset();
}

void Machine::reset() {
  fault_ = Fault::None;
  interval_held_ = true;
  if (program_.bytes == nullptr) return;
  Offset at = kHeaderBytes;
  for (Offset bit = 0; bit != bit_count_; ++bit, ++at) {
    bits_[bit] = (read8(program_, at) & kInitialBit) != 0 ? 1 : 0;
  }
  at += word_count_;
  uint32_t* word = memory_;
  for (uint16_t left = word_count_; left != 0; --left, at += kRangeBytes) {
    *word++ = read32(program_, at);
  }
  for (uint16_t slot = 0; slot != slot_count_; ++slot) {
    *word++ = 0;
    bits_[Offset{bit_count_} + slot] = 0;
  }
}

// Every timer grows, also one that nothing has started: starting sets it to 0.
// It stays at its end, so no preset is passed twice in 49 days.
Offset Machine::advance(uint32_t dt_ms) {
  Offset at = ranges() + Offset{kRangeBytes} * word_count_;
  uint32_t* value = memory_ + word_count_;
  for (uint16_t left = slot_count_; left != 0; --left, at += kSlotBytes) {
    if (is_timer_kind(read8(program_, at))) {
      *value = dt_ms > kForever - *value ? kForever : *value + dt_ms;
    }
    ++value;
  }
  return at;
}

bool Machine::scan(uint32_t dt_ms) {
  if (program_.bytes == nullptr || fault_ != Fault::None) return false;
  if (dt_ms < scan_min_ || dt_ms > scan_max_) interval_held_ = false;
  const Offset code = advance(dt_ms);
  Run run = {program_,
             program_.bytes + code,
             bits_,
             bits_ + bit_count_ + slot_count_,
             0,
             words(),
             words() + word_count_ + slot_count_,
             memory_ + word_count_,
             bits_ + bit_count_,
             ranges()};
  fault_ = run_rungs(run);
  fault_at_ = static_cast<Offset>(run.pc - program_.bytes);
  return fault_ == Fault::None;
}

Role Machine::role(Offset cell) const {
  if (cell >= cells()) return Role::Memory;
  return static_cast<Role>(read8(program_, kHeaderBytes + cell) & kRoleMask);
}

int32_t Machine::value(Offset cell) const {
  if (cell >= cells()) return 0;
  return cell < bit_count_ ? bits_[cell] : words()[cell - bit_count_];
}

bool Machine::set(Offset cell, int32_t value) {
  if (role(cell) != Role::Input) return false;
  if (cell < bit_count_) {
    bits_[cell] = value != 0 ? 1 : 0;
    return true;
  }
  const Offset word = cell - bit_count_;
  words()[word] = in_range(program_, ranges(), word, value);
  return words()[word] == value;
}

uint32_t Machine::find(const char* name) const {
  const Offset count = cells();
  if (count == 0) return 0;
  Offset at = read_layout(program_).names;
  Offset cell = 0;
  for (; cell != count; ++cell) {
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

uint8_t Machine::name(Offset cell, char* buffer, uint8_t size) const {
  if (cell >= cells()) return 0;
  Offset at = read_layout(program_).names;
  for (; cell != 0; --cell) at += 1U + read8(program_, at);
  const uint8_t length = read8(program_, at++);
  for (uint8_t byte = 0; byte != length && byte != size; ++byte) {
    buffer[byte] = static_cast<char>(read8(program_, at + byte));
  }
  return length;
}

}  // namespace rungproof
