// What the replay needs of a board, emulated or real. One file a board.
#ifndef RUNGPROOF_REPLAY_BOARD_H
#define RUNGPROOF_REPLAY_BOARD_H

#include <stdint.h>

namespace board {

/// Where the tape is: in flash where the controller has a separate one, and
/// read by read().
const uint8_t* tape();
uint8_t read(const uint8_t* at);

/// For the machine.
uint32_t* memory();
uint32_t memory_words();

void begin();
void put(char c);
/// Ends the emulation. The tape is played once.
void end();

}  // namespace board

#endif
