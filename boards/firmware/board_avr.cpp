// ATmega328P (Uno) and ATmega32U4 (Yun), bare: the report goes out at the
// serial port; sleep without interrupts is the end, also of simavr.
#include <avr/interrupt.h>
#include <avr/io.h>
#include <avr/pgmspace.h>
#include <avr/sleep.h>
#include <util/delay_basic.h>

#include "board.h"

#ifdef UDR0
#define RUNG_UDR UDR0
#define RUNG_UBRR UBRR0
#define RUNG_UCSRA UCSR0A
#define RUNG_UCSRB UCSR0B
#define RUNG_U2X U2X0
#define RUNG_TXEN TXEN0
#else
#define RUNG_UDR UDR1
#define RUNG_UBRR UBRR1
#define RUNG_UCSRA UCSR1A
#define RUNG_UCSRB UCSR1B
#define RUNG_U2X U2X1
#define RUNG_TXEN TXEN1
#endif

namespace {

// The tape is written over these zeros, in the image: boards/image.h.
struct Reserved {
  char mark[16];
  uint32_t size;
  uint8_t tape[RUNG_TAPE_BYTES];
};
const Reserved reserved PROGMEM
    __attribute__((used)) = {{'r', 'u', 'n', 'g', 'p', 'r', 'o', 'o', 'f', ' ',
                              't', 'a', 'p', 'e', ' ', '1'},
                             RUNG_TAPE_BYTES,
                             {0}};

uint32_t machine_memory[RUNG_MEMORY_WORDS];

}  // namespace

namespace board {

const uint8_t* tape() { return reserved.tape; }
uint8_t read(const uint8_t* at) { return pgm_read_byte(at); }
uint32_t* memory() { return machine_memory; }
uint32_t memory_words() { return RUNG_MEMORY_WORDS; }

void begin() {
  RUNG_UBRR = 0;
  RUNG_UCSRA = 1 << RUNG_U2X;  // eight cycles a bit
  RUNG_UCSRB = 1 << RUNG_TXEN;
}

// A character takes 80 cycles. They are waited for, because simavr sleeps on
// the host where a program polls the port's state.
void put(char c) {
  RUNG_UDR = static_cast<uint8_t>(c);
  _delay_loop_1(40);
}

void end() {
  _delay_loop_1(80);
  cli();
  set_sleep_mode(SLEEP_MODE_PWR_DOWN);
  sleep_enable();
  for (;;) sleep_cpu();
}

}  // namespace board
