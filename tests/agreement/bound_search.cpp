#include "bound_search.h"

#include <algorithm>
#include <vector>

namespace rung {
namespace {

using Edge = StateSearch::Edge;

bool is_cause(const Edge& edge) { return (edge.goals & 1U) != 0; }
bool is_response(const Edge& edge) { return (edge.goals & 2U) != 0; }
bool is_rise(const Edge& edge) { return (edge.goals & 4U) != 0; }

class Ways {
 public:
  Ways(const StateSearch& search, bool in_scans)
      : edges_(search.edges), states_(search.states.size()), scans_(in_scans) {}

  /// From a state on, while Q does not come: as many rounds as there are
  /// states lengthen what is finite; what they lengthen still is not.
  std::optional<std::int64_t> longest() const {
    std::vector<bool> waits = waiting();
    std::vector<std::int64_t> most(states_, 0);
    bool more = true;
    for (std::size_t round = 0; more; ++round) {
      if (round > states_) return std::nullopt;
      more = false;
      for (const Edge& edge : edges_) {
        if (!waits[edge.from]) continue;
        const std::int64_t rest = is_response(edge) ? 0 : most[edge.to];
        if (length(edge) + rest <= most[edge.from]) continue;
        most[edge.from] = length(edge) + rest;
        more = true;
      }
    }
    std::int64_t result = 0;
    for (const Edge& edge : edges_) {
      if (is_cause(edge) && !is_response(edge)) {
        result = std::max(result, most[edge.to]);
      }
    }
    return result;
  }

  std::optional<std::int64_t> shortest() const {
    constexpr std::int64_t kNever = std::int64_t{1} << 40;
    std::vector<std::int64_t> least(states_, kNever);
    for (bool more = true; more;) {
      more = false;
      for (const Edge& edge : edges_) {
        const std::int64_t rest = is_response(edge) ? 0 : least[edge.to];
        if (length(edge) + rest >= least[edge.from]) continue;
        least[edge.from] = length(edge) + rest;
        more = true;
      }
    }
    std::int64_t result = kNever;
    for (const Edge& edge : edges_) {
      if (!is_rise(edge)) continue;
      result = std::min(result, is_response(edge) ? 0 : least[edge.to]);
    }
    if (result >= kNever) return std::nullopt;
    return result;
  }

 private:
  std::int64_t length(const Edge& edge) const {
    return scans_ ? 1 : edge.dt_ms;
  }

  /// States in which a P can be without its Q.
  std::vector<bool> waiting() const {
    std::vector<bool> waits(states_, false);
    for (bool more = true; more;) {
      more = false;
      for (const Edge& edge : edges_) {
        const bool open = waits[edge.from] || is_cause(edge);
        if (!open || is_response(edge) || waits[edge.to]) continue;
        waits[edge.to] = more = true;
      }
    }
    return waits;
  }

  const std::vector<Edge>& edges_;
  std::size_t states_;
  bool scans_;
};

}  // namespace

Extremes find_extremes(const StateSearch& search) {
  Extremes result;
  result.cause =
      std::any_of(search.edges.begin(), search.edges.end(), is_cause);
  for (const bool in_scans : {false, true}) {
    const Ways ways(search, in_scans);
    result.worst[in_scans ? 1 : 0] = ways.longest();
    result.best[in_scans ? 1 : 0] = ways.shortest();
  }
  return result;
}

}  // namespace rung
