#include "rungproof_layout.h"

#include "rungproof_bytes.h"
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
  layout.ranges = kHeaderBytes + Offset{layout.bit_count} + layout.word_count;
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

}  // namespace rungproof
