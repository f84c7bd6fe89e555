#include "rungproof_store.h"

#include "rungproof_crc.h"
#include "rungproof_frame.h"

namespace rungproof {
namespace {

// Where things stand in a bank.
const uint8_t kAtSequence = 0;
const uint8_t kAtLength = 4;
const uint8_t kAtCrc = 6;
const uint8_t kAtMark = 10;
const uint8_t kBankHeader = 11;
const uint8_t kWhole = 0xa5;
const uint8_t kNotWhole = 0;

// A brown-out may spoil the EEPROM's byte 0 on AVR, whatever is written.
const uint8_t kUnused = 1;

}  // namespace

Store::Store(Storage& storage)
    : storage_(storage),
      program_(nullptr),
      length_(0),
      at_(0),
      header_(),
      active_(kNoBank),
      target_(0),
      phase_(Phase::Idle) {}

uint16_t Store::capacity() const {
  const uint16_t size = storage_.size();
  if (size < kUnused + 2 * kBankHeader) return 0;
  return static_cast<uint16_t>((size - kUnused) / 2 - kBankHeader);
}

uint16_t Store::bank_start(uint8_t bank) const {
  const uint16_t bank_bytes = static_cast<uint16_t>(capacity() + kBankHeader);
  return static_cast<uint16_t>(kUnused + (bank == 0 ? 0 : bank_bytes));
}

uint32_t Store::sequence(uint8_t bank) const {
  uint8_t bytes[4];
  for (uint8_t i = 0; i != 4; ++i) {
    bytes[i] = storage_.read(
        static_cast<uint16_t>(bank_start(bank) + kAtSequence + i));
  }
  return get32(bytes);
}

// 0: the bank is not whole.
uint16_t Store::valid_length(uint8_t bank) const {
  const uint16_t start = bank_start(bank);
  uint8_t header[kBankHeader];
  if (capacity() == 0) return 0;
  for (uint8_t i = 0; i != kBankHeader; ++i) {
    header[i] = storage_.read(static_cast<uint16_t>(start + i));
  }
  const uint16_t length = get16(header + kAtLength);
  if (header[kAtMark] != kWhole || length > capacity()) return 0;
  uint32_t crc = kCrcStart;
  for (uint8_t i = 0; i != kAtCrc; ++i) crc = crc_add(crc, header[i]);
  for (uint16_t i = 0; i != length; ++i) {
    crc = crc_add(
        crc, storage_.read(static_cast<uint16_t>(start + kBankHeader + i)));
  }
  return ~crc == get32(header + kAtCrc) ? length : 0;
}

uint8_t Store::bank_of(uint8_t age) const {
  const bool first = valid_length(0) != 0;
  const bool second = valid_length(1) != 0;
  if (!first && !second) return kNoBank;
  uint8_t newest = first ? 0 : 1;
  // The numbers follow one another, so that half a turn tells which is newer.
  if (first && second && sequence(1) - sequence(0) < 0x80000000U) newest = 1;
  if (age == 0) return newest;
  return first && second ? static_cast<uint8_t>(1 - newest) : kNoBank;
}

uint16_t Store::load(uint8_t age, uint8_t* to, uint16_t size) const {
  const uint8_t bank = bank_of(age);
  if (bank == kNoBank) return 0;
  const uint16_t length = valid_length(bank);
  if (length > size) return 0;
  const uint16_t from = static_cast<uint16_t>(bank_start(bank) + kBankHeader);
  for (uint16_t i = 0; i != length; ++i) {
    to[i] = storage_.read(static_cast<uint16_t>(from + i));
  }
  return length;
}

void Store::use(uint8_t age) { active_ = bank_of(age); }

void Store::begin(const uint8_t* program, uint16_t length) {
  const uint8_t newest = bank_of(0);
  const uint8_t keep = active_ != kNoBank ? active_ : newest;
  target_ = keep == 0 ? 1 : 0;
  program_ = program;
  length_ = length;
  put32(header_ + kAtSequence, newest == kNoBank ? 1 : sequence(newest) + 1);
  put16(header_ + kAtLength, length);
  uint32_t crc = kCrcStart;
  for (uint8_t i = 0; i != kAtCrc; ++i) crc = crc_add(crc, header_[i]);
  for (uint16_t i = 0; i != length; ++i) crc = crc_add(crc, program[i]);
  put32(header_ + kAtCrc, ~crc);
  phase_ = Phase::Unmark;
}

// Of everything but the mark.
uint8_t Store::wanted(uint16_t at) const {
  return at < kAtMark ? header_[at] : program_[at - kBankHeader];
}

Store::Progress Store::fail() {
  phase_ = Phase::Idle;
  return Progress::Failed;
}

Store::Progress Store::step() {
  if (phase_ == Phase::Idle) return Progress::Done;
  if (!storage_.ready()) return Progress::Working;
  const uint16_t start = bank_start(target_);
  const uint16_t mark = static_cast<uint16_t>(start + kAtMark);
  const uint16_t place = static_cast<uint16_t>(start + at_);
  switch (phase_) {
    case Phase::Unmark:
      if (storage_.read(mark) != kNotWhole) storage_.write(mark, kNotWhole);
      phase_ = Phase::Write;
      at_ = 0;
      break;
    case Phase::Write:
      // Before the first byte: a bank that still counts is not touched.
      if (at_ == 0 && storage_.read(mark) == kWhole) return fail();
      if (at_ != kAtMark && storage_.read(place) != wanted(at_)) {
        storage_.write(place, wanted(at_));  // equal bytes wear nothing
      }
      if (++at_ != kBankHeader + length_) break;
      phase_ = Phase::Verify;
      at_ = 0;
      break;
    case Phase::Verify:
      if (at_ != kAtMark && storage_.read(place) != wanted(at_)) return fail();
      if (++at_ == kBankHeader + length_) phase_ = Phase::Mark;
      break;
    case Phase::Mark:
      storage_.write(mark, kWhole);
      phase_ = Phase::Marked;
      break;
    default:
      if (storage_.read(mark) != kWhole) return fail();
      active_ = target_;
      phase_ = Phase::Idle;
      return Progress::Done;
  }
  return Progress::Working;
}

}  // namespace rungproof
