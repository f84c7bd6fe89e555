#include "rungproof_run.h"

#include "rungproof_bytes.h"
#include "rungproof_format.h"

namespace rungproof {
namespace {

// Three things that the compiler for AVR does not find by itself, worth a
// quarter of the time: the load moves the program counter on, which stays in Z
// because cells are reached through Y, which the argument leaves free.
#ifdef __AVR__
#define RUNGPROOF_NEXT(byte)                           \
  uint8_t byte;                                        \
  if (space == Space::Flash)                           \
    asm volatile("lpm %0, Z+" : "=r"(byte), "+z"(pc)); \
  else                                                 \
    asm volatile("ld %0, Z+" : "=r"(byte), "+z"(pc) : : "memory")
#define RUNGPROOF_IN_Y(pointer) asm("" : "+y"(pointer))
#define RUNGPROOF_ASIDE(pointer) asm volatile("" : "+l"(pointer))
#else
#define RUNGPROOF_NEXT(byte) const uint8_t byte = *pc++
#define RUNGPROOF_IN_Y(pointer)
#define RUNGPROOF_ASIDE(pointer)
#endif

// The frequent instructions, the most frequent first: reading, writing and
// combining bits. Returns the first opcode that is none of them; `pc` is behind
// it. A loop without calls, so that everything stays in registers.
template <Space space>
RUNGPROOF_APART uint8_t run_bits(Run* run) {
  const uint8_t* pc = run->pc;
  uint8_t* top = run->bit_top;
  uint8_t* const bits = run->bits;
  uint8_t bit = run->bit;
  uint8_t opcode = 0;
  RUNGPROOF_ASIDE(run);
  for (;;) {
    RUNGPROOF_NEXT(next);
    opcode = next;
    if (opcode == kReadBit) {
      RUNGPROOF_NEXT(address);
      const uint8_t* cell = bits + address;
      RUNGPROOF_IN_Y(cell);
      *top++ = bit;
      bit = *cell;
    } else if (opcode == kWriteBit) {
      RUNGPROOF_NEXT(address);
      uint8_t* cell = bits + address;
      RUNGPROOF_IN_Y(cell);
      *cell = bit;
      --top;
    } else if (opcode == kAnd) {
      bit &= *--top;
    } else if (opcode == kOr) {
      bit |= *--top;
    } else if (opcode == kXor) {
      bit ^= *--top;
    } else if (opcode == kNot) {
      bit ^= 1;
    } else {
      break;
    }
  }
  RUNGPROOF_ASIDE(run);
  run->pc = pc;
  run->bit_top = top;
  run->bit = bit;
  return opcode;
}

uint8_t run_bits(Run& run) {
#ifdef __AVR__
  if (run.program.space == Space::Ram) return run_bits<Space::Ram>(&run);
#endif
  return run_bits<Space::Flash>(&run);
}

void step_bit(Run& run, uint8_t opcode, uint16_t address) {
  if (opcode <= kTrue) {
    push_bit(run, static_cast<uint8_t>(opcode - kFalse));
  } else if (opcode == kReadBit) {
    push_bit(run, run.bits[address]);
  } else if (opcode == kWriteBit) {
    run.bits[address] = pop_bit(run);
  } else {  // kSkipFalse, kSkipTrue: a deciding value stays, else it goes
    const uint16_t distance = next16(run);
    if (run.bit == opcode - kSkipFalse) {
      run.pc += distance;
    } else {
      pop_bit(run);
    }
  }
}

}  // namespace

// Where the program counter is, as a program of its own.
Source next(Run& run, uint8_t bytes) {
  Source at = run.program;
  at.bytes = run.pc;
  run.pc += bytes;
  return at;
}

uint8_t next8(Run& run) { return read8(next(run, 1), 0); }
uint16_t next16(Run& run) { return read16(next(run, 2), 0); }
int32_t next32(Run& run) { return to_signed(read32(next(run, 4), 0)); }

void push_bit(Run& run, uint8_t bit) {
  *run.bit_top++ = run.bit;
  run.bit = bit;
}

uint8_t pop_bit(Run& run) {
  const uint8_t bit = run.bit;
  run.bit = *--run.bit_top;
  return bit;
}

Fault run_rungs(Run& run) {
  Fault fault = Fault::None;
  while (fault == Fault::None) {
    uint8_t opcode = run_bits(run);
    if (opcode == kEnd) break;
    const bool wide = opcode == kWide;
    if (wide) opcode = next8(run);
    const uint8_t shape = shape_of(opcode);
    uint16_t address = 0;
    if ((shape & kShapeAddress) != 0) {
      address = wide ? next16(run) : next8(run);
    }
    if (is_element(opcode)) {
      fault = step_element(run, opcode, address);
    } else if (opcode < kWide) {
      step_bit(run, opcode, address);
    } else if (opcode <= kReadWord) {
      push_word(run, opcode, address);
    } else if (opcode == kWriteWord) {
      fault = write_word(run, address);
    } else {
      fault = step_word(run, opcode, shape);
    }
  }
  return fault;
}

}  // namespace rungproof
