#pragma once

#include <cstdint>
#include <span>
#include <string_view>

namespace rung {

/// Timers, counters and edges, defined once, as data. The transition system,
/// the lowering and docs/elements.md derive from these tables; the simulator
/// does not (it is the second opinion and has elements of its own).
///
/// Step texts are formulas (analysis/formula.h) over the names of the states,
/// of the operation's bit and word operands, and `p`, the time or count
/// operand. A primed name is the value after the updates that stand above the
/// line. An update of a name that is no state defines it, for the lines below.
/// `any` is a fresh free bit: there the encoding allows more runs than the
/// program has.

enum class StateType : std::uint8_t {
  Bit,
  Clock,  // ms since it was last set to 0; grows with time while `running`
  Count,  // an integer in [low, high]
};

/// One state variable of an element.
struct ElementState {
  std::string_view name;
  StateType type = StateType::Bit;
  std::string_view running = {};  // Clock: a formula over the bit states
  /// Count: bounds, as formulas over `p`, the instance's largest parameter.
  std::string_view low = {};
  std::string_view high = {};
};

enum class ParameterKind : std::uint8_t { Index, Seconds, Count, Bit, Word };

struct ElementParameter {
  std::string_view name;
  ParameterKind kind = ParameterKind::Bit;
};

/// How a time operand in seconds becomes the integer `p` of the step text: the
/// comparison there is exact for whole milliseconds.
enum class SecondsRounding : std::uint8_t {
  Floor,    // for `elapsed > p`
  Ceiling,  // for `elapsed >= p`
};

struct ElementUpdate {
  std::string_view state;  // the state it gives a new value to
  std::string_view value;  // a formula; primed names are values so far
};

/// One callable operation, e.g. T or TR, on the state of an element kind.
/// All updates and the result are computed in the order written.
struct ElementOperation {
  std::string_view name;
  std::span<const ElementParameter> parameters;
  std::span<const ElementUpdate> updates;
  std::string_view result;  // a formula
  SecondsRounding rounding = SecondsRounding::Ceiling;
  bool resets = false;      // its purpose is to clear the state (TR, CR)
  bool reads = false;       // it has no updates: an output is looked at
  bool word = false;        // the result is a word
  std::uint8_t opcode = 0;  // in the postfix format, never reused; 0: none
  /// It is what the element is there for: neither a reset nor a look.
  constexpr bool steps() const { return !resets && !reads; }
};

enum class ElementFamily : std::uint8_t { Timer, Counter, Edge, Latch };

/// Initial values of all states are 0.
struct ElementKind {
  std::string_view id;      // "timer-yun": stable
  std::string_view letter;  // "T": instances are named T(0)
  /// "yun"; several are blank-separated; empty: every dialect.
  std::string_view dialect;
  ElementFamily family = ElementFamily::Timer;
  std::string_view summary;  // one sentence for docs/elements.md
  std::string_view source;   // where the definition comes from
  std::span<const ElementState> states;
  std::span<const ElementOperation> operations;
  /// Formulas over the states and `p` that properties may name: T(0).q ...
  std::string_view done = {};   // .q
  std::string_view value = {};  // .elapsed of timers, .value of counters
  bool keeps = false;  // of a timer: nothing but its reset operation clears it
  /// The kind that it is where the controller's clock rolls over; empty: it has
  /// no clock, or one that does not.
  std::string_view rollover = {};

  bool is_in(std::string_view wanted) const;
};

/// Every kind, in a fixed order.
std::span<const ElementKind> element_kinds();

/// The operation `name` of `dialect`, and its kind; nulls when there is none.
struct FoundOperation {
  const ElementKind* kind = nullptr;
  const ElementOperation* operation = nullptr;
};
FoundOperation find_operation(std::string_view dialect, std::string_view name);
FoundOperation find_operation(std::uint8_t opcode);

}  // namespace rung
