// Two pumps take turns (two_pumps.rung). The program's names are no pins, so
// the sketch says where they are; it also has a watchdog, which resets the
// board when no scan comes to its end for a quarter of a second, and says why
// when the program does not start.
#include <Rungproof.h>

#include "two_pumps.h"
#ifdef __AVR__
#include <avr/wdt.h>
#endif

// The overload relays open when they trip, and connect their pin to ground
// until then: with the pull-up resistor (the 1) a broken wire is a trip.
const rungproof::Pin pins[] RUNGPROOF_FLASH = {
    {"I0", 2, 0},  // level switch
    {"I1", 4, 1},  // overload of pump 1
    {"I2", 5, 1},  // overload of pump 2
    {"Q0", 3, 0},  // pump 1; safe: off
    {"Q1", 6, 0},  // pump 2; safe: off
};

class Board : public rungproof::ArduinoIo {
 public:
  void alive() override {
#ifdef __AVR__
    wdt_reset();
#endif
  }
};

uint32_t memory[two_pumps_words];
Board board;
rungproof::Controller controller;

void setup() {
  Serial.begin(115200);
  if (controller.begin(two_pumps_program, memory, board, pins) !=
      rungproof::Refusal::None) {
    Serial.print(F("refused: "));
    Serial.println(static_cast<int>(controller.machine().refusal()));
  }
#ifdef __AVR__
  wdt_enable(WDTO_250MS);
#endif
}

void loop() { controller.update(); }
