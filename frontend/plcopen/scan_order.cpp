#include "frontend/plcopen/scan_order.h"

#include <algorithm>
#include <numeric>
#include <tuple>
#include <utility>

namespace rung::plcopen {
namespace {

using Indices = std::vector<std::uint32_t>;

/// Elements less than this apart are in one row, as the generator has it.
constexpr std::int64_t kRowHeight = 10;

bool is_output(const Element& element) {
  const bool connected =
      std::any_of(element.inputs.begin(), element.inputs.end(),
                  [](const Pin& pin) { return !pin.wires.empty(); });
  return element.kind == ElementKind::Coil ||
         element.kind == ElementKind::OutVariable ||
         (element.kind == ElementKind::InOutVariable && connected);
}

/// Sorts by row, then by column; equal places keep their order. "Less than ten
/// apart" is no equivalence, so rows that overlap have no order at all.
void sort_by_place(const Graph& graph, Indices& elements, ErrorLimit& errors) {
  const auto place = [&](std::uint32_t at) { return graph.elements[at].place; };
  std::stable_sort(elements.begin(), elements.end(),
                   [&](std::uint32_t a, std::uint32_t b) {
                     return place(a).y < place(b).y;
                   });
  for (auto row = elements.begin(); row != elements.end();) {
    auto end = row + 1;
    while (end != elements.end() &&
           place(*end).y - place(*(end - 1)).y < kRowHeight) {
      ++end;
    }
    if (place(*(end - 1)).y - place(*row).y >= kRowHeight) {
      const Element& first = graph.elements[*row];
      const Element& last = graph.elements[*(end - 1)];
      errors.error("RP095", first.where,
                   "the rows from " + shown(first) + " to " + shown(last) +
                       " overlap: they have no order by position",
                   {{last.where, shown(last)}});
    }
    std::sort(row, end);  // as they stand in the file
    std::stable_sort(row, end, [&](std::uint32_t a, std::uint32_t b) {
      return place(a).x < place(b).x;
    });
    row = end;
  }
}

std::vector<Network> one_by_one(const Graph& graph, bool by_place,
                                ErrorLimit& errors) {
  Indices ordered;
  Indices outputs;
  Indices blocks;
  Indices connectors;
  for (std::uint32_t at = 0; at < graph.elements.size(); ++at) {
    const Element& element = graph.elements[at];
    const bool block = element.kind == ElementKind::Block;
    const bool output = is_output(element);
    if (element.order > 0 && (block || output) &&
        element.kind != ElementKind::Coil) {
      ordered.push_back(at);
    } else if (output) {
      outputs.push_back(at);
    } else if (block) {
      blocks.push_back(at);
    } else if (element.kind == ElementKind::Connector) {
      connectors.push_back(at);
    }
  }
  std::stable_sort(ordered.begin(), ordered.end(),
                   [&](std::uint32_t a, std::uint32_t b) {
                     return graph.elements[a].order < graph.elements[b].order;
                   });
  if (by_place) {
    sort_by_place(graph, outputs, errors);
    sort_by_place(graph, blocks, errors);
  }
  std::vector<Network> networks;
  for (const Indices* const part : {&ordered, &outputs, &blocks, &connectors}) {
    for (const std::uint32_t at : *part) networks.push_back({at});
  }
  return networks;
}

/// Elements that wires join, directly or not. Power rails join nothing.
class Joined {
 public:
  explicit Joined(const Graph& graph) : root_(graph.elements.size()) {
    std::iota(root_.begin(), root_.end(), 0U);
    for (std::uint32_t at = 0; at < root_.size(); ++at) {
      const Element& element = graph.elements[at];
      if (element.kind == ElementKind::RightRail) continue;
      if (element.kind == ElementKind::Continuation) {
        join(at, element.connector);
      }
      for (const Pin& pin : element.inputs) {
        for (const Wire& wire : pin.wires) {
          if (graph.source_of(wire).kind != ElementKind::LeftRail) {
            join(at, wire.source);
          }
        }
      }
    }
  }

  std::uint32_t root(std::uint32_t at) {
    while (root_[at] != at) {
      root_[at] = root_[root_[at]];
      at = root_[at];
    }
    return at;
  }

 private:
  void join(std::uint32_t a, std::uint32_t b) {
    a = root(a);
    b = root(b);
    root_[std::max(a, b)] = std::min(a, b);
  }

  Indices root_;
};

std::vector<Network> by_network(const Graph& graph, ErrorLimit& errors) {
  Indices sinks;
  for (std::uint32_t at = 0; at < graph.elements.size(); ++at) {
    const Element& element = graph.elements[at];
    if (is_output(element) || element.kind == ElementKind::Block) {
      sinks.push_back(at);
    }
  }
  sort_by_place(graph, sinks, errors);
  Joined joined(graph);
  std::vector<Network> networks;
  std::vector<std::size_t> number(graph.elements.size(), 0);
  for (const std::uint32_t at : sinks) {
    std::size_t& known = number[joined.root(at)];
    if (known == 0) {
      networks.emplace_back();
      known = networks.size();
    }
    networks[known - 1].push_back(at);
  }
  return networks;
}

}  // namespace

std::vector<Network> scan_order(const Graph& graph, CoilOrder order,
                                ErrorLimit& errors) {
  if (order == CoilOrder::Snapshot) return by_network(graph, errors);
  return one_by_one(graph, order == CoilOrder::Position, errors);
}

}  // namespace rung::plcopen
