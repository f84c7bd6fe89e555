// Decides whether a program may be run. Internal to the machine.
#ifndef RUNGPROOF_VERIFIER_H
#define RUNGPROOF_VERIFIER_H

#include <stddef.h>

#include "rungproof_layout.h"

namespace rungproof {

/// A stack's depth: one more than the 65535 that a header can claim, where
/// memory for that many exists.
typedef Offset Depth;

/// Whether the first bytes are a header of this format and version.
bool is_header(const Source& program, uint32_t length);

/// Memory that verifying may write.
struct Scratch {
  uint32_t* words;
  uint32_t count;
};

class Verifier {
 public:
  /// `memory_words`: what there is to run the program in. `scratch` holds two
  /// words for each skip that is open at a time.
  Verifier(const Source& program, uint32_t length, uint32_t memory_words,
           const Scratch& scratch);
  Refusal verify();
  Offset at() const { return at_; }

 private:
  // All give None where nothing is wrong.
  Refusal check_header();
  Refusal check_sections();
  Refusal check_cells();
  Refusal check_slots();
  Refusal check_names();
  Refusal check_notes();
  Refusal check_code();

  Refusal close_skips();
  Refusal instruction();
  Refusal addressed(uint8_t opcode, uint8_t shape, bool wide);
  Refusal push(uint8_t opcode, uint8_t shape);
  Refusal skip(uint8_t shape);
  Refusal write(uint8_t shape, Offset cell);
  Refusal effect(uint8_t shape);
  uint32_t checksum() const;
  uint32_t depths() const {
    return (static_cast<uint32_t>(bits_) << 16) | words_;
  }
  /// An open skip: its target, and both depths before it.
  uint32_t* pending(Depth skip) const {
    return scratch_.words + size_t{2} * skip;
  }
  bool has(uint8_t bytes) const { return layout_.names - pc_ >= bytes; }
  uint8_t next();

  Source program_;
  uint32_t length_;
  uint32_t memory_words_;
  Scratch scratch_;
  Layout layout_;
  Offset at_;
  // The walk over the code: both stacks' depths at pc_, on every path.
  Offset pc_;
  Depth bits_;
  Depth words_;
  Depth open_;  // skips whose target lies ahead
  Depth most_bits_;
  Depth most_words_;
  Depth most_open_;
  bool divisor_;  // the instruction before pushed a word other than 0
  bool ended_;
};

}  // namespace rungproof

#endif
