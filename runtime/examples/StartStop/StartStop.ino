// A pump is started with a button on pin 5, stopped with one on pin 4, and runs
// on pin 3. The program is start_stop.rung, which was proved to start, to hold
// and to stop; start_stop.h is made of it:
//
//   rungproof check start_stop.rung
//   rungproof lower start_stop.rung --to postfix --header -o start_stop.h
//
// The program says which pins are inputs and which are outputs. The buttons
// connect to 5 V, with resistors to ground.
#include <Rungproof.h>

#include "start_stop.h"

uint32_t memory[start_stop_words];
rungproof::ArduinoIo board;
rungproof::Controller controller;

void setup() { controller.begin(start_stop_program, memory, board); }

void loop() { controller.update(); }
