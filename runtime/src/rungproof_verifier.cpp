#include "rungproof_verifier.h"

#include "rungproof_bytes.h"
#include "rungproof_crc.h"
#include "rungproof_format.h"

namespace rungproof {

Layout read_layout(const Source& program) {
  Layout layout;
  layout.bit_count = read16(program, kAtBits);
  layout.word_count = read16(program, kAtWords);
  layout.slot_count = read16(program, kAtSlots);
  layout.bit_stack = read16(program, kAtBitStack);
  layout.word_stack = read16(program, kAtWordStack);
  layout.branches = read16(program, kAtBranches);
  layout.attributes = kHeaderBytes;
  layout.ranges =
      layout.attributes + Offset{layout.bit_count} + layout.word_count;
  layout.slots = layout.ranges + Offset{kRangeBytes} * layout.word_count;
  layout.code = layout.slots + Offset{kSlotBytes} * layout.slot_count;
  layout.names =
      layout.code + static_cast<Offset>(read32(program, kAtCodeBytes));
  layout.notes =
      layout.names + static_cast<Offset>(read32(program, kAtNameBytes));
  layout.end =
      layout.notes + static_cast<Offset>(read32(program, kAtNoteBytes));
  return layout;
}

uint32_t words_to_run(const Layout& layout) {
  const uint32_t wide =
      uint32_t{layout.word_count} + layout.slot_count + layout.word_stack;
  const uint32_t narrow =
      uint32_t{layout.bit_count} + layout.slot_count + layout.bit_stack;
  return wide + (narrow + 3) / 4;
}

uint32_t words_to_verify(const Layout& layout) {
  return 2 * uint32_t{layout.branches};
}

uint32_t words_needed(const Layout& layout) {
  const uint32_t run = words_to_run(layout);
  const uint32_t verify = words_to_verify(layout);
  return run > verify ? run : verify;
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
      constant_(0),
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
  if (length_ < kHeaderBytes) return Refusal::TooShort;
  if (length_ > static_cast<Offset>(-1)) return Refusal::NoMemory;
  if (read8(program_, 0) != kMagic0 || read8(program_, 1) != kMagic1 ||
      read8(program_, 2) != kMagic2 || read8(program_, 3) != kMagic3) {
    return Refusal::BadMagic;
  }
  at_ = kAtVersion;
  if (read16(program_, at_) != kVersion) return Refusal::BadVersion;
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
  for (at_ = layout_.attributes; at_ != layout_.ranges; ++at_) {
    const uint8_t attribute = read8(program_, at_);
    const bool word = at_ - layout_.attributes >= layout_.bit_count;
    if ((attribute & ~kAttributeMask) != 0) return Refusal::BadCell;
    if ((attribute & kRoleMask) == kRoleMask) return Refusal::BadCell;
    if (word && (attribute & kInitialBit) != 0) return Refusal::BadCell;
  }
  for (; at_ != layout_.slots; at_ += kRangeBytes) {
    const int32_t initial = to_signed(read32(program_, at_));
    const int32_t low = to_signed(read32(program_, at_ + 4));
    const int32_t high = to_signed(read32(program_, at_ + 8));
    if (initial < low || initial > high) return Refusal::BadCell;
  }
  return Refusal::None;
}

Refusal Verifier::check_slots() {
  for (at_ = layout_.slots; at_ != layout_.code; at_ += kSlotBytes) {
    if (!is_element_kind(read8(program_, at_))) return Refusal::BadSlot;
    if (read32(program_, at_ + 1) > 0x7fffffffU) return Refusal::BadSlot;
  }
  return Refusal::None;
}

Refusal Verifier::check_names() {
  at_ = layout_.names;
  const Offset cells = layout_.ranges - layout_.attributes;
  for (Offset cell = 0; cell != cells; ++cell) {
    if (at_ == layout_.notes) return Refusal::BadName;
    const uint8_t size = read8(program_, at_);
    if (size == 0 || layout_.notes - at_ <= size) return Refusal::BadName;
    for (uint8_t left = size; left != 0; --left) {
      const uint8_t byte = read8(program_, ++at_);
      // What a quoted name of the text form cannot hold.
      if (byte < 0x20 || byte == '"' || byte == 0x7f) return Refusal::BadName;
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
      if (blank && edge) return Refusal::BadNote;  // notes are trimmed
      if ((byte < 0x20 && !blank) || byte == 0x7f) return Refusal::BadNote;
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
    if (skip[0] != pc_) return Refusal::BadSkip;
    if (skip[1] != depths()) return Refusal::BadSkip;
    --open_;
  }
  return Refusal::None;
}

Refusal Verifier::effect(uint8_t bits_in, uint8_t words_in, uint8_t bits_out,
                         uint8_t words_out) {
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
  bits_ = bits_ - bits_in + bits_out;
  words_ = words_ - words_in + words_out;
  if (bits_ > layout_.bit_stack || words_ > layout_.word_stack) {
    return Refusal::WrongDepth;
  }
  if (bits_ > most_bits_) most_bits_ = bits_;
  if (words_ > most_words_) most_words_ = words_;
  return Refusal::None;
}

Refusal Verifier::instruction() {
  if (!has(1)) return Refusal::BadEnd;
  uint8_t opcode = read8(program_, pc_++);
  const bool wide = opcode == kWide;
  if (wide) {
    if (!has(1)) return Refusal::BadEnd;
    opcode = read8(program_, pc_++);
  }
  const bool element_opcode = element_shape(opcode).kind != 0;
  const bool addressed = element_opcode || opcode == kReadBit ||
                         opcode == kWriteBit || opcode == kReadWord ||
                         opcode == kWriteWord;
  if (addressed) {
    if (!has(wide ? 2 : 1)) return Refusal::BadEnd;
    const uint16_t address =
        wide ? read16(program_, pc_) : read8(program_, pc_);
    pc_ += wide ? 2 : 1;
    constant_ = 0;
    if (wide && address < 0x100) return Refusal::NotShortest;
    return element_opcode ? element(opcode, address)
                          : address_instruction(opcode, address);
  }
  if (wide) return Refusal::BadOpcode;
  if (opcode == kEnd) return end();
  return opcode < kWide ? bit_instruction(opcode) : word_instruction(opcode);
}

Refusal Verifier::address_instruction(uint8_t opcode, uint16_t address) {
  const bool word = opcode == kReadWord || opcode == kWriteWord;
  if (address >= (word ? layout_.word_count : layout_.bit_count)) {
    return Refusal::BadAddress;
  }
  if (opcode == kReadBit) return effect(0, 0, 1, 0);
  if (opcode == kReadWord) return effect(0, 0, 0, 1);
  return write(word ? Offset{layout_.bit_count} + address : address, word);
}

Refusal Verifier::write(Offset cell, bool word) {
  if (open_ != 0) return Refusal::BadSkip;
  const Refusal refusal = word ? effect(0, 1, 0, 0) : effect(1, 0, 0, 0);
  if (refusal != Refusal::None) return refusal;
  if (bits_ != 0 || words_ != 0) return Refusal::StackNotEmpty;
  const uint8_t attribute = read8(program_, layout_.attributes + cell);
  return (attribute & kRoleMask) == static_cast<uint8_t>(Role::Input)
             ? Refusal::WritesInput
             : Refusal::None;
}

Refusal Verifier::element(uint8_t opcode, uint16_t slot) {
  const ElementShape shape = element_shape(opcode);
  if (shape.parameter) {
    if (!has(4)) return Refusal::BadEnd;
    pc_ += 4;
  }
  if (slot >= layout_.slot_count) return Refusal::BadElement;
  if (read8(program_, layout_.slots + Offset{kSlotBytes} * slot) !=
      shape.kind) {
    return Refusal::BadElement;
  }
  return effect(shape.operands, 0, 1, 0);
}

Refusal Verifier::bit_instruction(uint8_t opcode) {
  constant_ = 0;
  switch (opcode) {
    case kFalse:
    case kTrue:
      return effect(0, 0, 1, 0);
    case kNot:
      return effect(1, 0, 1, 0);
    case kAnd:
    case kOr:
    case kXor:
      return effect(2, 0, 1, 0);
    case kSkipFalse:
    case kSkipTrue:
      return skip();
    default:
      return Refusal::BadOpcode;
  }
}

Refusal Verifier::skip() {
  if ((read8(program_, kAtFlags) & kFlagShortCircuit) == 0) {
    return Refusal::StrictSkip;
  }
  if (!has(2)) return Refusal::BadEnd;
  const uint16_t offset = read16(program_, pc_);
  pc_ += 2;
  if (offset >= layout_.names - pc_) return Refusal::BadSkip;
  const Offset target = pc_ + offset;
  const uint32_t below = depths();
  const Refusal refusal = effect(1, 0, 0, 0);
  if (refusal != Refusal::None) return refusal;
  if (open_ == layout_.branches) return Refusal::WrongDepth;
  pending(open_)[0] = target;
  pending(open_)[1] = below;
  ++open_;
  if (open_ > most_open_) most_open_ = open_;
  return Refusal::None;
}

Refusal Verifier::word_instruction(uint8_t opcode) {
  if (opcode == kPush8 || opcode == kPush16 || opcode == kPush32) {
    return push(opcode);
  }
  if (opcode == kDivide && constant_ == 0) return Refusal::BadDivisor;
  constant_ = 0;
  switch (opcode) {
    case kAdd:
    case kSubtract:
    case kMultiply:
    case kDivide:
      return effect(0, 2, 0, 1);
    case kNegate:
    case kWrap16:
      return effect(0, 1, 0, 1);
    case kToWord:
      return effect(1, 0, 0, 1);
    case kToBit:
      return effect(0, 1, 1, 0);
    case kEqual:
    case kNotEqual:
    case kLess:
    case kLessEqual:
    case kGreater:
    case kGreaterEqual:
      return effect(0, 2, 1, 0);
    default:
      return Refusal::BadOpcode;
  }
}

Refusal Verifier::push(uint8_t opcode) {
  const uint8_t bytes = opcode == kPush8 ? 1 : opcode == kPush16 ? 2 : 4;
  if (!has(bytes)) return Refusal::BadEnd;
  if (bytes == 1) {
    const int32_t byte = read8(program_, pc_);
    constant_ = byte < 0x80 ? byte : byte - 0x100;
  } else if (bytes == 2) {
    constant_ = to_signed16(read16(program_, pc_));
    if (constant_ >= -0x80 && constant_ < 0x80) return Refusal::NotShortest;
  } else {
    constant_ = to_signed(read32(program_, pc_));
    if (constant_ >= -0x8000L && constant_ < 0x8000L) {
      return Refusal::NotShortest;
    }
  }
  pc_ += bytes;
  return effect(0, 0, 0, 1);
}

Refusal Verifier::end() {
  if (open_ != 0) return Refusal::BadSkip;
  if (bits_ != 0 || words_ != 0) return Refusal::StackNotEmpty;
  ended_ = true;
  return pc_ == layout_.names ? Refusal::None : Refusal::BadEnd;
}

}  // namespace rungproof
