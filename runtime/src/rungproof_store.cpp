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
      sequence_(0),
      header_(),
      banks_(),
      active_(kNoBank),
      target_(0),
      phase_(Phase::Idle),
      found_(false) {}

uint16_t Store::capacity() const {
  const uint16_t size = storage_.size();
  if (size < kUnused + 2 * kBankHeader) return 0;
  return static_cast<uint16_t>((size - kUnused) / 2 - kBankHeader);
}

uint16_t Store::bank_start(uint8_t bank) const {
  const uint16_t bank_bytes = static_cast<uint16_t>(capacity() + kBankHeader);
  return static_cast<uint16_t>(kUnused + (bank == 0 ? 0 : bank_bytes));
}

void Store::read_header(uint8_t bank, uint8_t* header) const {
  const uint16_t start = bank_start(bank);
  for (uint8_t i = 0; i != kHeader; ++i) {
    header[i] = storage_.read(static_cast<uint16_t>(start + i));
  }
}

bool Store::whole(uint8_t bank) const {
  const uint16_t start = bank_start(bank);
  if (capacity() == 0) return false;
  if (storage_.read(static_cast<uint16_t>(start + kAtMark)) != kWhole) {
    return false;
  }
  uint8_t header[kHeader];
  read_header(bank, header);
  const uint16_t length = get16(header + kAtLength);
  if (length > capacity()) return false;
  uint32_t crc = kCrcStart;
  for (uint8_t i = 0; i != kAtCrc; ++i) crc = crc_add(crc, header[i]);
  for (uint16_t i = 0; i != length; ++i) {
    crc = crc_add(
        crc, storage_.read(static_cast<uint16_t>(start + kBankHeader + i)));
  }
  return ~crc == get32(header + kAtCrc);
}

// Once: it takes a pass over all of the storage, too long between two scans.
void Store::find() {
  if (found_) return;
  found_ = true;
  uint32_t sequences[2] = {0, 0};
  for (uint8_t bank = 0; bank != 2; ++bank) {
    banks_[bank] = kNoBank;
    uint8_t header[kHeader];
    if (!whole(bank)) continue;
    read_header(bank, header);
    banks_[bank] = bank;
    sequences[bank] = get32(header + kAtSequence);
  }
  // The numbers follow one another, so that half a turn tells which is newer.
  const bool second_newer =
      banks_[1] != kNoBank &&
      (banks_[0] == kNoBank || sequences[1] - sequences[0] < 0x80000000U);
  if (second_newer) {
    banks_[1] = banks_[0];
    banks_[0] = 1;
  }
  sequence_ = second_newer ? sequences[1] : sequences[0];
}

void Store::forget(uint8_t bank) {
  if (banks_[0] == bank) {
    banks_[0] = banks_[1];
    banks_[1] = kNoBank;
  } else if (banks_[1] == bank) {
    banks_[1] = kNoBank;
  }
}

uint16_t Store::load(uint8_t age, uint8_t* to, uint16_t size) {
  find();
  const uint8_t bank = banks_[age];
  if (bank == kNoBank) return 0;
  uint8_t header[kHeader];
  read_header(bank, header);
  const uint16_t length = get16(header + kAtLength);
  if (length > size) return 0;
  const uint16_t from = static_cast<uint16_t>(bank_start(bank) + kBankHeader);
  for (uint16_t i = 0; i != length; ++i) {
    to[i] = storage_.read(static_cast<uint16_t>(from + i));
  }
  return length;
}

void Store::use(uint8_t age) {
  find();
  active_ = banks_[age];
}

void Store::begin(const uint8_t* program, uint16_t length) {
  find();
  const uint8_t keep = active_ != kNoBank ? active_ : banks_[0];
  target_ = keep == 0 ? 1 : 0;
  forget(target_);
  program_ = program;
  length_ = length;
  put32(header_ + kAtSequence, sequence_ + 1);
  put16(header_ + kAtLength, length);
  // Of the program it is computed as it is written.
  uint32_t crc = kCrcStart;
  for (uint8_t i = 0; i != kAtCrc; ++i) crc = crc_add(crc, header_[i]);
  put32(header_ + kAtCrc, crc);
  phase_ = Phase::Unmark;
}

// Of everything but the mark.
uint8_t Store::wanted(uint16_t at) const {
  return at < kAtMark ? header_[at] : program_[at - kBankHeader];
}

// The program first, and then, with its CRC, what stands before it.
void Store::write_next(uint16_t start) {
  const uint8_t byte = wanted(at_);
  const uint16_t place = static_cast<uint16_t>(start + at_);
  // Equal bytes wear nothing.
  if (storage_.read(place) != byte) storage_.write(place, byte);
  if (at_ >= kBankHeader) {
    uint32_t crc = crc_add(get32(header_ + kAtCrc), byte);
    if (at_ + 1 == kBankHeader + length_) crc = ~crc;
    put32(header_ + kAtCrc, crc);
  }
  ++at_;
  if (at_ == kBankHeader + length_) {
    at_ = 0;
  } else if (at_ == kAtMark) {
    at_ = 0;
    phase_ = Phase::Verify;
  }
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
      at_ = kBankHeader;
      break;
    case Phase::Write:
      // A bank that still counts is not touched.
      if (storage_.read(mark) == kWhole) return fail();
      write_next(start);
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
      banks_[1] = banks_[0];
      banks_[0] = target_;
      ++sequence_;
      active_ = target_;
      phase_ = Phase::Idle;
      return Progress::Done;
  }
  return Progress::Working;
}

}  // namespace rungproof
