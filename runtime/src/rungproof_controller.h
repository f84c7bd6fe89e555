// Runs a rung program on a board's pins: inputs are read once a scan, the
// program runs, outputs are written once.
//
//   uint32_t memory[program_memory];
//   rungproof::ArduinoIo board;
//   rungproof::Controller controller;
//   void setup() { controller.begin(program, memory, board); }
//   void loop() { controller.update(); }
//
// The program's own names say which pin is what (docs/controllers.md); a
// sketch with other names gives a map. No pin needs pinMode().
#ifndef RUNGPROOF_CONTROLLER_H
#define RUNGPROOF_CONTROLLER_H

#include <stddef.h>
#include <stdint.h>

#include "rungproof_io.h"
#include "rungproof_machine.h"
#include "rungproof_wiring.h"

namespace rungproof {

enum class State : uint8_t {
  Empty,  // no program
  Running,
  Faulted,  // the program stopped: machine().fault(); outputs are safe
  Stopped,  // stop() was called; outputs are safe
};

/// What the pins of outputs do while a program takes another's place.
enum class Outputs : uint8_t {
  Hold,   // keep their level to the end of the new program's first scan
  Clear,  // go to their safe values until then
};

class Controller {
 public:
  Controller();

  /// How many uint32_t of memory begin() needs; 0 where the first bytes are no
  /// header, or the program is shorter than its header says.
  static uint32_t memory_words(const uint8_t* program, uint32_t length,
                               Space space = Space::Flash);

  /// Verifies the program, finds its pins, gives them their direction with
  /// the outputs at their safe values. `io`, `memory` and the map stay in use,
  /// also when the program is refused: replace() may bring one later. The
  /// machine's refused_at() of NoPin and PinTaken is the name of the point.
  Refusal begin(const uint8_t* program, uint32_t length, uint32_t* memory,
                uint32_t memory_words, Io& io, const Wiring& wiring = Wiring(),
                Space space = Space::Flash);

  /// The same for arrays in flash.
  template <size_t length, size_t words>
  Refusal begin(const uint8_t (&program)[length], uint32_t (&memory)[words],
                Io& io) {
    return begin(program, length, memory, words, io);
  }
  template <size_t length, size_t words, size_t lines>
  Refusal begin(const uint8_t (&program)[length], uint32_t (&memory)[words],
                Io& io, const Pin (&map)[lines]) {
    static_assert(lines < 256, "a pin map has at most 255 lines");
    return begin(program, length, memory, words, io, Wiring(map, lines));
  }

  /// One scan, when the program's shortest scan time has passed since the last
  /// one; the time that has passed is the time of the scan. Never waits. True:
  /// a scan has run to its end, and machine() shows the image that it left.
  ///
  /// A scan that comes later than the program's longest scan time is made as
  /// any other, and machine().interval_held() is false from then on.
  bool update();

  /// Another program in place of this one, between two scans: verified as a
  /// whole and its pins found before anything changes. Refused: the old one
  /// goes on as if nothing had been. It starts with its initial values, held
  /// outputs or not, since that is what was proved about it. Pins that are
  /// outputs of the old program alone go to their safe values.
  /// `program` stays in use as long as it runs.
  Refusal replace(const uint8_t* program, uint32_t length, Outputs outputs,
                  Space space = Space::Flash);

  /// Outputs to their safe values, until restart().
  void stop();
  /// The program from its beginning, also after a fault.
  void restart();

  State state() const { return state_; }
  /// By the board's clock; of a program's first scan, when it was started.
  uint32_t last_scan_ms() const { return last_ms_; }
  const Machine& machine() const { return machine_; }
  /// For inputs that are kNotWired.
  Machine& machine() { return machine_; }

 private:
  Refusal check(const Source& program, uint32_t length, PinSet& outputs);
  void start(const Source& program, const PinSet& held);
  void exchange(Role role);
  PinSet make_safe(const PinSet& except);

  Machine machine_;
  Io* io_;
  Wiring wiring_;
  uint8_t* pins_;  // of the points in their order, behind the machine's memory
  uint32_t last_ms_;
  State state_;
};

}  // namespace rungproof

#endif
