// Where the parts of a program are. Internal.
#ifndef RUNGPROOF_LAYOUT_H
#define RUNGPROOF_LAYOUT_H

#include "rungproof_types.h"

namespace rungproof {

/// Where the parts of a program start, as byte offsets; and its counts.
struct Layout {
  Offset ranges;  // the attributes are right behind the header
  Offset slots;
  Offset code;
  Offset names;
  Offset notes;
  Offset end;
  uint16_t bit_count;
  uint16_t word_count;
  uint16_t slot_count;
  uint16_t bit_stack;
  uint16_t word_stack;
  uint16_t branches;
};

/// The header's counts and section starts, without any check.
Layout read_layout(const Source& program);

/// How much memory running takes, and verifying, in uint32_t.
uint32_t words_to_run(const Layout& layout);
uint32_t words_to_verify(const Layout& layout);

/// The larger of the two: they take turns with the memory.
uint32_t words_needed(const Layout& layout);

}  // namespace rungproof

#endif
