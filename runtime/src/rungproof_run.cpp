#include "rungproof_run.h"

#include "rungproof_bytes.h"
#include "rungproof_format.h"

namespace rungproof {
namespace {

// Two things that the compiler for AVR does not find by itself, worth four
// cycles of twenty: the program counter stays in Z, the only pointer to flash,
// and is moved on by the load.
#ifdef __AVR__
#define RUNGPROOF_PC(start) register const uint8_t* pc asm("r30") = start
#define RUNGPROOF_NEXT(byte)                           \
  uint8_t byte;                                        \
  if (space == Space::Flash)                           \
    asm volatile("lpm %0, Z+" : "=r"(byte), "+z"(pc)); \
  else                                                 \
    asm volatile("ld %0, Z+" : "=r"(byte), "+z"(pc) : : "memory")
#define RUNGPROOF_LOW(pointer) asm volatile("" : "+l"(pointer))
#else
#define RUNGPROOF_PC(start) const uint8_t* pc = start
#define RUNGPROOF_NEXT(byte) const uint8_t byte = *pc++
#define RUNGPROOF_LOW(pointer)
#endif

// The frequent instructions, the most frequent first: reading, writing and
// combining bits. Returns the first opcode that is none of them; `pc` is behind
// it. A loop without calls, so that everything stays in registers.
template <Space space>
__attribute__((noinline)) uint8_t run_bits(Run* run) {
  RUNGPROOF_PC(run->pc);
  uint8_t* top = run->bit_top;
  uint8_t* const bits = run->bits;
  uint8_t bit = run->bit;
  uint8_t opcode = 0;
  RUNGPROOF_LOW(run);
  for (;;) {
    RUNGPROOF_NEXT(next);
    opcode = next;
    if (opcode == kReadBit) {
      RUNGPROOF_NEXT(address);
      *top++ = bit;
      bit = bits[address];
    } else if (opcode == kWriteBit) {
      RUNGPROOF_NEXT(address);
      bits[address] = bit;
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
  RUNGPROOF_LOW(run);
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

uint8_t next8(Run& run) {
  Source at = run.program;
  at.bytes = run.pc++;
  return read8(at, 0);
}

uint16_t next16(Run& run) {
  const uint16_t low = next8(run);
  return static_cast<uint16_t>(low | (next8(run) << 8));
}

int32_t next32(Run& run) {
  const uint32_t low = next16(run);
  return to_signed(low | (static_cast<uint32_t>(next16(run)) << 16));
}

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
    uint16_t address = 0;
    if ((shape_of(opcode) & kShapeAddress) != 0) {
      address = wide ? next16(run) : next8(run);
    }
    if (opcode < kWide) {
      step_bit(run, opcode, address);
    } else {
      fault = is_element(opcode) ? step_element(run, opcode, address)
                                 : step_word(run, opcode, address);
    }
  }
  return fault;
}

}  // namespace rungproof
