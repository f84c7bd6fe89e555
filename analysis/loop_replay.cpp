#include "analysis/loop_replay.h"

#include <algorithm>
#include <limits>

#include "analysis/execute.h"
#include "analysis/simulator.h"

namespace rung {
namespace {

constexpr std::uint64_t kRounds = 3;

std::uint64_t scans_in(const Stimulus& stimulus) {
  std::uint64_t scans = 0;
  for (const StimulusStep& step : stimulus.steps) scans += step.repeat;
  return scans;
}

void append(Stimulus& run, const Stimulus& more) {
  run.steps.insert(run.steps.end(), more.steps.begin(), more.steps.end());
}

void execute(Simulator& simulator, const Stimulus& stimulus) {
  std::uint64_t limit = std::numeric_limits<std::uint64_t>::max();
  for (const StimulusStep& step : stimulus.steps) {
    set_inputs(simulator, stimulus, step);
    run_scans(simulator, step.repeat, step.dt_ms, limit);
  }
}

/// Between two scans, all that the next one can tell apart: an elapsed time
/// only up to the cap of its timer, which lies above every number that it is
/// compared with, in the program as in its properties. So a timer that is done
/// and goes on for ever is in one state.
std::vector<std::int64_t> state_of(const Program& program,
                                   const Simulator& simulator,
                                   const Returning& returning) {
  std::vector<std::int64_t> state;
  for (const CellId cell : returning.cells) {
    state.push_back(simulator.value(cell));
  }
  for (const InstanceId id : returning.instances) {
    const Instance& instance = program.instances[id];
    const bool timer = instance.kind->family == ElementFamily::Timer;
    const std::int64_t count = simulator.count(id);
    state.push_back(std::min(simulator.elapsed(id), instance.clock_cap));
    state.push_back(timer ? std::min(count, instance.clock_cap) : count);
    state.push_back(simulator.done(id) ? 1 : 0);
  }
  return state;
}

std::string wrong_in_round(std::uint64_t round, const ReplayAll& seen,
                           std::uint64_t stem, std::uint64_t loop,
                           bool may_meet_goal) {
  const std::string at = " in round " + std::to_string(round) + " of the loop";
  if (!seen.assumptions_hold) return "the run found breaks an assumption";
  if (!may_meet_goal && seen.last_at[0] > stem) {
    return "the simulator gets to the goal" + at;
  }
  for (std::size_t i = 1; i < seen.last_at.size(); ++i) {
    if (seen.last_at[i] > stem + (round - 1) * loop) continue;
    return "what is given as fair is not true" + at;
  }
  return {};
}

}  // namespace

std::string refuted_loop(const Program& program, const PropertySet& properties,
                         std::uint32_t property, const Lasso& lasso,
                         const Returning& returning, bool may_meet_goal) {
  const std::uint64_t stem = scans_in(lasso.stem);
  const std::uint64_t loop = scans_in(lasso.loop);
  if (loop == 0) return "the loop found has no scan";
  std::vector<ReplayTarget> targets = {{property, 0}};
  const std::size_t fair = properties.properties[property].formulas.size() - 1;
  for (std::uint32_t i = 0; i < fair; ++i) {
    targets.push_back({property, i, true});
  }
  Stimulus run = lasso.stem;
  Simulator simulator(program);
  execute(simulator, lasso.stem);
  const std::vector<std::int64_t> first =
      state_of(program, simulator, returning);
  for (std::uint64_t round = 1; round <= kRounds; ++round) {
    append(run, lasso.loop);
    std::string wrong =
        wrong_in_round(round, replay_all(program, properties, targets, run),
                       stem, loop, may_meet_goal);
    if (!wrong.empty()) return wrong;
    execute(simulator, lasso.loop);
    if (state_of(program, simulator, returning) != first) {
      return "the simulator is not where it was after round " +
             std::to_string(round) + " of the loop";
    }
  }
  return {};
}

Trace trace_of(const Program& program, const Lasso& lasso) {
  Stimulus run = lasso.stem;
  append(run, lasso.loop);
  Trace trace = simulate_changes(program, run);
  const std::uint64_t stem = scans_in(lasso.stem);
  const auto begin =
      std::find_if(trace.steps.begin(), trace.steps.end(),
                   [&](const Trace::Step& step) { return step.scan > stem; });
  trace.loop = static_cast<std::size_t>(begin - trace.steps.begin());
  return trace;
}

}  // namespace rung
