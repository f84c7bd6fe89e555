#include <algorithm>
#include <utility>

#include "frontend/iec/token.h"
#include "frontend/plcopen/drawing.h"

namespace rung::plcopen {

using iec::Value;

void DrawingRun::write(Index sink, Value value) {
  const Element& element = graph_->elements[sink];
  if (element.kind == ElementKind::Coil) {
    write_coil(element, std::move(value));
  } else {
    write_variable(element, std::move(value));
  }
}

void DrawingRun::write_coil(const Element& coil, Value value) {
  std::optional<Value> power = as_bit(std::move(value), coil.where);
  const Modifier modifier = effective(coil.modifier, drawing_->as_generator);
  if (power && modifier.negated) {
    power = scope_->invert(std::move(*power), coil.where);
  } else if (modifier.edge != Edge::None) {
    power = edge(modifier.edge, std::move(power), coil.where);
  }
  if (!power) return;
  const Text& target = coil.text;
  if (modifier.storage == Storage::None) {
    scope_->write(target.text, std::move(*power), target.where, coil.where);
    return;
  }
  const bool set = modifier.storage == Storage::Set;
  const iec::Context outer = scope_->enter(*power, coil.where);
  scope_->write(target.text, scope_->bit(set, coil.where), target.where,
                coil.where);
  scope_->leave(outer, coil.where);
}

/// What comes out of a block that has an EN is taken only where it was
/// executed.
void DrawingRun::write_variable(const Element& variable, Value value) {
  const Text& target = variable.text;
  if (variable.modifier.negated) {
    std::optional<Value> inverted =
        scope_->invert(std::move(value), variable.where);
    if (!inverted) return;
    value = std::move(*inverted);
  }
  const std::vector<Wire>& wires = variable.inputs.front().wires;
  const std::optional<Value> enable =
      wires.size() == 1 ? enable_of(wires.front().source) : std::nullopt;
  if (!enable) {
    scope_->write(target.text, std::move(value), target.where, variable.where);
    return;
  }
  const iec::Context outer = scope_->enter(*enable, variable.where);
  scope_->write(target.text, std::move(value), target.where, variable.where);
  scope_->leave(outer, variable.where);
}

/// ENO of a block whose EN is connected; nothing for any other element.
std::optional<Value> DrawingRun::enable_of(Index index) {
  const Element& block = graph_->elements[index];
  const bool has_enable =
      std::any_of(block.inputs.begin(), block.inputs.end(), [](const Pin& pin) {
        return iec::upper(pin.name) == "EN" && !pin.wires.empty();
      });
  if (!has_enable) return std::nullopt;
  if (block.instance.empty()) {
    const auto known = enables_.find(index);
    return known == enables_.end() ? std::nullopt
                                   : std::optional(known->second);
  }
  iec::Symbol* const instance = scope_->get(block.instance, block.where);
  iec::Symbol* const pin = instance == nullptr
                               ? nullptr
                               : scope_->member(*instance, "ENO", block.where);
  return pin == nullptr ? std::nullopt : scope_->read(*pin, block.where);
}

}  // namespace rung::plcopen
