// What a Controller asks of a board: a clock and pins.
#ifndef RUNGPROOF_IO_H
#define RUNGPROOF_IO_H

#include <stdint.h>

#include "rungproof_types.h"

namespace rungproof {

enum class Direction : uint8_t { Input, InputPullUp, Output };

/// What is on a pin: 0 and 1, or a measured or controlled value.
enum class Signal : uint8_t { Bit, Word };

/// The board. ArduinoIo is the one of Arduino boards; derive from this class
/// for any other, or to put the points elsewhere, such as behind a port
/// expander. An object lives as long as the controller that uses it.
class Io {
 public:
  /// Milliseconds; starts anywhere and rolls over at 2^32.
  virtual uint32_t clock_ms() { return 0; }
  virtual void direction(uint8_t, Direction) {}
  virtual int32_t read(uint8_t, Signal) { return 0; }
  virtual void write(uint8_t, Signal, int32_t) {}
  /// A scan is complete, or the outputs are in their safe state on purpose:
  /// a watchdog is reset here and nowhere else.
  virtual void alive() {}

 protected:
  // Not virtual: nobody deletes through this class, and there is no heap.
  ~Io() {}
};

/// In a pin's number: an analog pin, counted from 0. `A2` is kAnalogPin + 2.
const uint8_t kAnalogPin = 0x80;

/// A point of the program that is on no pin: the sketch gives such an input
/// its value through Controller::machine() and reads such an output there.
const uint8_t kNotWired = 0xff;

/// A line of a sketch's pin map, an array that is declared RUNGPROOF_FLASH.
struct Pin {
  char name[20];  // of the program's input or output; at most 19 bytes
  uint8_t pin;
  /// What the pin is while nothing drives it. Of an output: its safe value,
  /// which it has before the first scan and from a fault on. Of an input: 1
  /// for the pull-up resistor.
  int16_t rest;
};

}  // namespace rungproof

#endif
