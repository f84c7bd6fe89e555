#include <algorithm>
#include <utility>

#include "frontend/iec/token.h"
#include "frontend/plcopen/drawing.h"
#include "frontend/st/expression_parser.h"
#include "frontend/token_list.h"

namespace rung::plcopen {
namespace {

using iec::Value;

/// Larger expressions are kept in a bit, so that none is copied often.
constexpr std::size_t kLargestExpression = 64;

}  // namespace

std::optional<Value> DrawingRun::value_of(const Pin& pin, Index flow) {
  Uses uses;
  std::vector<Node> order;
  for (const Wire& wire : pin.wires) collect(resolve(wire, flow), uses, order);
  for (const Node& node : order) {
    if (!scope_->step(graph_->elements[node.element].where)) {
      return std::nullopt;
    }
    Use& use = uses.at(node);
    use.value = compute(node, uses);
    if (!use.value) continue;
    if (use.count > 1 || use.value->nodes.size() > kLargestExpression) {
      use.value = scope_->once(std::move(*use.value),
                               graph_->elements[node.element].where, "wire");
    }
  }
  return join(pin.wires, flow, uses, pin.where);
}

/// What a wire comes from, past coils and connectors that only pass one on.
DrawingRun::Node DrawingRun::resolve(const Wire& wire, Index flow) {
  Wire at = wire;
  while (scope_->step(wire.where)) {
    const Element& element = graph_->elements[at.source];
    Index owner = at.source;
    if (element.kind == ElementKind::Continuation) {
      owner = element.connector;
      flow = connector_flows_.at(owner);
    } else if (element.kind != ElementKind::Coil) {
      return {at.source, at.output, flow};
    }
    const std::vector<Wire>& wires =
        graph_->elements[owner].inputs.front().wires;
    if (wires.size() != 1) return {owner, 0, flow};
    at = wires.front();
  }
  return {at.source, at.output, flow};  // too large: an error was said
}

const std::vector<Wire>& DrawingRun::wires_of(const Node& node) const {
  static const std::vector<Wire> none;
  const Element& element = graph_->elements[node.element];
  const bool passes = element.kind == ElementKind::Contact ||
                      element.kind == ElementKind::Coil ||
                      element.kind == ElementKind::Connector;
  return passes ? element.inputs.front().wires : none;
}

/// The nodes below `root`, each once, what it needs before it.
void DrawingRun::collect(const Node& root, Uses& uses,
                         std::vector<Node>& order) {
  struct Place {
    Node node;
    std::size_t wire = 0;
  };
  if (++uses[root].count > 1) return;
  std::vector<Place> path = {{root}};
  while (!path.empty()) {
    Place& place = path.back();
    const std::vector<Wire>& wires = wires_of(place.node);
    if (place.wire == wires.size()) {
      order.push_back(place.node);
      path.pop_back();
      continue;
    }
    const Node next = resolve(wires[place.wire++], place.node.flow);
    if (++uses[next].count == 1) path.push_back({next});
  }
}

/// The value of a node that was computed: moved out where it is the last use.
std::optional<Value> DrawingRun::take(const Node& node, Uses& uses) {
  Use& use = uses.at(node);
  if (!use.value) return std::nullopt;
  if (use.count > 1) return use.value;
  return std::move(use.value);
}

std::optional<Value> DrawingRun::compute(const Node& node, Uses& uses) {
  const Element& element = graph_->elements[node.element];
  switch (element.kind) {
    case ElementKind::LeftRail:
      return scope_->bit(true, element.where);
    case ElementKind::Contact: {
      const auto edge =
          flows_[node.flow].edges.find(std::uint64_t{node.element} << 32);
      auto own = edge != flows_[node.flow].edges.end()
                     ? std::optional(edge->second)
                     : contact_value(element);
      auto power = as_bit(join(wires_of(node), node.flow, uses, element.where),
                          element.where);
      if (!own || !power) return std::nullopt;
      if (power->constant && *power->constant != 0) return own;
      return scope_->binary(iec::Operator::And, std::move(*power),
                            std::move(*own), element.where);
    }
    case ElementKind::Coil:
    case ElementKind::Connector:
      return join(wires_of(node), node.flow, uses, element.where);
    case ElementKind::Block: {
      const auto edge = flows_[node.flow].edges.find(
          (std::uint64_t{node.element} << 32) + node.output + 1);
      if (edge != flows_[node.flow].edges.end()) return edge->second;
      auto value = output_value(node.element, node.output);
      const Pin& pin = element.outputs[node.output];
      if (value && pin.modifier.negated) {
        return scope_->invert(std::move(*value), pin.where);
      }
      return value;
    }
    case ElementKind::InVariable:
    case ElementKind::InOutVariable: {
      auto value = operand(element.text);
      if (value && element.modifier.negated) {
        return scope_->invert(std::move(*value), element.where);
      }
      return value;
    }
    case ElementKind::RightRail:
    case ElementKind::OutVariable:
    case ElementKind::Continuation:
      break;
  }
  return std::nullopt;  // no wire comes from these
}

/// Several wires are an OR. One that comes from the rail is always true.
std::optional<Value> DrawingRun::join(const std::vector<Wire>& wires,
                                      Index flow, Uses& uses,
                                      SourceRange where) {
  if (wires.size() == 1) return take(resolve(wires.front(), flow), uses);
  std::optional<Value> all;
  for (const Wire& wire : wires) {
    auto value = as_bit(take(resolve(wire, flow), uses), wire.where);
    if (!value) return std::nullopt;
    all = all ? scope_->binary(iec::Operator::Or, std::move(*all),
                               std::move(*value), where)
              : std::move(value);
    if (!all) return std::nullopt;
  }
  return all;
}

std::optional<Value> DrawingRun::contact_value(const Element& contact) {
  auto value = as_bit(operand(contact.text), contact.where);
  if (value && contact.modifier.negated) {
    return scope_->invert(std::move(*value), contact.where);
  }
  return value;
}

std::optional<Value> DrawingRun::output_value(Index index, Index output) {
  const Element& block = graph_->elements[index];
  const std::string_view name =
      output < block.outputs.size() ? block.outputs[output].name : "";
  if (!block.instance.empty()) {
    iec::Symbol* const instance = scope_->get(block.instance, block.where);
    iec::Symbol* const pin = instance == nullptr
                                 ? nullptr
                                 : scope_->member(*instance, name, block.where);
    return pin == nullptr ? std::nullopt : scope_->read(*pin, block.where);
  }
  const bool enable = iec::upper(name) == "ENO";
  const auto& known = enable ? enables_ : results_;
  const auto found = known.find(index);
  if (found != known.end()) return found->second;
  if (enable) return scope_->bit(true, block.where);  // EN is not connected
  scope_->fail("RP096", block.where,
               "what " + shown(block) + " gives is used before it is executed");
  return std::nullopt;
}

std::optional<Value> DrawingRun::as_bit(std::optional<Value> value,
                                        SourceRange where) {
  if (!value) return std::nullopt;
  return scope_->convert(std::move(*value), iec::kBool, where);
}

/// An expression of structured text at a contact or an inVariable: mostly a
/// variable or a literal.
std::optional<Value> DrawingRun::operand(const Text& text) {
  // The file up to here: so the tokens have their places.
  const std::string_view file(text.text.data() - text.where.begin,
                              text.where.end);
  const iec::TokenList list =
      iec::tokenize(file, text.where.file, text.where.begin);
  iec::Cursor cursor(list);
  cursor.skip_line_ends();
  auto value = st::ExpressionParser(cursor, *scope_).expression();
  cursor.skip_line_ends();
  if (!value || cursor.at(iec::TokenKind::End)) return value;
  scope_->fail("RP095", text.where,
               quoted_excerpt(text.text) + " is no expression");
  return std::nullopt;
}

}  // namespace rung::plcopen
