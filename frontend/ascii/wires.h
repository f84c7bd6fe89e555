#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "frontend/ascii/drawing.h"
#include "frontend/error_limit.h"

namespace rung::ascii {

enum class Symbol : std::uint8_t {
  Contact,         // [ ]
  NegatedContact,  // [/]
  Greater,         // [>], the second operand below
  Less,            // [<]
  Coil,            // ( )
  NegatedCoil,     // (/)
  Set,             // (S)
  Reset,           // (R)
  Jump,            // >>label
  Timer,           // a box
};

struct Element {
  Symbol symbol = Symbol::Contact;
  Place place;
  SourceRange where;
  std::string_view operand;  // above; of a jump, its label
  SourceRange operand_where;
  std::string_view second;  // below; of a box, its kind
  SourceRange second_where;
  std::int64_t preset_ms = 0;  // of a box
};

constexpr std::uint32_t kNoLink = 0xffff'ffff;

/// A wire from a vertical link to the right, with what is in it.
struct Run {
  Place place;                 // its first character
  std::uint32_t from = 0;      // links
  std::uint32_t to = kNoLink;  // none: it ends open, at the right rail
  std::uint32_t begin = 0;     // of its elements
  std::uint32_t end = 0;
};

/// What is connected vertically: its power is the OR of what comes in from the
/// left, and goes out to the right. The left rail is always on.
struct Link {
  Place place;  // its topmost character
  bool rail = false;
  bool plus = false;                    // a `+` is in it
  std::uint32_t incoming = 0;           // how many runs end here
  std::vector<std::uint32_t> outgoing;  // runs, from top to bottom
};

/// Horizontal wires lead to the right only, so there is no circle.
struct Wires {
  std::vector<Element> elements;  // by run, from left to right
  std::vector<Run> runs;
  std::vector<Link> links;
};

/// Finds all of it. Errors: RP087, RP051: also for each character that belongs
/// to nothing. Linear in the text.
Wires trace_wires(Drawing& drawing, ErrorLimit& errors);

}  // namespace rung::ascii
