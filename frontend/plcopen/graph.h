#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "base/source.h"
#include "frontend/error_limit.h"
#include "frontend/plcopen/xml.h"

namespace rung::plcopen {

enum class ElementKind : std::uint8_t {
  LeftRail,
  RightRail,
  Contact,
  Coil,
  Block,
  InVariable,
  OutVariable,
  InOutVariable,
  Connector,
  Continuation,
};

enum class Edge : std::uint8_t { None, Rising, Falling };
enum class Storage : std::uint8_t { None, Set, Reset };

/// What a contact, a coil or a pin does to the value that passes.
struct Modifier {
  bool negated = false;
  Edge edge = Edge::None;
  Storage storage = Storage::None;

  bool is_plain() const {
    return !negated && edge == Edge::None && storage == Storage::None;
  }
};

struct Point {
  std::int64_t x = 0;
  std::int64_t y = 0;
  friend bool operator==(const Point&, const Point&) = default;
};

/// One `connection`: where an input takes its value from.
struct Wire {
  std::uint32_t source = 0;  // in Graph::elements
  std::uint32_t output = 0;  // of a block: in its outputs
  SourceRange where;
};

/// An input or an output of an element. Only blocks have several of them.
struct Pin {
  std::string_view name;  // `formalParameter`; may be empty
  Modifier modifier;
  SourceRange where;
  Point place;              // of an output, within its element
  std::vector<Wire> wires;  // of an input: several are an OR
};

struct Element {
  ElementKind kind = ElementKind::LeftRail;
  SourceRange where;
  Point place;
  std::int64_t order = 0;  // executionOrderId; 0: none
  Modifier modifier;
  Text text;              // the variable, the expression, the connector's name
  std::string_view type;  // of a block
  std::string_view instance;  // of a block that is no function
  std::vector<Pin> inputs;
  std::vector<Pin> outputs;
  std::uint32_t connector = 0;  // of a continuation: the element it continues
};

/// A body that is drawn: elements in document order, wires from sink to source.
struct Graph {
  std::vector<Element> elements;
  SourceRange where;

  const Element& source_of(const Wire& wire) const {
    return elements[wire.source];
  }
  /// Whose inputs feed this one: a continuation has those of its connector.
  const Element& driver(std::uint32_t element) const {
    const Element& one = elements[element];
    return one.kind == ElementKind::Continuation ? elements[one.connector]
                                                 : one;
  }
};

/// Finds the connector of each continuation, and refuses drawings that have no
/// meaning: wires in a circle (RP097), continuations without a connector and
/// what drives nothing and is not driven (RP096), and drawings that write
/// nothing at all (RP098). Linear.
void check_graph(Graph& graph, ErrorLimit& errors);

/// "`start` (contact)", for messages.
std::string shown(const Element& element);

}  // namespace rung::plcopen
