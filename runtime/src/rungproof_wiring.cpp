#include "rungproof_wiring.h"

#include <stddef.h>

#include "rungproof_bytes.h"
#include "rungproof_format.h"
#include "rungproof_layout.h"

namespace rungproof {
namespace {

// An array of the sketch is where its constants are.
Source map_bytes(const Pin* line) {
  return Source(reinterpret_cast<const uint8_t*>(line), Space::Flash);
}

bool named(const Source& line, const Source& program, Offset name) {
  const uint8_t size = read8(program, name);
  if (size >= sizeof(Pin::name)) return false;
  for (uint8_t byte = 0; byte != size; ++byte) {
    if (read8(line, byte) != read8(program, name + 1 + byte)) return false;
  }
  return read8(line, size) == '\0';
}

/// A number without leading zeros below `limit`, which takes up a name from
/// its byte `from` on.
bool number(const Source& program, Offset name, uint8_t from, uint8_t limit,
            uint8_t& value) {
  const uint8_t size = read8(program, name);
  if (size <= from || size > from + 3) return false;
  uint16_t sum = 0;
  for (uint8_t byte = from; byte != size; ++byte) {
    const uint8_t digit = read8(program, name + 1 + byte);
    if (digit < '0' || digit > '9') return false;
    if (digit == '0' && byte == from && size != from + 1) return false;
    sum = static_cast<uint16_t>(sum * 10U + digit - '0');
  }
  value = static_cast<uint8_t>(sum);
  return sum < limit;
}

bool own_name(const Source& program, Offset name, uint8_t& pin) {
  const uint8_t first = read8(program, name + 1);
  if (first == 'A') {
    if (!number(program, name, 1, 16, pin)) return false;
    pin = static_cast<uint8_t>(pin | kAnalogPin);
    return true;
  }
  const uint8_t size = read8(program, name);
  return size > 3 && first == 'p' && read8(program, name + 2) == 'i' &&
         read8(program, name + 3) == 'n' &&
         number(program, name, 3, kAnalogPin, pin);
}

}  // namespace

Points::Points(const Source& program)
    : program_(program),
      bit_count_(read16(program, kAtBits)),
      cell_count_(bit_count_ + read16(program, kAtWords)),
      next_(0),
      next_name_(read_layout(program).names),
      name_(0),
      role_(Role::Memory) {}

bool Points::next() {
  while (next_ != cell_count_) {
    name_ = next_name_;
    role_ =
        static_cast<Role>(read8(program_, kHeaderBytes + next_) & kRoleMask);
    next_name_ =
        static_cast<Offset>(next_name_ + 1U + read8(program_, next_name_));
    ++next_;
    if (role_ != Role::Memory) return true;
  }
  return false;
}

bool Wiring::find(const Source& program, Offset name, uint8_t& pin,
                  int16_t& rest) const {
  for (uint8_t i = 0; i != count_; ++i) {
    const Source line = map_bytes(map_ + i);
    if (!named(line, program, name)) continue;
    pin = read8(line, static_cast<Offset>(offsetof(Pin, pin)));
    rest = static_cast<int16_t>(
        to_signed16(read16(line, static_cast<Offset>(offsetof(Pin, rest)))));
    return true;
  }
  rest = 0;
  return own_name(program, name, pin);
}

Refusal Wiring::check(const Source& program, PinSet& outputs,
                      Offset& at) const {
  // Outputs first: what inputs are compared with.
  for (uint8_t pass = 0; pass != 2; ++pass) {
    const Role role = pass == 0 ? Role::Output : Role::Input;
    Points point(program);
    while (point.next()) {
      if (point.role() != role) continue;
      uint8_t pin = 0;
      int16_t rest = 0;
      at = point.name();
      if (!find(program, at, pin, rest)) return Refusal::NoPin;
      if (pin == kNotWired) continue;
      if (outputs.has(pin)) return Refusal::PinTaken;
      if (role == Role::Output) outputs.add(pin);
    }
  }
  return Refusal::None;
}

}  // namespace rungproof
