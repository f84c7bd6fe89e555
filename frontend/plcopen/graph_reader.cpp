#include "frontend/plcopen/graph_reader.h"

#include <algorithm>
#include <charconv>
#include <utility>

#include "frontend/token_list.h"

namespace rung::plcopen {
namespace {

using pugi::xml_node;

/// Outputs are looked for one by one.
constexpr std::size_t kMostPins = 1000;

bool says_nothing(std::string_view name) {
  return name == "position" || name == "relPosition" ||
         name == "documentation" || name == "size";
}

/// What a drawing may not have here, and why.
std::string_view reason_against(std::string_view name) {
  if (name == "jump" || name == "label" || name == "return") {
    return "jumps within a drawing have no order that the tools agree on";
  }
  if (name == "vendorElement" || name == "error") {
    return "what it means is the vendor's";
  }
  return {};
}

}  // namespace

std::string shown(const Element& element) {
  const auto named = [&](std::string_view kind, std::string_view name) {
    return quoted_excerpt(name) + " (" + std::string(kind) + ")";
  };
  const std::string_view text = element.text.text;
  switch (element.kind) {
    case ElementKind::LeftRail:
      return "the left power rail";
    case ElementKind::RightRail:
      return "the right power rail";
    case ElementKind::Contact:
      return named("contact", text);
    case ElementKind::Coil:
      return named("coil", text);
    case ElementKind::Block:
      return element.instance.empty() ? named("block", element.type)
                                      : named(element.type, element.instance);
    case ElementKind::InVariable:
      return named("inVariable", text);
    case ElementKind::OutVariable:
      return named("outVariable", text);
    case ElementKind::InOutVariable:
      return named("inOutVariable", text);
    case ElementKind::Connector:
      return named("connector", text);
    case ElementKind::Continuation:
      return named("continuation", text);
  }
  return {};
}

Graph GraphReader::read(xml_node body) {
  graph_ = {};
  graph_.where = xml_->range(body);
  xml_->allow_attributes(body, {});
  const std::vector<xml_node> children = elements_of(body);
  const auto is_rung = [](xml_node node) { return local_name(node) == "rung"; };
  const bool rungs = std::any_of(children.begin(), children.end(), is_rung);
  for (const xml_node child : children) {
    if (xml_->errors().is_full()) break;
    if (rungs && !is_rung(child)) {
      xml_->error("RP094", child,
                  quoted_excerpt(local_name(child)) +
                      " beside `rung` elements is not supported");
    } else if (rungs) {
      read_rung(child);
    } else {
      read_element(child);
    }
  }
  link();
  return std::move(graph_);
}

void GraphReader::read_element(xml_node node) {
  const std::string_view name = local_name(node);
  if (name == "leftPowerRail") return read_rail(node, ElementKind::LeftRail);
  if (name == "rightPowerRail") return read_rail(node, ElementKind::RightRail);
  if (name == "contact") return read_relay(node, ElementKind::Contact);
  if (name == "coil") return read_relay(node, ElementKind::Coil);
  if (name == "block") return read_block(node);
  if (name == "inVariable") return read_variable(node, ElementKind::InVariable);
  if (name == "outVariable") {
    return read_variable(node, ElementKind::OutVariable);
  }
  if (name == "inOutVariable") {
    return read_variable(node, ElementKind::InOutVariable);
  }
  if (name == "connector") return read_connector(node, ElementKind::Connector);
  if (name == "continuation") {
    return read_connector(node, ElementKind::Continuation);
  }
  // Comments are read with the whole document's.
  if (name == "comment" || name == "documentation") return;
  const std::string_view reason = reason_against(name);
  xml_->error("RP094", node,
              quoted_excerpt(name) + " in a drawing is not supported" +
                  (reason.empty() ? "" : ": " + std::string(reason)));
}

std::uint32_t GraphReader::add(xml_node node, ElementKind kind) {
  const auto index = static_cast<std::uint32_t>(graph_.elements.size());
  Element element;
  element.kind = kind;
  element.where = xml_->range(node);
  element.order = number(node, "executionOrderId");
  if (const xml_node place = child_named(node, "position")) {
    element.place = point(place);
  }
  graph_.elements.push_back(std::move(element));

  const std::string_view id = xml_->attribute(node, "localId").text;
  if (id.empty()) {
    xml_->error("RP095", node,
                quoted_excerpt(local_name(node)) + " has no `localId`");
  } else if (const auto [known, fresh] = by_id_.emplace(id, index); !fresh) {
    xml_->errors().error(
        "RP095", xml_->range(node),
        "the localId " + quoted_excerpt(id) + " is that of another element",
        {{graph_.elements[known->second].where,
          shown(graph_.elements[known->second])}});
  }
  return index;
}

std::int64_t GraphReader::number(xml_node node, const char* attribute) const {
  const std::string_view text = xml_->attribute(node, attribute).text;
  if (text.empty()) return 0;
  double value = 0;
  const auto [end, error] =
      std::from_chars(text.data(), text.data() + text.size(), value);
  constexpr double kLargest = 1e9;
  if (error != std::errc{} || end != text.data() + text.size() ||
      !(value >= -kLargest && value <= kLargest)) {
    xml_->error("RP095", node,
                quoted_excerpt(text) + " is no value of `" + attribute + "`");
    return 0;
  }
  return static_cast<std::int64_t>(value);
}

Point GraphReader::point(xml_node node) const {
  return {number(node, "x"), number(node, "y")};
}

Modifier GraphReader::modifier(xml_node node) const {
  Modifier result;
  const auto value = [&](const char* name) {
    return xml_->attribute(node, name).text;
  };
  const auto wrong = [&](const char* name) {
    xml_->error("RP095", node,
                quoted_excerpt(value(name)) + " is no value of `" + name + "`");
  };
  const std::string_view negated = value("negated");
  // The second spelling is that of ESBMC's rungs.
  result.negated = negated == "true" || negated == "1" || negated == "negated";
  if (!result.negated && !negated.empty() && negated != "false" &&
      negated != "0") {
    wrong("negated");
  }
  const std::string_view edge = value("edge");
  if (edge == "rising") {
    result.edge = Edge::Rising;
  } else if (edge == "falling") {
    result.edge = Edge::Falling;
  } else if (!edge.empty() && edge != "none") {
    wrong("edge");
  }
  const std::string_view storage = value("storage");
  if (storage == "set") {
    result.storage = Storage::Set;
  } else if (storage == "reset") {
    result.storage = Storage::Reset;
  } else if (!storage.empty() && storage != "none") {
    wrong("storage");
  }
  return result;
}

/// The text of a child element that must be there.
Text GraphReader::operand(xml_node element, std::string_view child) const {
  const xml_node node = child_named(element, child);
  Text text = node ? xml_->text_of(node) : Text();
  if (text.text.empty()) {
    xml_->error("RP095", element,
                quoted_excerpt(local_name(element)) + " has no `" +
                    std::string(child) + "`");
  }
  return text;
}

void GraphReader::read_rail(xml_node node, ElementKind kind) {
  xml_->allow_attributes(
      node, {"localId", "globalId", "height", "width", "executionOrderId"});
  const std::uint32_t index = add(node, kind);
  for (const xml_node child : elements_of(node)) {
    const std::string_view name = local_name(child);
    if (name == "connectionPointIn" && kind == ElementKind::RightRail) {
      read_input(child, index, {});
    } else if (name == "connectionPointOut" && kind == ElementKind::LeftRail) {
      continue;  // every output of the rail is true
    } else if (!says_nothing(name)) {
      xml_->refuse(child);
    }
  }
}

/// A contact or a coil.
void GraphReader::read_relay(xml_node node, ElementKind kind) {
  xml_->allow_attributes(
      node, {"localId", "globalId", "height", "width", "executionOrderId",
             "negated", "edge", "storage"});
  const std::uint32_t index = add(node, kind);
  graph_.elements[index].modifier = modifier(node);
  graph_.elements[index].text = operand(node, "variable");
  for (const xml_node child : elements_of(node)) {
    const std::string_view name = local_name(child);
    if (name == "connectionPointIn") {
      read_input(child, index, {});
    } else if (name != "connectionPointOut" && name != "variable" &&
               !says_nothing(name)) {
      xml_->refuse(child);
    }
  }
}

void GraphReader::read_variable(xml_node node, ElementKind kind) {
  xml_->allow_attributes(
      node, {"localId", "globalId", "height", "width", "executionOrderId",
             "negated", "edge", "storage"});
  const std::uint32_t index = add(node, kind);
  graph_.elements[index].modifier = modifier(node);
  graph_.elements[index].text = operand(node, "expression");
  for (const xml_node child : elements_of(node)) {
    const std::string_view name = local_name(child);
    if (name == "connectionPointIn" && kind != ElementKind::InVariable) {
      read_input(child, index, {});
    } else if (name == "connectionPointOut" &&
               kind != ElementKind::OutVariable) {
      continue;
    } else if (name != "expression" && !says_nothing(name)) {
      xml_->refuse(child);
    }
  }
}

void GraphReader::read_connector(xml_node node, ElementKind kind) {
  xml_->allow_attributes(node,
                         {"localId", "globalId", "height", "width", "name"});
  const std::uint32_t index = add(node, kind);
  graph_.elements[index].text = xml_->attribute(node, "name");
  if (graph_.elements[index].text.text.empty()) {
    xml_->error("RP095", node,
                quoted_excerpt(local_name(node)) + " has no `name`");
  }
  for (const xml_node child : elements_of(node)) {
    const std::string_view name = local_name(child);
    if (name == "connectionPointIn" && kind == ElementKind::Connector) {
      read_input(child, index, {});
    } else if (!(name == "connectionPointOut" &&
                 kind == ElementKind::Continuation) &&
               !says_nothing(name)) {
      xml_->refuse(child);
    }
  }
}

void GraphReader::read_block(xml_node node) {
  xml_->allow_attributes(
      node, {"localId", "globalId", "height", "width", "executionOrderId",
             "typeName", "instanceName"});
  const std::uint32_t index = add(node, ElementKind::Block);
  Element& block = graph_.elements[index];
  block.type = xml_->attribute(node, "typeName").text;
  block.instance = xml_->attribute(node, "instanceName").text;
  if (!is_identifier(block.type)) {
    xml_->error("RP095", node,
                quoted_excerpt(block.type) + " is no name of a block's type");
  }
  if (!block.instance.empty() && !is_identifier(block.instance)) {
    xml_->error("RP095", node,
                quoted_excerpt(block.instance) + " is no name of an instance");
  }
  for (const xml_node child : elements_of(node)) {
    const std::string_view name = local_name(child);
    if (name == "inputVariables" || name == "outputVariables") {
      read_pins(child, index, name == "inputVariables");
    } else if (name == "inOutVariables") {
      for (const xml_node one : elements_of(child)) xml_->refuse(one);
    } else if (!says_nothing(name)) {
      xml_->refuse(child);
    }
  }
}

void GraphReader::read_pins(xml_node list, std::uint32_t block, bool inputs) {
  for (const xml_node node : elements_of(list)) {
    if (local_name(node) != "variable") {
      xml_->refuse(node);
      continue;
    }
    xml_->allow_attributes(
        node, {"formalParameter", "negated", "edge", "storage", "hidden"});
    Pin pin;
    pin.name = xml_->attribute(node, "formalParameter").text;
    pin.modifier = modifier(node);
    pin.where = xml_->range(node);
    if (!pin.name.empty() && !is_identifier(pin.name)) {
      xml_->error("RP095", node,
                  quoted_excerpt(pin.name) + " is no name of a pin");
    }
    xml_node point;
    for (const xml_node child : elements_of(node)) {
      const std::string_view name = local_name(child);
      if (name == (inputs ? "connectionPointIn" : "connectionPointOut")) {
        point = child;
      } else if (!says_nothing(name)) {
        xml_->refuse(child);
      }
    }
    if (graph_.elements[block].outputs.size() >= kMostPins) {
      xml_->error("RP094", node, "a block with so many outputs");
      return;
    }
    if (inputs) {
      read_input(point, block, std::move(pin));
    } else {
      if (point) pin.place = read_output(point).place;
      graph_.elements[block].outputs.push_back(std::move(pin));
    }
  }
}

Pin GraphReader::read_output(xml_node point_node) const {
  Pin pin;
  if (const xml_node place = child_named(point_node, "relPosition")) {
    pin.place = point(place);
  }
  return pin;
}

/// `point` may be null: an input without a connection.
void GraphReader::read_input(xml_node point, std::uint32_t element, Pin pin) {
  if (pin.where == SourceRange{}) {
    pin.where = point ? xml_->range(point) : graph_.elements[element].where;
  }
  const auto index =
      static_cast<std::uint32_t>(graph_.elements[element].inputs.size());
  graph_.elements[element].inputs.push_back(std::move(pin));
  if (!point) return;
  xml_->allow_attributes(point, {"globalId"});
  for (const xml_node child : elements_of(point)) {
    const std::string_view name = local_name(child);
    if (name == "connection") {
      read_connection(child, element, index);
    } else if (!says_nothing(name)) {
      xml_->refuse(child);
    }
  }
}

void GraphReader::read_connection(xml_node node, std::uint32_t element,
                                  std::uint32_t pin) {
  xml_->allow_attributes(node, {"refLocalId", "formalParameter", "globalId"});
  Reference reference;
  reference.element = element;
  reference.pin = pin;
  reference.where = xml_->range(node);
  reference.local_id = xml_->attribute(node, "refLocalId").text;
  reference.output = xml_->attribute(node, "formalParameter").text;
  for (const xml_node child : elements_of(node)) {
    if (local_name(child) != "position") {
      xml_->refuse(child);
    } else {
      reference.corners.push_back(point(child));
    }
  }
  if (reference.local_id.empty()) {
    xml_->error("RP095", node, "this `connection` has no `refLocalId`");
    return;
  }
  references_.push_back(std::move(reference));
}

/// Which output of a block a wire leaves from: by name, or else, as drawings
/// without names are read by the tools, by the wire's last corner.
bool GraphReader::find_output(const Reference& reference, Element& source,
                              std::uint32_t& output) const {
  std::vector<Pin>& outputs = source.outputs;
  const auto take = [&](auto found) {
    if (found == outputs.end()) return false;
    output = static_cast<std::uint32_t>(found - outputs.begin());
    return true;
  };
  if (!reference.output.empty()) {
    // ESBMC's files leave the pins to the declaration of the block.
    if (outputs.empty()) outputs.push_back({.name = reference.output});
    return take(std::find_if(
        outputs.begin(), outputs.end(),
        [&](const Pin& one) { return one.name == reference.output; }));
  }
  if (outputs.size() == 1) return true;
  if (reference.corners.empty()) return false;
  const Point corner = reference.corners.back();
  return take(std::find_if(outputs.begin(), outputs.end(), [&](const Pin& one) {
    return corner ==
           Point{source.place.x + one.place.x, source.place.y + one.place.y};
  }));
}

void GraphReader::link() {
  for (const Reference& reference : references_) {
    const auto found = by_id_.find(reference.local_id);
    if (found == by_id_.end()) {
      xml_->errors().error("RP096", reference.where,
                           "this wire comes from the element " +
                               quoted_excerpt(reference.local_id) +
                               ", and there is none");
      continue;
    }
    Element& source = graph_.elements[found->second];
    Wire wire{found->second, 0, reference.where};
    if (source.kind == ElementKind::RightRail ||
        source.kind == ElementKind::OutVariable ||
        source.kind == ElementKind::Connector) {
      xml_->errors().error(
          "RP096", reference.where,
          "this wire comes from " + shown(source) + ", which has no output");
      continue;
    }
    if (source.kind == ElementKind::Block &&
        !find_output(reference, source, wire.output)) {
      xml_->errors().error(
          "RP096", reference.where,
          reference.output.empty()
              ? "this wire does not say from which output of " + shown(source) +
                    " it comes"
              : shown(source) + " has no output " +
                    quoted_excerpt(reference.output));
      continue;
    }
    graph_.elements[reference.element].inputs[reference.pin].wires.push_back(
        wire);
  }
  references_.clear();
  by_id_.clear();
}

}  // namespace rung::plcopen
