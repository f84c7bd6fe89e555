#include "rungproof_controller.h"

#include "rungproof_bytes.h"
#include "rungproof_format.h"
#include "rungproof_layout.h"

namespace rungproof {
namespace {

/// A byte for each point, in words.
Offset words_of_pins(const Source& program, const Layout& layout) {
  Offset points = 0;
  for (Offset at = kHeaderBytes; at != layout.ranges; ++at) {
    if ((read8(program, at) & kRoleMask) != static_cast<uint8_t>(Role::Memory))
      ++points;
  }
  return (points + 3) / 4;
}

}  // namespace

Controller::Controller()
    : machine_(),
      io_(nullptr),
      wiring_(),
      pins_(nullptr),
      last_ms_(0),
      state_(State::Empty) {}

uint32_t Controller::memory_words(const uint8_t* program, uint32_t length,
                                  Space space) {
  if (Machine::memory_words(program, length, space) == 0) return 0;
  const Source source(program, space);
  const Layout layout = read_layout(source);
  if (length < uint32_t{kHeaderBytes} + layout.bit_count + layout.word_count) {
    return 0;
  }
  const uint32_t run = words_to_run(layout) + words_of_pins(source, layout);
  const uint32_t verify = words_to_verify(layout);
  return run > verify ? run : verify;
}

Refusal Controller::begin(const uint8_t* program, uint32_t length,
                          uint32_t* memory, uint32_t memory_words, Io& io,
                          const Wiring& wiring, Space space) {
  stop();
  state_ = State::Empty;
  io_ = &io;
  wiring_ = wiring;
  // Without a program the machine takes the memory, and all of it is free.
  machine_.begin(nullptr, 0, memory, memory_words);
  return replace(program, length, Outputs::Clear, space);
}

Refusal Controller::replace(const uint8_t* program, uint32_t length,
                            Outputs outputs, Space space) {
  const Source source(program, space);
  PinSet driven;
  const Refusal refusal = check(source, length, driven);
  if (refusal != Refusal::None) return refusal;
  if (outputs == Outputs::Clear) driven = PinSet();
  start(source, make_safe(driven));
  return Refusal::None;
}

Refusal Controller::check(const Source& program, uint32_t length,
                          PinSet& outputs) {
  if (io_ == nullptr) return Refusal::NoMemory;  // before begin()
  Refusal refusal = machine_.check(program, length);
  if (refusal != Refusal::None) return refusal;
  const Layout layout = read_layout(program);
  if (words_to_run(layout) + words_of_pins(program, layout) >
      machine_.memory_words_) {
    refusal = Refusal::NoMemory;
  } else {
    refusal = wiring_.check(program, outputs, machine_.refused_at_);
  }
  machine_.refusal_ = refusal;
  return refusal;
}

// `held` are output pins that keep what they show.
void Controller::start(const Source& program, const PinSet& held) {
  machine_.start(program);
  pins_ = reinterpret_cast<uint8_t*>(machine_.memory_ + machine_.used_);
  machine_.used_ += words_of_pins(program, read_layout(program));
  uint8_t* next = pins_;
  Points point(program);
  while (point.next()) {
    uint8_t pin = kNotWired;
    int16_t rest = 0;
    wiring_.find(program, point.name(), pin, rest);
    *next++ = pin;
    if (pin == kNotWired) continue;
    if (point.role() == Role::Input) {
      io_->direction(pin,
                     rest != 0 ? Direction::InputPullUp : Direction::Input);
      continue;
    }
    // The level before the direction: the pin never shows another one.
    if (!held.has(pin)) io_->write(pin, point.signal(), rest);
    io_->direction(pin, Direction::Output);
  }
  state_ = State::Running;
  last_ms_ = io_->clock_ms();
}

bool Controller::update() {
  if (state_ != State::Running) {
    if (io_ != nullptr) io_->alive();
    return false;
  }
  const uint32_t now = io_->clock_ms();
  const uint32_t elapsed = now - last_ms_;  // also across the roll-over
  if (elapsed < machine_.scan_min_ms()) return false;
  last_ms_ = now;
  exchange(Role::Input);
  const bool complete = machine_.scan(elapsed);
  if (complete) {
    exchange(Role::Output);
  } else {
    make_safe(PinSet());
    state_ = State::Faulted;
  }
  io_->alive();
  return complete;
}

// Reads all inputs, or writes all outputs.
void Controller::exchange(Role role) {
  const uint8_t* next = pins_;
  const Offset cells = machine_.cells();
  for (Offset cell = 0; cell != cells; ++cell) {
    const Role found = machine_.role(cell);
    if (found == Role::Memory) continue;
    const uint8_t pin = *next++;
    if (found != role || pin == kNotWired) continue;
    const Signal signal =
        cell < machine_.bit_count_ ? Signal::Bit : Signal::Word;
    if (role == Role::Input) {
      machine_.set(cell, io_->read(pin, signal));
    } else {
      io_->write(pin, signal, machine_.value(cell));
    }
  }
}

// Gives the output pins that were left alone. Safe values are looked up again,
// by name: a fault is rare, and memory is not plentiful.
PinSet Controller::make_safe(const PinSet& except) {
  PinSet left;
  if (state_ == State::Empty) return left;
  Points point(machine_.program_);
  while (point.next()) {
    uint8_t pin = kNotWired;
    int16_t rest = 0;
    wiring_.find(machine_.program_, point.name(), pin, rest);
    if (point.role() != Role::Output || pin == kNotWired) continue;
    if (except.has(pin)) {
      left.add(pin);
    } else {
      io_->write(pin, point.signal(), rest);
    }
  }
  return left;
}

void Controller::stop() {
  if (state_ == State::Empty) return;
  make_safe(PinSet());
  state_ = State::Stopped;
}

void Controller::restart() {
  stop();
  if (state_ == State::Empty) return;
  machine_.reset();
  state_ = State::Running;
  last_ms_ = io_->clock_ms();
}

}  // namespace rungproof
