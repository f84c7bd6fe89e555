#pragma once

#include <map>
#include <string>

#include "rungproof_io.h"

namespace rung {

/// Pins and a clock that a test sets and reads. `log` has what the controller
/// did, a word each: `<3` pin 3 read, `3=1` written, `3:out` its direction.
class FakeBoard : public rungproof::Io {
 public:
  std::uint32_t clock_ms() override { return now; }

  void direction(std::uint8_t pin, rungproof::Direction direction) override {
    static constexpr const char* kNames[] = {"in", "up", "out"};
    const char* const name = kNames[static_cast<int>(direction)];
    directions[pin] = name;
    log += std::to_string(pin) + ":" + name + " ";
  }

  std::int32_t read(std::uint8_t pin, rungproof::Signal signal) override {
    const bool word = signal == rungproof::Signal::Word;
    log += (word ? "<w" : "<") + std::to_string(pin) + " ";
    return levels[pin];
  }

  void write(std::uint8_t pin, rungproof::Signal signal,
             std::int32_t value) override {
    const bool word = signal == rungproof::Signal::Word;
    log +=
        std::to_string(pin) + (word ? "=w" : "=") + std::to_string(value) + " ";
    levels[pin] = value;
  }

  void alive() override { ++alive_count; }

  std::string take_log() {
    std::string taken;
    taken.swap(log);
    return taken;
  }

  std::uint32_t now = 0;
  std::map<int, std::int32_t> levels;
  std::map<int, std::string> directions;
  std::string log;
  int alive_count = 0;
};

}  // namespace rung
