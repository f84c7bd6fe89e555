#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "frontend/plcopen/graph.h"
#include "frontend/plcopen/xml.h"

namespace rung::plcopen {

/// Reads an `LD` or `FBD` element: the drawing, or the list of `rung` elements
/// that ESBMC has in its place.
///
/// Errors: RP094 for what is not supported, by name; RP095 for what is missing
///         or is not well formed; RP096 for wires that lead nowhere. The graph
///         is of no use then.
class GraphReader {
 public:
  explicit GraphReader(const Xml& xml) : xml_(&xml) {}
  Graph read(pugi::xml_node body);

 private:
  struct Reference {  // a `connection`, before every element is known
    std::uint32_t element = 0;
    std::uint32_t pin = 0;
    std::string_view local_id;
    std::string_view output;  // formalParameter
    std::vector<Point> corners;
    SourceRange where;
  };

  void read_element(pugi::xml_node node);
  void read_rail(pugi::xml_node node, ElementKind kind);
  void read_relay(pugi::xml_node node, ElementKind kind);
  void read_variable(pugi::xml_node node, ElementKind kind);
  void read_connector(pugi::xml_node node, ElementKind kind);
  void read_block(pugi::xml_node node);
  void read_pins(pugi::xml_node list, std::uint32_t block, bool inputs);
  void read_input(pugi::xml_node point, std::uint32_t element, Pin pin);
  void read_connection(pugi::xml_node node, std::uint32_t element,
                       std::uint32_t pin);
  Pin read_output(pugi::xml_node point) const;

  std::uint32_t add(pugi::xml_node node, ElementKind kind);
  Text operand(pugi::xml_node element, std::string_view child) const;
  Modifier modifier(pugi::xml_node node) const;
  Point point(pugi::xml_node node) const;
  std::int64_t number(pugi::xml_node node, const char* attribute) const;

  void link();
  bool find_output(const Reference& reference, Element& source,
                   std::uint32_t& output) const;

  // The `rung` elements of ESBMC (rung_reader.cpp).
  void read_rung(pugi::xml_node rung);
  void read_rung_relay(pugi::xml_node node, ElementKind kind,
                       std::uint32_t& power);
  void read_rung_block(pugi::xml_node node);
  void read_rung_pin(pugi::xml_node node, std::uint32_t block);

  const Xml* xml_;
  Graph graph_;
  std::unordered_map<std::string_view, std::uint32_t> by_id_;
  std::vector<Reference> references_;
  std::int64_t rungs_ = 0;
};

}  // namespace rung::plcopen
