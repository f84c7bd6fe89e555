// A program in flash, scan after scan, with inputs at random: how long it takes
// can be seen at pins. Without the Arduino core, and without interrupts.
#include <avr/io.h>
#include <avr/pgmspace.h>

#include "rungproof_machine.h"

namespace {

// Written over in the image: boards/image.h.
struct Reserved {
  char mark[16];
  uint32_t size;
  uint8_t program[RUNG_TAPE_BYTES];
};
const Reserved reserved PROGMEM
    __attribute__((used)) = {{'r', 'u', 'n', 'g', 'p', 'r', 'o', 'o', 'f', ' ',
                              't', 'a', 'p', 'e', ' ', '1'},
                             RUNG_TAPE_BYTES,
                             {0}};
uint32_t memory[RUNG_MEMORY_WORDS];
rungproof::Machine machine;

uint32_t random_word() {
  static uint32_t state = 1;
  state = state * 1664525U + 1013904223U;
  return state;
}

}  // namespace

// PB0 is high while a scan runs, PB1 while the program is verified, PB2 when it
// is refused, PB3 after a fault.
int main() {
  DDRB = 15;
  uint32_t length = 0;
  for (uint8_t i = 0; i != 4; ++i) {
    length |= uint32_t{pgm_read_byte(reserved.program + 8 + i)} << 8 * i;
  }
  PORTB = 2;
  const rungproof::Refusal refusal =
      machine.begin(reserved.program, length, memory, RUNG_MEMORY_WORDS);
  PORTB = refusal == rungproof::Refusal::None ? 0 : 4;
  const uint16_t cells = static_cast<uint16_t>(machine.cell_count());
  for (;;) {
    const uint16_t bits = static_cast<uint16_t>(machine.bit_count());
    for (uint16_t cell = 0; cell != cells; ++cell) {
      const uint32_t value = random_word();
      machine.set(cell, static_cast<int32_t>(
                            cell < bits ? value >> 31 : value >> (value & 31)));
    }
    // Also times at which a timer stays at its end.
    uint32_t dt = random_word() >> (random_word() >> 27);
    asm volatile("" : "+r"(dt));  // here, not in what is measured
    PORTB = 1;
    const bool complete = machine.scan(dt);
    PORTB = complete ? 0 : 8;
  }
}
