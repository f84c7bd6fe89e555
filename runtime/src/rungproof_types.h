// What the parts of the runtime have in common.
#ifndef RUNGPROOF_TYPES_H
#define RUNGPROOF_TYPES_H

#include <stdint.h>

/// Behind the name of a constant array: programs and pin maps.
#ifdef __AVR__
#include <avr/pgmspace.h>
#define RUNGPROOF_FLASH PROGMEM
#else
#define RUNGPROOF_FLASH
#endif

/// Of what runs in a scan: cycles are the same in every sketch, and registers
/// are saved where they are used.
#define RUNGPROOF_APART __attribute__((noinline))

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
  // By a Controller, of a program that a Machine would run.
  NoPin = 64,     // an input or output that is on no pin
  PinTaken = 65,  // an output on a pin that another input or output is on
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

/// The address space that a program's bytes lie in. It makes a difference on
/// AVR alone: there a constant array is in flash when it is declared
/// RUNGPROOF_FLASH.
enum class Space : uint8_t { Flash = 0, Ram = 1 };

/// A program's bytes, where they lie.
struct Source {
#ifdef __AVR__
  Source(const uint8_t* at, Space in) : bytes(at), space(in) {}
  const uint8_t* bytes;
  Space space;
#else
  Source(const uint8_t* at, Space) : bytes(at) {}
  const uint8_t* bytes;
#endif
};

}  // namespace rungproof

#endif
