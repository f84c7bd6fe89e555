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
// On AVR the program lies in flash: declare it PROGMEM.
#ifndef RUNGPROOF_MACHINE_H
#define RUNGPROOF_MACHINE_H

#include <stdint.h>

namespace rungproof {

/// Why a program is refused. The numbers are part of the format.
enum class Refusal : uint8_t {
  None = 0,
  TooShort = 1,         // fewer bytes than a header
  BadMagic = 2,         // no postfix binary
  BadVersion = 3,       // of a format that this machine does not know
  BadLength = 4,        // the header's length is not the number of bytes
  BadChecksum = 5,      // CRC-32
  BadHeader = 6,        // unknown flag or dialect, or no scan interval
  BadSections = 7,      // the sections do not fill the program exactly
  BadCell = 8,          // attributes, or a range without its initial value
  BadSlot = 9,          // unknown element kind, or an index below 0
  BadName = 10,         // names do not match the cells, or hold bad bytes
  BadNote = 11,         // property lines do not fill their section
  BadOpcode = 12,       // no such instruction
  BadEnd = 13,          // code stops inside an instruction or does not end
  NotShortest = 14,     // an operand that a shorter instruction holds
  BadAddress = 15,      // no such cell
  BadElement = 16,      // no such slot, or a slot of another kind
  WritesInput = 17,     // a rung's target is an input
  StackUnderflow = 18,  // an operand is missing
  StackNotEmpty = 19,   // a rung leaves a value behind, or is not finished
  BadSkip = 20,         // a skip out of its rung, into an instruction, across
                        // another, or between unequal stacks
  StrictSkip = 21,      // a skip in a program of strict evaluation
  BadDivisor = 22,      // the divisor is not a constant other than zero
  WrongDepth = 23,      // claimed stack or skip depth is not the one computed
  NoMemory = 24,        // the caller's memory is too small
};

/// Why scan() stopped. The machine then stays stopped until reset().
enum class Fault : uint8_t {
  None = 0,
  Overflow = 1,  // a word or a counter would leave 32 bits
  Range = 2,     // a word cell would leave its range
};

enum class Role : uint8_t { Input = 0, Output = 1, Memory = 2 };

/// A position in a program. An array in flash is shorter than 64 KiB on AVR,
/// and there 16-bit arithmetic takes half the code.
#ifdef __AVR__
typedef uint16_t Offset;
#else
typedef uint32_t Offset;
#endif

/// Where the parts of a program start, as byte offsets; and its counts.
struct Layout {
  Offset attributes;
  Offset ranges;
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

class Machine {
 public:
  Machine();

  /// How many uint32_t of memory begin() needs for this program: 0 when the
  /// first 48 bytes are no header of this version. No other check is made.
  static uint32_t memory_words(const uint8_t* program, uint32_t length);

  /// Verifies the whole program, then resets. `program` and `memory` stay in
  /// use as long as the machine. Time: one pass over the program, linear.
  Refusal begin(const uint8_t* program, uint32_t length, uint32_t* memory,
                uint32_t memory_words);
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
  uint32_t fault_at() const { return pc_; }

  /// False when some dt was not in the program's scan interval: what was
  /// proved about the program assumes that it always is.
  bool interval_held() const { return interval_held_; }
  uint32_t scan_min_ms() const { return scan_min_; }
  uint32_t scan_max_ms() const { return scan_max_; }

  /// Cells are numbered from 0, the bits first. Numbers past the end: role is
  /// Memory, value 0, and set() does nothing.
  uint32_t bit_count() const { return layout_.bit_count; }
  uint32_t cell_count() const {
    return static_cast<uint32_t>(layout_.bit_count) + layout_.word_count;
  }
  Role role(uint32_t cell) const;
  int32_t value(uint32_t cell) const;

  /// Samples an input. A word outside its declared range is brought to the
  /// nearest end of it, because what was proved assumes the range; the result
  /// is false then, and for a cell that is no input.
  bool set(uint32_t cell, int32_t value);

  /// The number of the cell `name`; cell_count() when there is none. Linear.
  uint32_t find(const char* name) const;
  /// The length of a cell's name, of which up to `size` bytes are copied to
  /// `buffer` (not terminated). Linear.
  uint8_t name(uint32_t cell, char* buffer, uint8_t size) const;

 private:
  bool run();
  void step_bit(uint8_t opcode, bool wide);
  bool step_word(uint8_t opcode, bool wide);
  bool arithmetic(uint8_t opcode);
  void compare(uint8_t opcode);
  bool write_word(uint16_t word);
  bool step_element(uint8_t opcode, bool wide);
  bool count_sim(uint16_t slot, int32_t preset);
  uint16_t address(bool wide);

  const uint8_t* program_;
  Layout layout_;
  int32_t* words_;
  uint32_t* slot_values_;  // elapsed ms; counter values
  int32_t* word_stack_;
  uint8_t* bits_;
  uint8_t* slot_flags_;
  uint8_t* bit_stack_;
  Offset pc_;
  int32_t* word_top_;  // one past the top
  uint8_t* bit_top_;
  uint32_t scan_min_;
  uint32_t scan_max_;
  Offset refused_at_;
  Refusal refusal_;
  Fault fault_;
  bool interval_held_;
};

}  // namespace rungproof

#endif
