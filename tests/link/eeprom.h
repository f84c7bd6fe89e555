#pragma once

#include <cstdint>
#include <vector>

#include "rungproof_store.h"

namespace rung {

/// An EEPROM whose power can be cut in the middle of a write.
class Eeprom : public rungproof::Storage {
 public:
  explicit Eeprom(std::size_t size) : bytes_(size, 0xff) {}

  std::uint16_t size() const override {
    return static_cast<std::uint16_t>(bytes_.size());
  }
  std::uint8_t read(std::uint16_t at) const override { return bytes_.at(at); }
  bool ready() const override { return ++asked_ % wait_ == 0; }
  void write(std::uint16_t at, std::uint8_t byte) override {
    if (dead_) return;
    dead_ = writes_++ == cut_at_;
    bytes_.at(at) = dead_ ? torn_ : byte;
    if (at == stuck_) bytes_[at] = stuck_at_;
  }

  /// The write of that number leaves `torn` behind, and none comes after it.
  void cut(std::size_t number, std::uint8_t torn) {
    cut_at_ = writes_ + number;
    torn_ = torn;
  }
  void power_up() {
    dead_ = false;
    cut_at_ = kNever;
  }
  bool dead() const { return dead_; }
  std::size_t writes() const { return writes_; }
  /// Whatever is written there from now on, this is what it holds.
  void wear_out(std::uint16_t at, std::uint8_t value = 0x5a) {
    stuck_ = at;
    stuck_at_ = value;
  }
  /// ready() is true at every `calls`th call.
  void slow_down(unsigned calls) { wait_ = calls; }
  std::vector<std::uint8_t>& bytes() { return bytes_; }

 private:
  static constexpr std::size_t kNever = ~std::size_t{0};

  std::vector<std::uint8_t> bytes_;
  std::size_t writes_ = 0;
  std::size_t cut_at_ = kNever;
  std::uint32_t stuck_ = 0x10000;
  std::uint8_t torn_ = 0;
  std::uint8_t stuck_at_ = 0;
  unsigned wait_ = 1;
  mutable unsigned asked_ = 0;
  bool dead_ = false;
};

}  // namespace rung
