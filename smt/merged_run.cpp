#include "smt/merged_run.h"

#include <cassert>

namespace rung {

std::vector<std::int64_t> beats_of(const TransitionSystem& ts,
                                   const FoundRun& run) {
  std::vector<std::int64_t> beats;
  for (const RunStep& step : run.steps) {
    std::int64_t dt = ts.scan.min_ms;
    for (std::size_t i = 0; i < run.inputs.size(); ++i) {
      if (ts.vars[run.inputs[i]].role == VarRole::Dt) dt = step.inputs[i];
    }
    beats.push_back(dt);
    beats.push_back(step.delta);
  }
  return beats;
}

bool MergedRun::agrees(const FoundRun& run) const {
  for (std::size_t i = 0; i < run.inputs.size(); ++i) {
    const auto known = column_.find(run.inputs[i]);
    if (known == column_.end()) continue;
    for (std::size_t step = 0; step < run.steps.size(); ++step) {
      if (run.steps[step].inputs[i] != run_.steps[step].inputs[known->second]) {
        return false;
      }
    }
  }
  return true;
}

bool MergedRun::add(const TransitionSystem& ts, const FoundRun& run) {
  if (run_.steps.empty()) {
    run_.steps.resize(run.steps.size());
    const std::vector<std::int64_t> beats = beats_of(ts, run);
    run_.inputs.push_back(ts.dt);
    column_.emplace(ts.dt, 0);
    for (std::size_t i = 0; i < run.steps.size(); ++i) {
      run_.steps[i] = {{beats[2 * i]}, beats[2 * i + 1]};
    }
  }
  assert(run.steps.size() == run_.steps.size());
  if (!agrees(run)) return false;
  for (std::size_t i = 0; i < run.inputs.size(); ++i) {
    if (!column_.emplace(run.inputs[i], run_.inputs.size()).second) continue;
    run_.inputs.push_back(run.inputs[i]);
    for (std::size_t step = 0; step < run.steps.size(); ++step) {
      run_.steps[step].inputs.push_back(run.steps[step].inputs[i]);
    }
  }
  return true;
}

}  // namespace rung
