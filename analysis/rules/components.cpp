#include "analysis/rules/components.h"

#include <algorithm>

namespace rung {
namespace {

/// Cells first, then the instances of elements.
Grouped dependencies(const Program& program) {
  const auto cells = static_cast<std::uint32_t>(program.cells.size());
  std::vector<Grouped::Pair> edges;
  for (const Rung& rung : program.rungs) {
    const std::uint32_t target = rung.target.index();
    // One element's inputs are those that stand before its call; to stay linear
    // all elements of a rung hang together in a chain.
    std::uint32_t owner = target;
    for (std::uint32_t i = rung.end; i-- > rung.begin;) {
      const Node& node = program.nodes[i];
      if (node.op == NodeOp::Read) {
        edges.emplace_back(owner, node.cell.index());
      } else if (node.op == NodeOp::Call) {
        const std::uint32_t element =
            cells + program.calls[node.call].instance.index();
        edges.emplace_back(owner, element);
        owner = element;
      }
    }
  }
  return {cells + program.instances.size(), edges};
}

class Search {
 public:
  explicit Search(const Grouped& graph, std::size_t size)
      : graph_(graph),
        order_(size, 0),
        lowest_(size, 0),
        next_(size, 0),
        on_stack_(size),
        component_(size, 0) {}

  std::vector<std::uint32_t> run() {
    for (std::uint32_t i = 0; i < order_.size(); ++i) {
      if (order_[i] == 0) visit(i);
    }
    return std::move(component_);
  }

 private:
  void enter(std::uint32_t vertex) {
    order_[vertex] = lowest_[vertex] = ++entered_;
    on_stack_[vertex] = true;
    stack_.push_back(vertex);
    path_.push_back(vertex);
  }

  void visit(std::uint32_t root) {
    enter(root);
    while (!path_.empty()) {
      const std::uint32_t vertex = path_.back();
      const std::span<const std::uint32_t> successors = graph_[vertex];
      if (next_[vertex] < successors.size()) {
        const std::uint32_t successor = successors[next_[vertex]++];
        if (order_[successor] == 0) {
          enter(successor);
        } else if (on_stack_[successor]) {
          lowest_[vertex] = std::min(lowest_[vertex], order_[successor]);
        }
        continue;
      }
      leave(vertex);
    }
  }

  void leave(std::uint32_t vertex) {
    path_.pop_back();
    if (!path_.empty()) {
      std::uint32_t& outer = lowest_[path_.back()];
      outer = std::min(outer, lowest_[vertex]);
    }
    if (lowest_[vertex] != order_[vertex]) return;
    std::uint32_t member = 0;
    do {
      member = stack_.back();
      stack_.pop_back();
      on_stack_[member] = false;
      component_[member] = components_;
    } while (member != vertex);
    ++components_;
  }

  const Grouped& graph_;
  std::vector<std::uint32_t> order_;  // from 1; 0: not seen
  std::vector<std::uint32_t> lowest_;
  std::vector<std::uint32_t> next_;
  std::vector<bool> on_stack_;
  std::vector<std::uint32_t> component_;
  std::vector<std::uint32_t> stack_;
  std::vector<std::uint32_t> path_;
  std::uint32_t entered_ = 0;
  std::uint32_t components_ = 0;
};

}  // namespace

std::vector<std::uint32_t> cell_components(const Program& program) {
  const Grouped graph = dependencies(program);
  std::vector<std::uint32_t> components =
      Search(graph, program.cells.size() + program.instances.size()).run();
  components.resize(program.cells.size());
  return components;
}

std::vector<bool> cells_in_loops(const Program& program,
                                 const std::vector<std::uint32_t>& component) {
  std::vector<bool> in_loop(program.cells.size());
  std::vector<std::uint32_t> members(
      program.cells.size() + program.instances.size(), 0);
  for (const std::uint32_t it : component) ++members[it];
  for (std::size_t i = 0; i < component.size(); ++i) {
    in_loop[i] = members[component[i]] > 1;
  }
  for (const Rung& rung : program.rungs) {
    for (std::uint32_t i = rung.begin; i < rung.end; ++i) {
      const Node& node = program.nodes[i];
      if (node.op == NodeOp::Read && node.cell == rung.target) {
        in_loop[rung.target.index()] = true;
      }
    }
  }
  return in_loop;
}

}  // namespace rung
