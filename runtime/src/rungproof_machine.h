// Runs a rung program in the binary postfix format (docs/postfix.md).
//
// C++11 without standard library, heap, exceptions or recursion, so that it
// compiles for AVR as it is. Nothing of a program is trusted: begin() verifies
// all of it, and scan() relies on what begin() has verified.
//
//   static uint32_t memory[64];
//   rungproof::Machine machine;
//   if (machine.begin(program, sizeof program, memory, 64) !=
//       rungproof::Refusal::None) { ... }     // machine.refusal() says why
//   loop: machine.set(input, sample); ...      // for every input
//         if (!machine.scan(elapsed_ms)) ...   // outputs to their safe state
//         use machine.value(output);
//
// On AVR the program lies in flash (declare it RUNGPROOF_FLASH), or in RAM if
// begin() is told so.
#ifndef RUNGPROOF_MACHINE_H
#define RUNGPROOF_MACHINE_H

#include <stdint.h>

#include "rungproof_types.h"

namespace rungproof {

class Machine {
 public:
  Machine();

  /// How many uint32_t of memory begin() needs for this program: 0 when the
  /// first 48 bytes are no header of this version. No other check is made.
  static uint32_t memory_words(const uint8_t* program, uint32_t length,
                               Space space = Space::Flash);

  /// Verifies the whole program, then resets. `program` and `memory` stay in
  /// use as long as the machine. Time: one pass over the program, linear.
  Refusal begin(const uint8_t* program, uint32_t length, uint32_t* memory,
                uint32_t memory_words, Space space = Space::Flash);

  /// begin() with another program in the same memory. One that is refused
  /// leaves the machine as it is: the old program and its image are valid
  /// until the new one is verified as a whole. Verifying takes memory only for
  /// skips, from what the old program leaves free.
  Refusal replace(const uint8_t* program, uint32_t length,
                  Space space = Space::Flash);
  Refusal refusal() const { return refusal_; }
  /// Byte offset in the program that refusal() speaks of.
  uint32_t refused_at() const { return refused_at_; }

  /// Before the first scan: initial values, timers and counters cleared.
  void reset();

  /// One scan, `dt_ms` milliseconds after the one before. All calls of timers
  /// see the same clock. False: the machine is stopped (no program, or a
  /// fault), cells are as the fault left them, and outputs belong in their
  /// safe state.
  bool scan(uint32_t dt_ms);
  Fault fault() const { return fault_; }
  uint32_t fault_at() const { return fault_at_; }

  /// False when some dt was not in the program's scan interval: what was
  /// proved about the program assumes that it always is.
  bool interval_held() const { return interval_held_; }
  uint32_t scan_min_ms() const { return scan_min_; }
  uint32_t scan_max_ms() const { return scan_max_; }

  /// Cells are numbered from 0, the bits first. Numbers past the end: role is
  /// Memory, value 0, and set() does nothing.
  uint32_t bit_count() const { return bit_count_; }
  uint32_t cell_count() const { return cells(); }
  Role role(Offset cell) const;
  int32_t value(Offset cell) const;

  /// Samples an input. A word outside its declared range is brought to the
  /// nearest end of it, because what was proved assumes the range; the result
  /// is false then, and for a cell that is no input.
  bool set(Offset cell, int32_t value);

  /// The number of the cell `name`; cell_count() when there is none. Linear.
  uint32_t find(const char* name) const;
  /// The length of a cell's name, of which up to `size` bytes are copied to
  /// `buffer` (not terminated). Linear.
  uint8_t name(Offset cell, char* buffer, uint8_t size) const;

 private:
  friend class Controller;
  /// Whether the program could run in this machine's memory, from the word
  /// `used_` of which verifying may write.
  Refusal check(const Source& program, uint32_t length);
  void start(const Source& program);
  /// The timers; the result is where the code is, behind the table of slots.
  Offset advance(uint32_t dt_ms);
  Offset cells() const { return Offset{bit_count_} + word_count_; }
  /// Where the ranges of words are in the program: behind header and
  /// attributes.
  Offset ranges() const { return Offset{48} + cells(); }
  /// Signed words may alias the caller's array.
  int32_t* words() const { return reinterpret_cast<int32_t*>(memory_); }

  Source program_;
  // Words, slots and the word stack; then in bytes bits, slots and the bit
  // stack.
  uint32_t* memory_;
  Offset memory_words_;
  Offset used_;  // words of the memory that are in use
  uint8_t* bits_;
  uint16_t bit_count_;
  uint16_t word_count_;
  uint16_t slot_count_;
  uint32_t scan_min_;
  uint32_t scan_max_;
  Offset refused_at_;
  Offset fault_at_;
  Refusal refusal_;
  Fault fault_;
  bool interval_held_;
};

}  // namespace rungproof

#endif
