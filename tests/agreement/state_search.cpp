#include "state_search.h"

#include <algorithm>
#include <cassert>
#include <string>
#include <unordered_map>
#include <utility>

#include "ts_interpreter.h"

namespace rung {
namespace {

using StateValues = std::vector<std::int64_t>;

class Search {
 public:
  Search(const TransitionSystem& ts, const std::vector<Obligation>& obligations)
      : ts_(ts), obligations_(obligations), interpreter_(ts) {
    result_.decided_at.resize(obligations.size(), 0);
    assert(obligations.size() <= 64);
    for (const Obligation& obligation : obligations) {
      result_.triggered.push_back(!obligation.trigger.has_value());
    }
    for (const VarId id : ids_of(ts.vars)) {
      const Variable& var = ts.vars[id];
      assert(var.role != VarRole::Input || var.type == Type::Bit);
      const bool bit =
          var.role == VarRole::Input || var.role == VarRole::Choice;
      if (bit) bits_.push_back(id);
    }
  }

  StateSearch run(std::size_t max_states) {
    StateValues initial;
    for (const State& state : ts_.states) initial.push_back(state.init);
    place(initial);
    while (!next_.empty()) {
      if (seen_.size() > max_states) return result_;
      ++scan_;
      const std::vector<StateValues> frontier = std::exchange(next_, {});
      for (const StateValues& state : frontier) visit(state, scan_);
    }
    result_.complete = true;
    for (std::size_t i = 0; i < obligations_.size(); ++i) {
      if (obligations_[i].goal == Goal::Recover) find_stuck(i);
    }
    return result_;
  }

 private:
  using Edge = StateSearch::Edge;

  /// The state's number; a new one is visited later.
  std::uint32_t place(const StateValues& state) {
    const auto* const bytes = reinterpret_cast<const char*>(state.data());
    const auto [entry, is_new] =
        seen_.emplace(std::string(bytes, state.size() * sizeof(state[0])),
                      static_cast<std::uint32_t>(seen_.size()));
    if (is_new) {
      next_.push_back(state);
      result_.states.push_back(state);
      result_.reached_in.push_back(scan_);
    }
    return entry->second;
  }

  /// The shortest run to a scan that is not one to get to and from whose end
  /// none can be got to.
  void find_stuck(std::size_t obligation) {
    std::vector<bool> leads(seen_.size(), false);
    const auto is_goal = [&](const Edge& edge) {
      return (edge.goals >> obligation & 1U) != 0;
    };
    for (bool more = true; more;) {
      more = false;
      for (const Edge& edge : result_.edges) {
        if (leads[edge.from] || !(is_goal(edge) || leads[edge.to])) continue;
        leads[edge.from] = more = true;
      }
    }
    for (const Edge& edge : result_.edges) {
      if (is_goal(edge) || leads[edge.to]) continue;
      std::uint64_t& at = result_.decided_at[obligation];
      if (at == 0 || edge.number < at) at = edge.number;
    }
  }

  void visit(const StateValues& state, std::uint64_t scan) {
    for (std::int64_t dt = ts_.scan.min_ms; dt <= ts_.scan.max_ms; ++dt) {
      for (std::uint32_t inputs = 0; inputs < 1U << bits_.size(); ++inputs) {
        step(state, dt, inputs);
        const bool allowed = std::all_of(
            ts_.constraints.begin(), ts_.constraints.end(),
            [this](ExprId term) { return interpreter_.value(term) != 0; });
        if (!allowed) continue;
        result_.runs = true;
        const std::uint64_t goals = judge(scan);
        StateValues after;
        for (std::uint32_t i = 0; i < ts_.states.size(); ++i) {
          after.push_back(interpreter_.state(i));
        }
        const std::uint32_t from = place(state);
        const std::uint32_t to = place(after);
        if (result_.reached_in[to] == 0) result_.reached_in[to] = scan;
        result_.edges.push_back({from, to, dt, scan, goals});
      }
    }
  }

  void step(const StateValues& state, std::int64_t dt, std::uint32_t inputs) {
    for (std::uint32_t i = 0; i < state.size(); ++i) {
      interpreter_.set_state(i, state[i]);
    }
    interpreter_.set(ts_.dt, dt);
    for (std::size_t i = 0; i < bits_.size(); ++i) {
      interpreter_.set(bits_[i], inputs >> i & 1);
    }
    interpreter_.step();
  }

  /// Which conditions hold, by obligation.
  std::uint64_t judge(std::uint64_t scan) {
    std::uint64_t held = 0;
    for (std::size_t i = 0; i < obligations_.size(); ++i) {
      const Obligation& obligation = obligations_[i];
      const bool holds = interpreter_.value(obligation.condition) != 0;
      held |= std::uint64_t{holds} << i;
      const bool decides = holds == (obligation.goal == Goal::Reach) &&
                           obligation.goal != Goal::Recover &&
                           obligation.goal != Goal::Respond;
      if (decides && result_.decided_at[i] == 0) result_.decided_at[i] = scan;
      if (!result_.triggered[i] &&
          interpreter_.value(obligation.trigger) != 0) {
        result_.triggered[i] = true;
      }
    }
    return held;
  }

  const TransitionSystem& ts_;
  const std::vector<Obligation>& obligations_;
  TsInterpreter interpreter_;
  std::uint64_t scan_ = 0;
  std::vector<VarId> bits_;
  std::unordered_map<std::string, std::uint32_t> seen_;  // the values' bytes
  std::vector<StateValues> next_;
  StateSearch result_;
};

}  // namespace

StateSearch search_states(const TransitionSystem& ts,
                          const std::vector<Obligation>& obligations,
                          std::size_t max_states) {
  return Search(ts, obligations).run(max_states);
}

}  // namespace rung
