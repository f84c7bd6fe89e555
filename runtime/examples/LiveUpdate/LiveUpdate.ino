// A program that is replaced while it runs: no compiler, no reflashing, and
// what was loaded last is there again after a power cut.
//
// The board starts with start_stop.rung. Then, on the computer:
//
//   rungproof upload two_hands.rung --port /dev/ttyACM0
//   rungproof monitor --port /dev/ttyACM0
//
// The board verifies what comes in before it runs any of it. start_stop.h is
// made by `rungproof lower start_stop.rung --to postfix --header`.
#include <Rungproof.h>

#include "start_stop.h"

// One program runs, one comes in.
const uint16_t kProgramBytes = 400;
uint8_t programs[2 * kProgramBytes];

// For inputs, outputs, memory and timers of any program that comes.
const uint16_t kMemoryWords = 64;
uint32_t memory[kMemoryWords];

rungproof::ArduinoIo board;

#ifdef __AVR__
rungproof::Eeprom eeprom;
rungproof::Store store(eeprom);
rungproof::Store* const storage = &store;
#else
rungproof::Store* const storage = nullptr;  // derive one from Storage
#endif

rungproof::LiveController controller({"LiveUpdate", programs, kProgramBytes,
                                      kMemoryWords, storage},
                                     memory, board);

// On a Yun, Serial1 is the line to its Linux side; see docs/link.md.
void setup() {
  Serial.begin(115200);
  controller.begin(start_stop_program, sizeof start_stop_program);
}

void loop() { controller.update(Serial); }
