#include "fair_cycles.h"

#include <algorithm>
#include <vector>

namespace rung {
namespace {

using Edges = std::vector<std::vector<std::uint32_t>>;

/// Behind all that is reached from it.
void finish_from(std::uint32_t root, const Edges& edges,
                 std::vector<bool>& seen, std::vector<std::uint32_t>& order) {
  std::vector<std::pair<std::uint32_t, std::size_t>> stack = {{root, 0}};
  seen[root] = true;
  while (!stack.empty()) {
    auto& [node, next] = stack.back();
    if (next == edges[node].size()) {
      order.push_back(node);
      stack.pop_back();
      continue;
    }
    const std::uint32_t to = edges[node][next++];
    if (seen[to]) continue;
    seen[to] = true;
    stack.emplace_back(to, 0);
  }
}

/// Kosaraju: the component of each state.
std::vector<std::uint32_t> components(const Edges& forward,
                                      const Edges& backward) {
  const auto count = static_cast<std::uint32_t>(forward.size());
  std::vector<bool> seen(count, false);
  std::vector<std::uint32_t> order;
  for (std::uint32_t i = 0; i < count; ++i) {
    if (!seen[i]) finish_from(i, forward, seen, order);
  }
  std::vector<std::uint32_t> component(count, 0);
  seen.assign(count, false);
  std::uint32_t number = 0;
  std::reverse(order.begin(), order.end());
  for (const std::uint32_t root : order) {
    if (seen[root]) continue;
    std::vector<std::uint32_t> members;
    finish_from(root, backward, seen, members);
    for (const std::uint32_t member : members) component[member] = number;
    ++number;
  }
  return component;
}

}  // namespace

bool has_fair_cycle(const StateSearch& search, std::uint64_t goal,
                    std::uint64_t fair) {
  Edges forward(search.states.size());
  Edges backward(search.states.size());
  for (const StateSearch::Edge& edge : search.edges) {
    if ((edge.goals & goal) != 0) continue;
    forward[edge.from].push_back(edge.to);
    backward[edge.to].push_back(edge.from);
  }
  const std::vector<std::uint32_t> component = components(forward, backward);
  std::vector<std::uint64_t> met(search.states.size(), 0);
  std::vector<bool> cycle(search.states.size(), false);
  for (const StateSearch::Edge& edge : search.edges) {
    if ((edge.goals & goal) != 0) continue;
    if (component[edge.from] != component[edge.to]) continue;
    met[component[edge.from]] |= edge.goals & fair;
    cycle[component[edge.from]] = true;
  }
  for (std::size_t i = 0; i < met.size(); ++i) {
    if (cycle[i] && met[i] == fair) return true;
  }
  return false;
}

}  // namespace rung
