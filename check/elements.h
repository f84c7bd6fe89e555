#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "check/terms.h"

namespace rung::check {

/// Timers, counters, edges and latches as the checker knows them: written by
/// hand from the tools' manuals and listings. Nothing here reads the step
/// texts of element_kinds(); only names are shared, so that a certificate can
/// speak of states: kinds, operations and states are called the same.
///
/// A clock is the time since something, in whole milliseconds, without an end:
/// where a certificate names it, its value is cut at the instance's cap.

enum class StateShape : std::uint8_t { Bit, Clock, Count };

struct ElementState {
  std::string_view name;
  StateShape shape = StateShape::Bit;
  /// Of a count: what the certificate may take for granted, as a claim that is
  /// proved with it; of the largest preset.
  std::int64_t (*low)(std::int64_t preset) = nullptr;
  std::int64_t (*high)(std::int64_t preset) = nullptr;
  /// Where a certificate names the count it means this much at least.
  std::int64_t floor = INT64_MIN;
};

/// One element in the middle of a scan, and a call of it.
class Element {
 public:
  Element(Terms& terms, std::vector<Value>& states,
          const std::vector<Value>& arguments, std::int64_t preset,
          std::int64_t longest_scan)
      : terms_(terms),
        states_(states),
        arguments_(arguments),
        preset_(preset),
        longest_scan_(longest_scan) {}

  Value& operator[](std::size_t state) { return states_[state]; }
  Value argument(std::size_t index) const { return arguments_[index]; }
  Value preset() const { return terms_.number(preset_); }
  Value bit(bool value) const { return terms_.bit(value); }
  Value number(std::int64_t value) const { return terms_.number(value); }
  std::int64_t longest_scan() const { return longest_scan_; }

 private:
  Terms& terms_;
  std::vector<Value>& states_;
  const std::vector<Value>& arguments_;
  std::int64_t preset_;
  std::int64_t longest_scan_;
};

/// Gives the states their values after the call; returns its result.
using Step = Value (*)(Element& element);

struct Operation {
  std::string_view name;
  Step step = nullptr;
  bool fires = true;  // counts for `.fired`: neither a reset nor a look
};

struct Kind {
  std::string_view id;
  std::span<const ElementState> states;
  std::span<const Operation> operations;
  /// Does time pass for its clocks? Of the states before the scan.
  Step running = nullptr;
  /// `.q`, and the state that `.elapsed` or `.value` is; -1: none.
  Step done = nullptr;
  int value = -1;
};

/// Null: an element that the checker does not know.
const Kind* find_kind(std::string_view id);
const Operation* find_operation(const Kind& kind, std::string_view name);

/// What the files of this folder add.
std::span<const Kind> script_kinds();
std::span<const Kind> iec_kinds();
std::span<const Kind> matiec_kinds();
std::span<const Kind> controller_kinds();
std::span<const Kind> plclib_kinds();
std::span<const Kind> siemens_kinds();

}  // namespace rung::check
