#include "frontend/plcopen/drawing.h"

#include <utility>

#include "frontend/iec/token.h"
#include "frontend/token_list.h"

namespace rung::plcopen {
namespace {

using iec::Value;

std::uint64_t key_of(std::uint32_t element, std::uint32_t pin) {
  return std::uint64_t{element} << 32 | pin;
}

int count_of(const Modifier& modifier) {
  return (modifier.negated ? 1 : 0) + (modifier.edge != Edge::None ? 1 : 0) +
         (modifier.storage != Storage::None ? 1 : 0);
}

void check_modifier(const Modifier& modifier, const Element& element,
                    SourceRange where, bool as_generator, ErrorLimit& errors) {
  const ElementKind kind = element.kind;
  const bool variable = kind == ElementKind::InVariable ||
                        kind == ElementKind::OutVariable ||
                        kind == ElementKind::InOutVariable;
  std::string wrong;
  if (modifier.storage != Storage::None && kind != ElementKind::Coil) {
    wrong = "only coils have a `storage`";
  } else if (variable && modifier.edge != Edge::None) {
    wrong = "an `edge` at a variable";
  } else if (variable && modifier.negated && as_generator) {
    wrong = "the tool ignores `negated` at a variable";
  } else if (count_of(modifier) > 1 && !as_generator) {
    wrong = "`negated`, `edge` and `storage` together";
  }
  if (wrong.empty()) return;
  errors.error("RP094", where, shown(element) + " is not supported: " + wrong);
}

}  // namespace

Modifier effective(Modifier modifier, bool as_generator) {
  if (!as_generator) return modifier;
  if (modifier.negated) return {.negated = true};
  if (modifier.storage != Storage::None) modifier.edge = Edge::None;
  return modifier;
}

Drawing make_drawing(Graph graph, const Semantics& semantics,
                     ErrorLimit& errors) {
  Drawing drawing;
  drawing.as_generator = semantics.order != CoilOrder::Snapshot;
  check_graph(graph, errors);
  for (const Element& element : graph.elements) {
    check_modifier(element.modifier, element, element.where,
                   drawing.as_generator, errors);
    for (const Pin& pin : element.inputs) {
      check_modifier(pin.modifier, element, pin.where, drawing.as_generator,
                     errors);
    }
    for (const Pin& pin : element.outputs) {
      check_modifier(pin.modifier, element, pin.where, drawing.as_generator,
                     errors);
    }
  }
  drawing.networks = scan_order(graph, semantics.order, errors);
  drawing.graph = std::move(graph);
  return drawing;
}

void DrawingRun::run() {
  for (const Network& network : drawing_->networks) {
    if (scope_->errors().is_full()) return;
    run_network(network);
  }
}

void DrawingRun::run_network(const Network& network) {
  const Index flow = new_flow();
  for (const Index sink : network) prepare(sink, flow);
  std::vector<std::pair<Index, Value>> values;
  for (const Index sink : network) {
    const Element& element = graph_->elements[sink];
    if (element.kind == ElementKind::Block ||
        element.kind == ElementKind::Connector) {
      continue;
    }
    std::optional<Value> value = value_of(element.inputs.front(), flow);
    if (!value) continue;
    if (network.size() > 1) {
      value = kept(std::move(*value), element.where);
    }
    values.emplace_back(sink, std::move(*value));
  }
  for (auto& [sink, value] : values) write(sink, std::move(value));
  flows_[flow] = {};
}

DrawingRun::Index DrawingRun::new_flow() {
  flows_.emplace_back();
  return static_cast<Index>(flows_.size() - 1);
}

DrawingRun::Index DrawingRun::connector_flow(Index connector) {
  const auto known = connector_flows_.find(connector);
  if (known != connector_flows_.end()) return known->second;
  const Index flow = new_flow();
  connector_flows_.emplace(connector, flow);
  return flow;
}

/// Executes everything that has a state on the way to a sink.
void DrawingRun::prepare(Index sink, Index flow) {
  const Element& element = graph_->elements[sink];
  if (element.kind == ElementKind::Block) {
    visit_block({.element = sink, .flow = flow});
  } else if (element.kind == ElementKind::Connector) {
    visit_connector(sink, false);
  } else {
    push_inputs(sink, flow, false);
  }
  while (!tasks_.empty()) {
    const Task task = tasks_.back();
    tasks_.pop_back();
    if (!scope_->step(graph_->elements[task.element].where)) tasks_.clear();
    switch (task.kind) {
      case Task::Kind::Visit:
        visit(task);
        break;
      case Task::Kind::Call:
        call(task.element);
        break;
      case Task::Kind::OutputEdge:
        output_edge(task);
        break;
      case Task::Kind::InputEdge:
        input_edge(task);
        break;
    }
  }
}

/// The first wire is to be passed first, so it is pushed last.
void DrawingRun::push_wires(const Pin& pin, Index flow, bool ordered) {
  for (auto wire = pin.wires.rbegin(); wire != pin.wires.rend(); ++wire) {
    tasks_.push_back(
        {Task::Kind::Visit, wire->source, wire->output, flow, ordered});
  }
}

void DrawingRun::push_inputs(Index element, Index flow, bool ordered) {
  const std::vector<Pin>& pins = graph_->elements[element].inputs;
  for (auto pin = pins.rbegin(); pin != pins.rend(); ++pin) {
    push_wires(*pin, flow, ordered);
  }
}

void DrawingRun::visit(const Task& task) {
  const Element& element = graph_->elements[task.element];
  switch (element.kind) {
    case ElementKind::Contact:
      visit_contact(task);
      break;
    case ElementKind::Coil:
      if (flows_[task.flow].visited.insert(task.element).second) {
        push_inputs(task.element, task.flow, task.ordered);
      }
      break;
    case ElementKind::Continuation:
      visit_connector(element.connector, task.ordered);
      break;
    case ElementKind::Block:
      visit_block(task);
      break;
    case ElementKind::LeftRail:
    case ElementKind::RightRail:
    case ElementKind::InVariable:
    case ElementKind::OutVariable:
    case ElementKind::InOutVariable:
    case ElementKind::Connector:
      break;
  }
}

void DrawingRun::visit_contact(const Task& task) {
  Flow& flow = flows_[task.flow];
  if (!flow.visited.insert(task.element).second) return;
  const Element& contact = graph_->elements[task.element];
  const Modifier modifier = effective(contact.modifier, drawing_->as_generator);
  if (modifier.edge != Edge::None) {
    auto value =
        edge(modifier.edge, as_bit(operand(contact.text), contact.where),
             contact.where);
    if (value) flow.edges.emplace(key_of(task.element, 0), std::move(*value));
  }
  push_inputs(task.element, task.flow, task.ordered);
}

void DrawingRun::visit_connector(Index connector, bool ordered) {
  const Index flow = connector_flow(connector);
  if (flows_[flow].visited.insert(connector).second) {
    push_inputs(connector, flow, ordered);
  }
}

void DrawingRun::visit_block(const Task& task) {
  const Element& block = graph_->elements[task.element];
  if (task.pin < block.outputs.size() &&
      effective(block.outputs[task.pin].modifier, drawing_->as_generator)
              .edge != Edge::None) {
    tasks_.push_back({Task::Kind::OutputEdge, task.element, task.pin, task.flow,
                      task.ordered});
  }
  if (task.ordered || !called_.insert(task.element).second) return;
  tasks_.push_back({Task::Kind::Call, task.element});
  std::vector<Index> flows(block.inputs.size(), task.flow);
  if (drawing_->as_generator) {
    for (Index& flow : flows) flow = new_flow();
  }
  for (auto pin = static_cast<Index>(flows.size()); pin-- > 0;) {
    if (effective(block.inputs[pin].modifier, drawing_->as_generator).edge !=
        Edge::None) {
      tasks_.push_back({Task::Kind::InputEdge, task.element, pin, flows[pin]});
    }
    push_wires(block.inputs[pin], flows[pin], block.order > 0);
  }
  pin_flows_.emplace(task.element, std::move(flows));
}

std::optional<Value> DrawingRun::edge(Edge edge, std::optional<Value> clk,
                                      SourceRange where) {
  if (!clk) return std::nullopt;
  return scope_->edge(edge == Edge::Rising, std::move(*clk),
                      std::to_string(++edges_), where);
}

void DrawingRun::output_edge(const Task& task) {
  Flow& flow = flows_[task.flow];
  const std::uint64_t key = key_of(task.element, task.pin + 1);
  if (flow.edges.contains(key)) return;
  const Pin& pin = graph_->elements[task.element].outputs[task.pin];
  auto value =
      edge(pin.modifier.edge,
           as_bit(output_value(task.element, task.pin), pin.where), pin.where);
  if (value) flow.edges.emplace(key, std::move(*value));
}

void DrawingRun::input_edge(const Task& task) {
  const Pin& pin = graph_->elements[task.element].inputs[task.pin];
  if (pin.wires.empty()) return;
  auto value = edge(pin.modifier.edge,
                    as_bit(value_of(pin, task.flow), pin.where), pin.where);
  if (value) {
    input_edges_.insert_or_assign(key_of(task.element, task.pin),
                                  std::move(*value));
  }
}

/// What an input of a block is given.
std::optional<Value> DrawingRun::argument(Index block, Index pin_index) {
  const Pin& pin = graph_->elements[block].inputs[pin_index];
  const Modifier modifier = effective(pin.modifier, drawing_->as_generator);
  if (modifier.edge != Edge::None) {
    const auto known = input_edges_.find(key_of(block, pin_index));
    return known == input_edges_.end() ? std::nullopt
                                       : std::optional(known->second);
  }
  auto value = value_of(pin, pin_flows_.at(block)[pin_index]);
  if (value && modifier.negated) {
    value = scope_->invert(std::move(*value), pin.where);
  }
  return value;
}

void DrawingRun::call(Index index) {
  const Element& block = graph_->elements[index];
  std::vector<iec::Argument> arguments;
  for (Index pin = 0; pin < block.inputs.size(); ++pin) {
    if (block.inputs[pin].wires.empty()) continue;
    auto value = argument(index, pin);
    if (!value) return;  // an error was said
    iec::Argument one;
    one.name = iec::upper(block.inputs[pin].name);
    one.where = block.inputs[pin].where;
    one.value = std::move(*value);
    arguments.push_back(std::move(one));
  }
  for (const Index flow : pin_flows_.at(index)) {
    if (drawing_->as_generator) flows_[flow] = {};
  }
  if (block.instance.empty()) {
    call_function(index, std::move(arguments));
  } else {
    call_instance(block, std::move(arguments));
  }
}

void DrawingRun::call_instance(const Element& block,
                               std::vector<iec::Argument> arguments) {
  iec::Symbol* const instance = scope_->get(block.instance, block.where);
  if (instance == nullptr) return;
  scope_->call(*instance, std::move(arguments), block.where);
}

/// A function's value is kept: the drawing may use it further down.
void DrawingRun::call_function(Index index,
                               std::vector<iec::Argument> arguments) {
  const Element& block = graph_->elements[index];
  for (std::size_t at = 0; at < arguments.size(); ++at) {
    if (arguments[at].name != "EN") continue;
    arguments[at].value = kept(std::move(arguments[at].value), block.where);
    enables_.insert_or_assign(index, arguments[at].value);
  }
  auto value = scope_->function(block.type, std::move(arguments), block.where);
  if (!value) return;
  results_.insert_or_assign(index, kept(std::move(*value), block.where));
}

Value DrawingRun::kept(Value value, SourceRange where) {
  if (value.constant) return value;
  const std::string_view cell =
      scope_->writer().keep("wire", value.type->shape(), value.nodes, where);
  Value result{.type = value.type, .where = where};
  push_leaf(result.nodes, AstOp::Name, cell, where);
  return result;
}

}  // namespace rung::plcopen
