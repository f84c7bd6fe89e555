#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>

#include "frontend/error_limit.h"
#include "frontend/statements.h"

namespace rung::melsec {

/// What a word such as `X17` says; `number` as the controller counts.
struct DeviceName {
  char letter = '\0';  // a capital
  std::uint32_t number = 0;
};

/// A relay, the contact of a timer or counter, or a register.
struct Device {
  std::string_view name;  // as the text spells it first
  DeviceName id;
  SourceRange written;   // the first instruction that writes it
  bool zone = false;     // a master control writes it
  bool special = false;  // M8000 and above
  std::optional<std::uint32_t> element;
};

/// K and H constants: 16 bits, signed.
std::optional<std::int64_t> constant_of(std::string_view word);

/// How long one count of a timer takes, and whether it keeps its time.
struct TimerBase {
  std::int64_t milliseconds = 100;
  bool retentive = false;
};
TimerBase base_of(std::uint32_t timer);

/// The devices of a program. A device is declared where it is first met.
class Devices {
 public:
  Devices(Ast& ast, StatementWriter& writer, ErrorLimit& errors)
      : ast_(ast), writer_(writer), errors_(errors) {}

  /// A device that a word names; null when that was an error.
  Device* find(std::string_view word, SourceRange where);

  /// The contact's value, to stand in an expression.
  void push_contact(Expression& nodes, const Device& device, SourceRange where);

  /// Timer and counter: the element's index. A counter's and a retentive
  /// timer's kind follow from the device's number.
  std::uint32_t element(Device& device, SourceRange where);

  /// M8002 is on in the first scan: two assignments above the program.
  void write_first_scan(SourceRange where);

 private:
  std::optional<DeviceName> parse(std::string_view word, SourceRange where);
  bool is_special(DeviceName id, SourceRange where);
  void declare(const Device& device, SourceRange where);

  Ast& ast_;
  StatementWriter& writer_;
  ErrorLimit& errors_;
  std::unordered_map<std::uint64_t, Device> devices_;
};

}  // namespace rung::melsec
