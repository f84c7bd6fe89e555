// The EEPROM of an AVR.
#ifndef RUNGPROOF_EEPROM_H
#define RUNGPROOF_EEPROM_H

#include <avr/eeprom.h>
#include <avr/io.h>

#include "rungproof_store.h"

namespace rungproof {

/// `bytes` of it from `first` on: the rest is the sketch's.
class Eeprom : public Storage {
 public:
  explicit Eeprom(uint16_t first = 0, uint16_t bytes = E2END + 1)
      : first_(first), bytes_(bytes) {}

  uint16_t size() const override { return bytes_; }
  uint8_t read(uint16_t at) const override {
    return eeprom_read_byte(address(at));
  }
  bool ready() const override { return eeprom_is_ready(); }
  void write(uint16_t at, uint8_t byte) override {
    eeprom_write_byte(address(at), byte);
  }

 private:
  uint8_t* address(uint16_t at) const {
    return reinterpret_cast<uint8_t*>(first_ + at);
  }

  uint16_t first_;
  uint16_t bytes_;
};

}  // namespace rungproof

#endif
