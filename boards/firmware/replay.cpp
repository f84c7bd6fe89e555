// Plays a tape: programs, each with the inputs of its scans, executed by the
// machine of runtime/; says after every step what the cells are. boards/tape.h
// describes the tape and the report, and is what writes and reads them.
//
// C++11 without library, as the machine: it is built for bare boards.
#include <stdint.h>

#include "board.h"
#include "rungproof_bytes.h"
#include "rungproof_machine.h"

namespace {

using rungproof::Machine;
using rungproof::Offset;
using rungproof::Role;

// simavr prints by lines and has room for 256 characters of one.
const uint8_t kLine = 120;
uint8_t column = 0;

void put(char c) {
  board::put(c);
  if (++column != kLine) return;
  board::put('\n');
  column = 0;
}

void put_digit(uint8_t nibble) {
  put(static_cast<char>(nibble < 10 ? '0' + nibble : 'a' + (nibble - 10)));
}

void put_byte(uint8_t byte) {
  put_digit(byte >> 4);
  put_digit(byte & 15);
}

void put_word(uint32_t word) {
  for (uint8_t shift = 32; shift != 0; shift -= 8) {
    put_byte(static_cast<uint8_t>(word >> (shift - 8)));
  }
}

/// Four bits a digit, the first in the lowest place; then the words.
void put_cells(const Machine& machine) {
  const uint32_t bits = machine.bit_count();
  for (uint32_t cell = 0; cell < bits; cell += 4) {
    uint8_t digit = 0;
    for (uint8_t i = 0; i != 4 && cell + i < bits; ++i) {
      if (machine.value(cell + i) != 0) digit |= static_cast<uint8_t>(1U << i);
    }
    put_digit(digit);
  }
  for (uint32_t cell = bits; cell < machine.cell_count(); ++cell) {
    put_word(static_cast<uint32_t>(machine.value(cell)));
  }
}

class Player {
 public:
  Player() : tape_(board::tape()), at_(0) {}

  /// One program; false where the tape ends.
  bool play() {
    const uint32_t length = word();
    if (length == 0) return false;
    const uint32_t step_bytes = word();
    const uint32_t steps = word();
    const Offset program = at_;
    at_ += static_cast<Offset>(length);
    const Offset next = at_ + static_cast<Offset>(step_bytes);
    Machine machine;
    put('p');
    put_byte(static_cast<uint8_t>(machine.begin(
        tape_ + program, length, board::memory(), board::memory_words())));
    put_word(machine.refused_at());
    for (uint32_t step = 0; step != steps; ++step) {
      if (!run_step(machine)) break;
    }
    at_ = next;
    return true;
  }

 private:
  uint32_t word() {
    uint32_t value = 0;
    for (uint8_t byte = 4; byte != 0; --byte) {
      value = (value << 8) | board::read(tape_ + at_ + byte - 1);
    }
    at_ += 4;
    return value;
  }

  /// A number of scans with the same inputs.
  bool run_step(Machine& machine) {
    if (machine.refusal() != rungproof::Refusal::None) return false;
    const uint32_t repeat = word();
    const uint32_t dt = word();
    set_inputs(machine);
    for (uint32_t scan = 0; scan != repeat; ++scan) {
      if (machine.scan(dt)) continue;
      put('f');
      put_byte(static_cast<uint8_t>(machine.fault()));
      put_word(scan);
      put_cells(machine);
      return false;
    }
    put('s');
    put_cells(machine);
    return true;
  }

  void set_inputs(Machine& machine) {
    uint8_t bits = 0;
    uint8_t left = 0;
    for (uint32_t cell = 0; cell != machine.cell_count(); ++cell) {
      if (machine.role(cell) != Role::Input) continue;
      if (cell >= machine.bit_count()) {
        machine.set(cell, rungproof::to_signed(word()));
        continue;
      }
      if (left == 0) {
        bits = board::read(tape_ + at_++);
        left = 8;
      }
      machine.set(cell, bits & 1);
      bits >>= 1;
      --left;
    }
  }

  const uint8_t* const tape_;
  Offset at_;
};

}  // namespace

int main() {
  board::begin();
  put('{');
  Player player;
  while (player.play()) {
  }
  put('}');
  board::put('\n');
  board::end();
  return 0;
}
