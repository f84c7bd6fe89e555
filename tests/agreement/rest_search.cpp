#include "rest_search.h"

#include <algorithm>
#include <map>

#include "ts_interpreter.h"

namespace rung {
namespace {

using StateValues = std::vector<std::int64_t>;

class Rest {
 public:
  Rest(const Program& program, const TransitionSystem& ts)
      : program_(program), ts_(ts), interpreter_(ts) {
    for (const VarId id : ids_of(ts.vars)) {
      const VarRole role = ts.vars[id].role;
      if (role == VarRole::Input || role == VarRole::Choice) {
        bits_.push_back(id);
      }
    }
    interpreter_.set(ts.dt, 0);
  }

  std::uint32_t input_count() const { return 1U << bits_.size(); }

  /// The scans at rest behind which an output changes, of a run from `state`:
  /// from 1, ascending; of those that come again and again the first `most`.
  std::vector<std::uint64_t> changes(const StateValues& state,
                                     std::uint32_t inputs, std::uint64_t most) {
    for (std::size_t i = 0; i < bits_.size(); ++i) {
      interpreter_.set(bits_[i], inputs >> i & 1);
    }
    for (std::uint32_t i = 0; i < state.size(); ++i) {
      interpreter_.set_state(i, state[i]);
    }
    std::vector<std::uint64_t> result;
    std::vector<std::int64_t> before;
    std::map<StateValues, std::uint64_t> seen;
    for (std::uint64_t scan = 1;; ++scan) {
      interpreter_.step();
      if (!allowed()) return result;
      const std::vector<std::int64_t> now = outputs();
      if (scan > 1 && now != before) result.push_back(scan - 1);
      before = now;
      // In a loop all has been seen, but for how often it comes.
      const bool again = !seen.emplace(values(), scan).second;
      if (again && (result.empty() || scan > 2 * seen.size() + most)) {
        return result;
      }
    }
  }

 private:
  bool allowed() const {
    return std::all_of(
        ts_.constraints.begin(), ts_.constraints.end(),
        [this](ExprId term) { return interpreter_.value(term) != 0; });
  }
  StateValues values() const {
    StateValues result;
    for (std::uint32_t i = 0; i < ts_.states.size(); ++i) {
      result.push_back(interpreter_.state(i));
    }
    return result;
  }
  std::vector<std::int64_t> outputs() const {
    std::vector<std::int64_t> result;
    for (const CellId id : ids_of(program_.cells)) {
      if (program_.cells[id].role != CellRole::Output) continue;
      result.push_back(interpreter_.value(ts_.cell_end[id.index()]));
    }
    return result;
  }

  const Program& program_;
  const TransitionSystem& ts_;
  TsInterpreter interpreter_;
  std::vector<VarId> bits_;
};

}  // namespace

std::vector<std::uint64_t> search_rest(const Program& program,
                                       const TransitionSystem& ts,
                                       const StateSearch& search,
                                       std::uint32_t most_scans) {
  std::vector<std::uint64_t> decided(most_scans + 1, 0);
  Rest rest(program, ts);
  for (std::size_t i = 0; i < search.states.size(); ++i) {
    // Time stops behind a scan, not before the first one.
    if (search.reached_in[i] == 0) continue;
    for (std::uint32_t inputs = 0; inputs < rest.input_count(); ++inputs) {
      for (const std::uint64_t scan :
           rest.changes(search.states[i], inputs, most_scans)) {
        const std::uint64_t run = search.reached_in[i] + scan + 1;
        for (std::uint64_t n = 1;
             n <= std::min<std::uint64_t>(scan, most_scans); ++n) {
          if (decided[n] == 0 || run < decided[n]) decided[n] = run;
        }
      }
    }
  }
  return decided;
}

}  // namespace rung
