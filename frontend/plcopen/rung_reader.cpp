// The `rung` elements that ESBMC reads in the place of a drawing: no wires, but
// contacts in series and the coils that they drive.

#include <algorithm>
#include <array>
#include <utility>

#include "frontend/plcopen/graph_reader.h"
#include "frontend/token_list.h"

namespace rung::plcopen {
namespace {

using pugi::xml_node;

constexpr std::uint32_t kRail = 0;

bool is_output_name(std::string_view name) {
  constexpr std::array<std::string_view, 6> kNames = {"Q",   "ET", "CV",
                                                      "OUT", "QU", "QD"};
  return std::find(kNames.begin(), kNames.end(), name) != kNames.end();
}

/// Blocks that are functions: what they are called is of no consequence.
bool is_function_name(std::string_view name) {
  constexpr std::array<std::string_view, 5> kNames = {"ADD", "SUB", "MUL",
                                                      "DIV", "MOVE"};
  return std::find(kNames.begin(), kNames.end(), name) != kNames.end();
}

}  // namespace

void GraphReader::read_rung(xml_node rung) {
  xml_->allow_attributes(rung, {"localId", "lineNumber", "comment"});
  if (graph_.elements.empty()) {
    graph_.elements.emplace_back();
    graph_.elements[kRail].where = xml_->range(rung);
  }
  ++rungs_;
  std::uint32_t power = kRail;
  bool coils = false;
  bool blocks = false;
  for (const xml_node child : elements_of(rung)) {
    const std::string_view name = local_name(child);
    const bool contact = name == "contact";
    if (name == "block" && !coils && power == kRail) {
      read_rung_block(child);
      blocks = true;
    } else if (contact && !coils && !blocks) {
      read_rung_relay(child, ElementKind::Contact, power);
    } else if (name == "coil" && !blocks) {
      read_rung_relay(child, ElementKind::Coil, power);
      coils = true;
    } else if (contact || name == "coil" || name == "block") {
      xml_->error("RP094", child,
                  "a `rung` has contacts and then coils, or blocks alone");
    } else {
      xml_->refuse(child);
    }
  }
  if (!coils && !blocks) {
    xml_->error("RP098", rung, "this rung writes nothing");
  }
}

void GraphReader::read_rung_relay(xml_node node, ElementKind kind,
                                  std::uint32_t& power) {
  xml_->allow_attributes(node,
                         {"variable", "negated", "edge", "kind", "lineNumber"});
  for (const xml_node child : elements_of(node)) xml_->refuse(child);
  Element element;
  element.kind = kind;
  element.where = xml_->range(node);
  element.place = {0, rungs_ * 100};
  element.modifier = modifier(node);
  element.text = xml_->attribute(node, "variable");
  if (element.text.text.empty()) {
    xml_->error("RP095", node,
                quoted_excerpt(local_name(node)) + " has no `variable`");
  }
  const std::string_view storage = xml_->attribute(node, "kind").text;
  if (storage == "set" && kind == ElementKind::Coil) {
    element.modifier.storage = Storage::Set;
  } else if (storage == "reset" && kind == ElementKind::Coil) {
    element.modifier.storage = Storage::Reset;
  } else if (!storage.empty()) {
    xml_->error("RP095", node, quoted_excerpt(storage) + " is no `kind`");
  }
  Pin pin{.where = element.where};
  pin.wires.push_back({power, 0, element.where});
  element.inputs.push_back(std::move(pin));
  graph_.elements.push_back(std::move(element));
  if (kind == ElementKind::Contact) {
    power = static_cast<std::uint32_t>(graph_.elements.size() - 1);
  }
}

void GraphReader::read_rung_block(xml_node node) {
  xml_->allow_attributes(node, {"typeName", "instanceName", "lineNumber"});
  const auto index = static_cast<std::uint32_t>(graph_.elements.size());
  Element block;
  block.kind = ElementKind::Block;
  block.where = xml_->range(node);
  block.place = {0, rungs_ * 100};
  block.type = xml_->attribute(node, "typeName").text;
  if (!is_function_name(block.type)) {
    block.instance = xml_->attribute(node, "instanceName").text;
  }
  if (!is_identifier(block.type) ||
      (!block.instance.empty() && !is_identifier(block.instance))) {
    xml_->error("RP095", node, "this block has no name that can be one");
  }
  graph_.elements.push_back(std::move(block));
  for (const xml_node child : elements_of(node)) {
    if (local_name(child) == "variable") {
      read_rung_pin(child, index);
    } else {
      xml_->refuse(child);
    }
  }
}

/// `<variable formalParameter="IN">Run</variable>`: a variable at a pin.
void GraphReader::read_rung_pin(xml_node node, std::uint32_t block) {
  xml_->allow_attributes(node, {"formalParameter"});
  Pin pin;
  pin.name = xml_->attribute(node, "formalParameter").text;
  pin.where = xml_->range(node);
  if (!is_identifier(pin.name)) {
    xml_->error("RP095", node,
                quoted_excerpt(pin.name) + " is no name of a pin");
  }
  const auto variable = static_cast<std::uint32_t>(graph_.elements.size());
  Element element;
  element.where = pin.where;
  element.place = graph_.elements[block].place;
  element.text = xml_->text_of(node);
  if (element.text.text.empty()) {
    xml_->error("RP095", node, "there is no variable at this pin");
  }
  if (is_output_name(pin.name)) {
    element.kind = ElementKind::OutVariable;
    const auto output =
        static_cast<std::uint32_t>(graph_.elements[block].outputs.size());
    element.inputs.push_back({.where = pin.where});
    element.inputs.back().wires.push_back({block, output, pin.where});
    graph_.elements[block].outputs.push_back(std::move(pin));
  } else {
    element.kind = ElementKind::InVariable;
    pin.wires.push_back({variable, 0, pin.where});
    graph_.elements[block].inputs.push_back(std::move(pin));
  }
  graph_.elements.push_back(std::move(element));
}

}  // namespace rung::plcopen
