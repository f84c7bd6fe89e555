#include <algorithm>
#include <cstddef>
#include <unordered_map>
#include <utility>

#include "frontend/plcopen/graph.h"
#include "frontend/token_list.h"

namespace rung::plcopen {
namespace {

bool needs_power(ElementKind kind) {
  return kind == ElementKind::Contact || kind == ElementKind::Coil ||
         kind == ElementKind::OutVariable || kind == ElementKind::Connector;
}

bool is_connected(const Element& element) {
  return std::any_of(element.inputs.begin(), element.inputs.end(),
                     [](const Pin& pin) { return !pin.wires.empty(); });
}

bool writes(const Element& element) {
  return element.kind == ElementKind::Coil ||
         element.kind == ElementKind::OutVariable ||
         element.kind == ElementKind::Block ||
         (element.kind == ElementKind::InOutVariable && is_connected(element));
}

void find_connectors(Graph& graph, ErrorLimit& errors) {
  std::unordered_map<std::string_view, std::uint32_t> connectors;
  for (std::uint32_t at = 0; at < graph.elements.size(); ++at) {
    const Element& element = graph.elements[at];
    if (element.kind != ElementKind::Connector) continue;
    const auto [known, fresh] = connectors.emplace(element.text.text, at);
    if (fresh) continue;
    errors.error(
        "RP096", element.where,
        "there is another connector " + quoted_excerpt(element.text.text),
        {{graph.elements[known->second].where, "the other one"}});
  }
  for (Element& element : graph.elements) {
    if (element.kind != ElementKind::Continuation) continue;
    const auto found = connectors.find(element.text.text);
    if (found == connectors.end()) {
      errors.error(
          "RP096", element.where,
          "there is no connector " + quoted_excerpt(element.text.text));
    } else {
      element.connector = found->second;
    }
  }
}

/// A depth-first search for wires that lead back to where they come from.
class CircleFinder {
 public:
  CircleFinder(const Graph& graph, ErrorLimit& errors)
      : graph_(&graph),
        errors_(&errors),
        state_(graph.elements.size(), State::New) {}

  void find() {
    for (std::uint32_t at = 0; at < state_.size(); ++at) {
      if (state_[at] != State::New) continue;
      open(at);
      while (!path_.empty()) step();
    }
  }

 private:
  enum class State : std::uint8_t { New, Open, Done };
  struct Place {
    std::uint32_t element = 0;
    std::size_t pin = 0;
    std::size_t wire = 0;
  };

  void open(std::uint32_t element) {
    state_[element] = State::Open;
    path_.push_back({element});
  }

  void step() {
    Place& place = path_.back();
    const Element& element = graph_->driver(place.element);
    if (place.pin == element.inputs.size()) {
      state_[place.element] = State::Done;
      path_.pop_back();
      return;
    }
    const Pin& pin = element.inputs[place.pin];
    if (place.wire == pin.wires.size()) {
      ++place.pin;
      place.wire = 0;
      return;
    }
    const std::uint32_t source = pin.wires[place.wire++].source;
    if (state_[source] == State::New) {
      open(source);
    } else if (state_[source] == State::Open) {
      report(source);
    }
  }

  void report(std::uint32_t first) {
    if (errors_->is_full()) return;
    constexpr int kShown = 8;
    const auto begin = std::find_if(
        path_.begin(), path_.end(),
        [&](const Place& place) { return place.element == first; });
    std::string names;
    int count = 0;
    for (auto at = path_.end(); at != begin && count < kShown; ++count) {
      --at;
      names +=
          (names.empty() ? "" : ", ") + shown(graph_->elements[at->element]);
    }
    if (path_.end() - begin > kShown) names += ", ...";
    errors_->error("RP097", graph_->elements[first].where,
                   "wires lead in a circle: " + names +
                       "; a value of the last scan is read by a contact");
  }

  const Graph* graph_;
  ErrorLimit* errors_;
  std::vector<State> state_;
  std::vector<Place> path_;
};

/// Which elements some sink depends on, the sinks too.
std::vector<bool> used_elements(const Graph& graph) {
  std::vector<bool> used(graph.elements.size(), false);
  std::vector<std::uint32_t> open;
  const auto reach = [&](std::uint32_t at) {
    if (!used[at]) open.push_back(at);
    used[at] = true;
  };
  for (std::uint32_t at = 0; at < used.size(); ++at) {
    if (writes(graph.elements[at])) reach(at);
  }
  while (!open.empty()) {
    const Element& element = graph.driver(open.back());
    open.pop_back();
    for (const Pin& pin : element.inputs) {
      for (const Wire& wire : pin.wires) reach(wire.source);
    }
  }
  return used;
}

/// Power must come from somewhere. A contact that drives nothing has no effect,
/// connected or not; the tools leave such pieces in their files.
void check_power(const Graph& graph, ErrorLimit& errors) {
  const std::vector<bool> used = used_elements(graph);
  for (std::size_t at = 0; at < used.size(); ++at) {
    const Element& element = graph.elements[at];
    if (!needs_power(element.kind)) continue;
    if (element.inputs.size() > 1) {
      errors.error("RP096", element.where,
                   shown(element) + " has two `connectionPointIn`");
    } else if (!is_connected(element)) {
      const bool loose = !used[at] && element.kind == ElementKind::Contact;
      errors.report({.code = "RP096",
                     .severity = loose ? Severity::Warning : Severity::Error,
                     .where = element.where,
                     .message = shown(element) +
                                " is not connected to anything" +
                                (loose ? ": it has no effect" : "")});
    }
  }
}

}  // namespace

void check_graph(Graph& graph, ErrorLimit& errors) {
  find_connectors(graph, errors);
  check_power(graph, errors);
  if (std::none_of(graph.elements.begin(), graph.elements.end(), writes)) {
    errors.error("RP098", graph.where,
                 "this drawing writes nothing: it has neither a coil nor an "
                 "outVariable nor a block");
  }
  CircleFinder(graph, errors).find();
}

}  // namespace rung::plcopen
