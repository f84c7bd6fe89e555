#include "rungproof_verifier.h"

#include "rungproof_bytes.h"
#include "rungproof_crc.h"
#include "rungproof_format.h"

namespace rungproof {
namespace {

Refusal recognise(const Source& program, uint32_t length) {
  if (length < kHeaderBytes) return Refusal::TooShort;
  if (read16(program, 0) != (kMagic0 | kMagic1 << 8) ||
      read16(program, 2) != (kMagic2 | kMagic3 << 8)) {
    return Refusal::BadMagic;
  }
  return read16(program, kAtVersion) == kVersion ? Refusal::None
                                                 : Refusal::BadVersion;
}

/// What neither a name nor a note holds.
bool is_control(uint8_t byte) { return byte < 0x20 || byte == 0x7f; }

}  // namespace

bool is_header(const Source& program, uint32_t length) {
  return recognise(program, length) == Refusal::None;
}

Verifier::Verifier(const Source& program, uint32_t length,
                   uint32_t memory_words, const Scratch& scratch)
    : program_(program),
      length_(length),
      memory_words_(memory_words),
      scratch_(scratch),
      layout_(),
      at_(0),
      pc_(0),
      bits_(0),
      words_(0),
      open_(0),
      most_bits_(0),
      most_words_(0),
      most_open_(0),
      divisor_(false),
      ended_(false) {}

Refusal Verifier::verify() {
  Refusal refusal = check_header();
  if (refusal == Refusal::None) refusal = check_sections();
  if (refusal == Refusal::None) refusal = check_cells();
  if (refusal == Refusal::None) refusal = check_slots();
  if (refusal == Refusal::None) refusal = check_names();
  if (refusal == Refusal::None) refusal = check_notes();
  if (refusal == Refusal::None) refusal = check_code();
  return refusal;
}

uint32_t Verifier::checksum() const {
  uint32_t crc = kCrcStart;
  const Offset length = static_cast<Offset>(length_);
  for (Offset at = 0; at != length; ++at) {
    if (at >= kAtChecksum && at < kAtChecksum + 4U) continue;
    crc = crc_add(crc, read8(program_, at));
  }
  return ~crc;
}

Refusal Verifier::check_header() {
  const Refusal refusal = recognise(program_, length_);
  if (refusal == Refusal::BadVersion) at_ = kAtVersion;
  if (refusal != Refusal::None) return refusal;
  if (length_ > static_cast<Offset>(-1)) return Refusal::NoMemory;
  at_ = kAtLength;
  if (read32(program_, at_) != length_) return Refusal::BadLength;
  at_ = kAtChecksum;
  if (read32(program_, at_) != checksum()) return Refusal::BadChecksum;
  at_ = kAtFlags;
  if (read8(program_, at_) > kFlagShortCircuit) return Refusal::BadHeader;
  at_ = kAtDialect;
  if (read8(program_, at_) >= kDialects) return Refusal::BadHeader;
  at_ = kAtScanMin;
  const uint32_t scan_max = read32(program_, kAtScanMax);
  if (scan_max > 0x7fffffffU || read32(program_, at_) > scan_max) {
    return Refusal::BadHeader;
  }
  return Refusal::None;
}

Refusal Verifier::check_sections() {
  at_ = kAtBits;
  layout_ = read_layout(program_);
  // The first three sections are short enough never to overflow 32 bits.
  const uint32_t tables = kHeaderBytes + uint32_t{layout_.bit_count} +
                          (1 + uint32_t{kRangeBytes}) * layout_.word_count +
                          uint32_t{kSlotBytes} * layout_.slot_count;
  uint32_t rest = length_;
  if (rest < tables) return Refusal::BadSections;
  rest -= tables;
  for (uint8_t field = kAtCodeBytes; field <= kAtNoteBytes; field += 4) {
    at_ = field;
    const uint32_t size = read32(program_, field);
    if (size > rest) return Refusal::BadSections;
    rest -= size;
  }
  if (rest != 0) return Refusal::BadSections;
  return words_to_run(layout_) <= memory_words_ &&
                 words_to_verify(layout_) <= scratch_.count
             ? Refusal::None
             : Refusal::NoMemory;
}

Refusal Verifier::check_cells() {
  Offset bits = layout_.bit_count;
  for (at_ = kHeaderBytes; at_ != layout_.ranges; ++at_) {
    // A word's initial value is in its range.
    const uint8_t attribute = read8(program_, at_);
    const uint8_t most =
        static_cast<uint8_t>(Role::Memory) | (bits != 0 ? kInitialBit : 0);
    if (bits != 0) --bits;
    if (attribute > most) return Refusal::BadCell;
    if ((attribute & kRoleMask) == kRoleMask) return Refusal::BadCell;
  }
  for (; at_ != layout_.slots; at_ += kRangeBytes) {
    const int32_t initial = to_signed(read32(program_, at_));
    if (initial < to_signed(read32(program_, at_ + 4)) ||
        initial > to_signed(read32(program_, at_ + 8))) {
      return Refusal::BadCell;
    }
  }
  return Refusal::None;
}

Refusal Verifier::check_slots() {
  for (at_ = layout_.slots; at_ != layout_.code; at_ += kSlotBytes) {
    if (!is_element_kind(read8(program_, at_))) return Refusal::BadSlot;
    // The index is not negative.
    if (read8(program_, at_ + 4) > 0x7f) return Refusal::BadSlot;
  }
  return Refusal::None;
}

Refusal Verifier::check_names() {
  at_ = layout_.names;
  for (Offset left = layout_.ranges - kHeaderBytes; left != 0; --left) {
    if (at_ == layout_.notes) return Refusal::BadName;
    const uint8_t size = read8(program_, at_);
    if (size == 0 || layout_.notes - at_ <= size) return Refusal::BadName;
    for (uint8_t rest = size; rest != 0; --rest) {
      const uint8_t byte = read8(program_, ++at_);
      // What a quoted name of the text form cannot hold.
      if (is_control(byte) || byte == '"') return Refusal::BadName;
    }
    ++at_;
  }
  return at_ == layout_.notes ? Refusal::None : Refusal::BadName;
}

Refusal Verifier::check_notes() {
  at_ = layout_.notes;
  while (at_ != layout_.end) {
    if (layout_.end - at_ < 2) return Refusal::BadNote;
    const uint16_t size = read16(program_, at_);
    at_ += 2;
    if (size == 0 || layout_.end - at_ < size) return Refusal::BadNote;
    for (uint16_t left = size; left != 0; --left, ++at_) {
      const uint8_t byte = read8(program_, at_);
      const bool blank = byte == ' ' || byte == '\t';
      const bool edge = left == size || left == 1;
      if (blank ? edge : is_control(byte)) return Refusal::BadNote;  // trimmed
    }
  }
  return Refusal::None;
}

// One pass in address order sees every path: skips only go forward, and where
// one lands the stacks are as deep as on the way that did not skip.
Refusal Verifier::check_code() {
  pc_ = layout_.code;
  while (!ended_) {
    at_ = pc_;
    Refusal refusal = close_skips();
    if (refusal == Refusal::None) refusal = instruction();
    if (refusal != Refusal::None) return refusal;
  }
  at_ = kAtBitStack;
  if (most_bits_ != layout_.bit_stack || most_words_ != layout_.word_stack ||
      most_open_ != layout_.branches) {
    return Refusal::WrongDepth;
  }
  return Refusal::None;
}

// A skip whose target lies beyond that of a skip around it hides the outer
// one, whose target is then passed without being met.
Refusal Verifier::close_skips() {
  while (open_ != 0) {
    const uint32_t* skip = pending(open_ - 1);
    if (skip[0] > pc_) break;
    if (skip[0] != pc_ || skip[1] != depths()) return Refusal::BadSkip;
    --open_;
  }
  return Refusal::None;
}

Refusal Verifier::effect(uint8_t shape) {
  const uint8_t bits_in = shape & kShapeBitsIn;
  const uint8_t words_in = (shape & kShapeWordsIn) >> 2;
  // What a skip jumps over leaves alone what lies below.
  Depth bit_floor = 0;
  Depth word_floor = 0;
  if (open_ != 0) {
    const uint32_t below = pending(open_ - 1)[1];
    bit_floor = static_cast<Depth>(below >> 16) - 1;
    word_floor = static_cast<Depth>(below & 0xffffU);
  }
  if (bits_ - bit_floor < bits_in || words_ - word_floor < words_in) {
    return Refusal::StackUnderflow;
  }
  bits_ -= bits_in;
  words_ -= words_in;
  if ((shape & kShapeBitOut) != 0) ++bits_;
  if ((shape & kShapeWordOut) != 0) ++words_;
  if (bits_ > layout_.bit_stack || words_ > layout_.word_stack) {
    return Refusal::WrongDepth;
  }
  if (bits_ > most_bits_) most_bits_ = bits_;
  if (words_ > most_words_) most_words_ = words_;
  return Refusal::None;
}

uint8_t Verifier::next() { return read8(program_, pc_++); }

Refusal Verifier::instruction() {
  const bool divisor = divisor_;
  divisor_ = false;
  if (!has(1)) return Refusal::BadEnd;
  uint8_t opcode = next();
  const bool wide = opcode == kWide;
  if (wide) {
    if (!has(1)) return Refusal::BadEnd;
    opcode = next();
  }
  const uint8_t shape = shape_of(opcode);
  if (shape == kNoShape) return Refusal::BadOpcode;
  if ((shape & kShapeAddress) != 0) return addressed(opcode, shape, wide);
  if (wide) return Refusal::BadOpcode;
  switch (opcode) {
    case kEnd:
      ended_ = true;
      if (open_ != 0) return Refusal::BadSkip;
      if (bits_ != 0 || words_ != 0) return Refusal::StackNotEmpty;
      return pc_ == layout_.names ? Refusal::None : Refusal::BadEnd;
    case kSkipFalse:
    case kSkipTrue:
      return skip(shape);
    case kPush8:
    case kPush16:
    case kPush32:
      return push(opcode, shape);
    case kDivide:
      if (!divisor) return Refusal::BadDivisor;
      break;
    default:
      break;
  }
  return effect(shape);
}

Refusal Verifier::addressed(uint8_t opcode, uint8_t shape, bool wide) {
  if (!has(wide ? 2 : 1)) return Refusal::BadEnd;
  uint16_t address = next();
  if (wide) {
    address = static_cast<uint16_t>(address | (next() << 8));
    if (address < 0x100) return Refusal::NotShortest;
  }
  if (is_element(opcode)) {
    if ((shape & kShapePreset) != 0) {
      if (!has(4)) return Refusal::BadEnd;
      pc_ += 4;
    }
    const Offset slot = layout_.slots + Offset{kSlotBytes} * address;
    return address >= layout_.slot_count ||
                   read8(program_, slot) != kind_of(opcode)
               ? Refusal::BadElement
               : effect(shape);
  }
  const bool word = opcode >= kReadWord;
  if (address >= (word ? layout_.word_count : layout_.bit_count)) {
    return Refusal::BadAddress;
  }
  if (opcode == kReadBit || opcode == kReadWord) return effect(shape);
  return write(shape, word ? Offset{layout_.bit_count} + address : address);
}

Refusal Verifier::write(uint8_t shape, Offset cell) {
  if (open_ != 0) return Refusal::BadSkip;
  const Refusal refusal = effect(shape);
  if (refusal != Refusal::None) return refusal;
  if (bits_ != 0 || words_ != 0) return Refusal::StackNotEmpty;
  const uint8_t attribute = read8(program_, kHeaderBytes + cell);
  return (attribute & kRoleMask) == static_cast<uint8_t>(Role::Input)
             ? Refusal::WritesInput
             : Refusal::None;
}

Refusal Verifier::skip(uint8_t shape) {
  if ((read8(program_, kAtFlags) & kFlagShortCircuit) == 0) {
    return Refusal::StrictSkip;
  }
  if (!has(2)) return Refusal::BadEnd;
  const uint16_t distance = read16(program_, pc_);
  pc_ += 2;
  if (distance >= layout_.names - pc_) return Refusal::BadSkip;
  const uint32_t below = depths();
  const Refusal refusal = effect(shape);
  if (refusal != Refusal::None) return refusal;
  if (open_ == layout_.branches) return Refusal::WrongDepth;
  pending(open_)[0] = uint32_t{pc_} + distance;
  pending(open_)[1] = below;
  ++open_;
  if (open_ > most_open_) most_open_ = open_;
  return Refusal::None;
}

Refusal Verifier::push(uint8_t opcode, uint8_t shape) {
  const uint8_t bytes = opcode == kPush8 ? 1 : opcode == kPush16 ? 2 : 4;
  if (!has(bytes)) return Refusal::BadEnd;
  int32_t value = read8(program_, pc_);
  bool shortest = true;
  if (bytes == 2) {
    value = to_signed16(read16(program_, pc_));
    shortest = value != static_cast<int8_t>(value);
  } else if (bytes == 4) {
    value = to_signed(read32(program_, pc_));
    shortest = value != static_cast<int16_t>(value);
  }
  if (!shortest) return Refusal::NotShortest;
  divisor_ = value != 0;
  pc_ += bytes;
  return effect(shape);
}

}  // namespace rungproof
