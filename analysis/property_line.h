#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "analysis/property.h"
#include "base/diagnostic.h"

namespace rung {

/// A piece of a property line and its place in the file, so that every
/// message points at the very characters it is about.
struct Slice {
  std::string_view text;
  SourceRange where;

  bool empty() const { return text.empty(); }
  /// Bytes [begin, end) of this slice, trimmed.
  Slice part(std::size_t begin, std::size_t end = std::string_view::npos) const;
};

/// What a property line says, before any name in it is looked up.
struct Statement {
  enum class Kind : std::uint8_t {
    Property,
    Assume,   // formulas[0]
    Input,    // subject [in low..high] or subject [nc] [trip] [reset]
    Output,   // subject
    Scan,     // low..high ms
    Expect,   // subject and verdict
    Ignored,  // read by another part: language, dialect, allow
  };
  Kind kind = Kind::Property;
  Slice line;
  Slice name;     // `NAME:`; empty when there is none
  Slice subject;  // a cell's name, or the name of a property
  Slice verdict;
  std::vector<Slice> formulas;
  /// How `formulas` make those of the property: `%1` is the first one. Empty:
  /// they are those of the property.
  std::vector<std::string> templates;
  /// Form, milliseconds, scans and dominance of a property.
  Property property;
  bool has_range = false;
  std::int64_t low = 0;
  std::int64_t high = 0;
  Wiring wiring;  // of Input: its cell is not looked up yet
};

/// Takes a line apart. No value when it is wrong, which was reported, once.
/// Linear in the line.
std::optional<Statement> parse_statement(const Slice& line,
                                         DiagnosticSink& sink);

/// "always", "only-after": the kind of an obligation, and what unnamed
/// properties are called.
std::string_view to_string(Property::Form form);

/// The parts of `latch`, in the order of Obligation::part.
inline constexpr std::string_view kLatchParts[] = {
    "settable", "sets", "holds", "releasable", "resets", "no-spurious-start"};

}  // namespace rung
