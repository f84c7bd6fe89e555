// A controller whose program is replaced over a wire while it runs.
//
//   uint8_t programs[2 * 256];
//   uint32_t memory[64];
//   rungproof::ArduinoIo board;
//   rungproof::Eeprom eeprom;                    // AVR; or none
//   rungproof::Store store(eeprom);
//   rungproof::LiveController controller(
//       {"Uno", programs, 256, 64, &store}, memory, board);
//   void setup() {
//     Serial.begin(115200);
//     controller.begin(program, sizeof program);  // unless one is stored
//   }
//   void loop() { controller.update(Serial); }
//
// Nothing else may be printed to that port: `rungproof upload` and `rungproof
// monitor` speak with it (docs/link.md).
#ifndef RUNGPROOF_LIVE_H
#define RUNGPROOF_LIVE_H

#include <stdint.h>

#include "rungproof_controller.h"
#include "rungproof_link.h"

namespace rungproof {

class LiveController : private LinkTarget {
 public:
  /// `memory` has link.memory_words words. All of it stays in use.
  LiveController(const LinkMemory& link, uint32_t* memory, Io& io,
                 const Wiring& wiring = Wiring())
      : controller_(),
        link_(*this, link),
        memory_(memory),
        memory_words_(link.memory_words),
        io_(io),
        wiring_(wiring),
        begun_(false) {}

  /// The newest stored program that the board can run; else this one, which
  /// lies where constants do. When it is refused, nothing runs until one
  /// comes over the wire.
  Refusal begin(const uint8_t* program, uint32_t length) {
    return link_.begin(program, length);
  }

  /// Controller::update(), and what has come through the port: an Arduino's
  /// Serial, or anything with available(), read(), availableForWrite() and
  /// write().
  template <class Port>
  bool update(Port& port) {
    link_.serve(port, io_.clock_ms());
    const uint32_t before = controller_.last_scan_ms();
    if (!controller_.update()) return false;
    link_.scanned(controller_.last_scan_ms() - before);
    return true;
  }

  Controller& controller() { return controller_; }

 private:
  Refusal run(const uint8_t* program, uint32_t length, Space space,
              bool clear) override {
    if (!begun_) {
      begun_ = true;
      return controller_.begin(program, length, memory_, memory_words_, io_,
                               wiring_, space);
    }
    return controller_.replace(program, length,
                               clear ? Outputs::Clear : Outputs::Hold, space);
  }
  uint32_t refused_at() const override {
    return controller_.machine().refused_at();
  }
  const Machine& machine() const override { return controller_.machine(); }

  Controller controller_;
  Link link_;
  uint32_t* memory_;
  uint32_t memory_words_;
  Io& io_;
  Wiring wiring_;
  bool begun_;
};

}  // namespace rungproof

#endif
