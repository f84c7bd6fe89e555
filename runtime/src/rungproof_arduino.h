// The pins and the clock of an Arduino board.
#ifndef RUNGPROOF_ARDUINO_H
#define RUNGPROOF_ARDUINO_H

#include <Arduino.h>

#include "rungproof_io.h"

namespace rungproof {

/// Words come from analogRead() and go to analogWrite(), which takes 0 to 255:
/// what is outside is brought to the nearest end.
class ArduinoIo : public Io {
 public:
  uint32_t clock_ms() override { return millis(); }

  void direction(uint8_t pin, Direction direction) override {
    pinMode(number(pin), direction == Direction::Output        ? OUTPUT
                         : direction == Direction::InputPullUp ? INPUT_PULLUP
                                                               : INPUT);
  }

  int32_t read(uint8_t pin, Signal signal) override {
    return signal == Signal::Bit ? digitalRead(number(pin))
                                 : analogRead(number(pin));
  }

  void write(uint8_t pin, Signal signal, int32_t value) override {
    if (signal == Signal::Bit) {
      digitalWrite(number(pin), value != 0 ? HIGH : LOW);
    } else {
      analogWrite(number(pin), value < 0 ? 0 : value > 255 ? 255 : value);
    }
  }

 private:
  static uint8_t number(uint8_t pin) {
    return pin < kAnalogPin ? pin : A0 + (pin - kAnalogPin);
  }
};

}  // namespace rungproof

#endif
