// One scan's execution of a verified program. Internal to the machine.
#ifndef RUNGPROOF_RUN_H
#define RUNGPROOF_RUN_H

#include "rungproof_types.h"

namespace rungproof {

/// The registers of a scan. The top of the bit stack is in `bit` and what is
/// below it in memory, where the lowest byte is no operand: so the verified
/// depth suffices. No stack is checked here, since the verifier has computed
/// every depth.
struct Run {
  Source program;
  const uint8_t* pc;
  uint8_t* bits;
  uint8_t* bit_top;  // one past the bits in memory
  uint8_t bit;
  int32_t* words;
  int32_t* word_top;  // one past the top
  uint32_t* slot_values;
  uint8_t* slot_flags;
  Offset ranges;
};

/// To the end of the program, or to a fault.
RUNGPROOF_APART Fault run_rungs(Run& run);

// The parts of it: one instruction that is not among the frequent ones. Its
// shape is looked up and its address is read already.
RUNGPROOF_APART void push_word(Run& run, uint8_t opcode, uint16_t address);
RUNGPROOF_APART Fault write_word(Run& run, uint16_t address);
RUNGPROOF_APART Fault step_word(Run& run, uint8_t opcode, uint8_t shape);
RUNGPROOF_APART Fault step_element(Run& run, uint8_t opcode, uint16_t slot);

/// Operands.
uint8_t next8(Run& run);
uint16_t next16(Run& run);
int32_t next32(Run& run);

void push_bit(Run& run, uint8_t bit);
uint8_t pop_bit(Run& run);

}  // namespace rungproof

#endif
