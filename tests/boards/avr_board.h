#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace rung {

/// An ATmega328P ("atmega328p") or ATmega32U4 ("atmega32u4") at 16 MHz, cycle
/// by cycle, by libsimavr. libsimavr is GPL-3: in test programs only.
///
///     AvrBoard board("atmega328p", "sketch.elf");
///     ASSERT_EQ(board.error(), "");
///     board.drive({'D', 2}, true);
///     board.run(16'000'000);  // a second
///     EXPECT_TRUE(board.level({'B', 5}));
class AvrBoard {
 public:
  static constexpr std::uint64_t kHertz = 16'000'000;

  struct Pin {
    char port = 'B';
    int bit = 0;
  };
  enum class State {
    Running,
    Done,     // asleep without interrupts: nothing can happen any more
    Crashed,  // an instruction that is none, or a jump out of the code
  };

  AvrBoard(const std::string& mcu, const std::string& elf_path);
  ~AvrBoard();
  AvrBoard(const AvrBoard&) = delete;
  AvrBoard& operator=(const AvrBoard&) = delete;

  /// Why there is no board; nothing else may be called then.
  const std::string& error() const;

  /// As the reset button: flash, EEPROM and RAM stay. Pins keep being driven.
  void reset();
  /// As a power cut: RAM holds other bytes, what was not yet sent is lost.
  void power_cycle();

  /// Executes `cycles` cycles, and up to the end of an instruction or a sleep.
  State run(std::uint64_t cycles);
  /// The same until `stop` says so, asked behind every instruction.
  State run_until(const std::function<bool()>& stop, std::uint64_t cycles);
  std::uint64_t cycle() const;

  /// To be read and written between two runs.
  std::span<std::uint8_t> flash();
  std::span<std::uint8_t> eeprom();
  std::span<std::uint8_t> data();  // registers, then RAM

  /// Inputs from outside; an analog one in millivolts of 5000.
  void drive(Pin pin, bool level);
  void drive_analog(int channel, std::uint32_t millivolts);

  /// The level that an output pin has.
  bool level(Pin pin);
  struct Change {
    std::uint64_t cycle = 0;
    bool level = false;
  };
  /// Records the changes of a pin from now on; of all that were asked for, a
  /// waveform (VCD) can be written, with the pins' names.
  void watch(Pin pin, std::string name);
  const std::vector<Change>& changes(Pin pin) const;
  std::string waveform() const;

  /// The serial port: UART 0, of the ATmega32U4 UART 1.
  void send(std::string_view bytes);
  std::string take_output();  // since the last call

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace rung
