// Which pin each input and output of a program is on.
#ifndef RUNGPROOF_WIRING_H
#define RUNGPROOF_WIRING_H

#include "rungproof_io.h"
#include "rungproof_machine.h"

namespace rungproof {

/// The inputs and outputs of a verified program, in the order of its cells.
class Points {
 public:
  explicit Points(const Source& program);

  /// Goes to the next one; false where there is none.
  bool next();
  Role role() const { return role_; }
  Signal signal() const {
    return next_ <= bit_count_ ? Signal::Bit : Signal::Word;
  }
  /// Where the name is in the program: its length, its bytes.
  Offset name() const { return name_; }

 private:
  Source program_;
  Offset bit_count_;
  Offset cell_count_;
  Offset next_;  // cell
  Offset next_name_;
  Offset name_;
  Role role_;
};

class PinSet {
 public:
  PinSet() : bits_() {}
  bool has(uint8_t pin) const { return (bits_[pin >> 3] & mask(pin)) != 0; }
  void add(uint8_t pin) {
    bits_[pin >> 3] = static_cast<uint8_t>(bits_[pin >> 3] | mask(pin));
  }

 private:
  static uint8_t mask(uint8_t pin) {
    return static_cast<uint8_t>(1U << (pin & 7U));
  }
  uint8_t bits_[32];
};

/// The sketch's map, and behind it the names of the yun dialect: `pin0` to
/// `pin127` and `A0` to `A15`.
class Wiring {
 public:
  Wiring() : map_(nullptr), count_(0) {}
  Wiring(const Pin* map, uint8_t count) : map_(map), count_(count) {}

  /// False: neither has a pin of this name.
  bool find(const Source& program, Offset name, uint8_t& pin,
            int16_t& rest) const;

  /// Whether every point has a pin, and every output its own. `at` is the
  /// name of the point that has not; `outputs` the pins of all outputs.
  Refusal check(const Source& program, PinSet& outputs, Offset& at) const;

 private:
  const Pin* map_;
  uint8_t count_;
};

}  // namespace rungproof

#endif
