#include "smt/lockstep.h"

#include <algorithm>
#include <cstdint>
#include <deque>
#include <utility>
#include <vector>

#include "analysis/simulator.h"

namespace rung {
namespace {

/// One of the two programs: a simulator and what was fed to it.
class Side {
 public:
  explicit Side(const Program& program)
      : program_(program), simulator_(program) {}

  void add_input(CellId cell) {
    stimulus_.inputs.push_back(cell);
    const Cell& model = program_.cells[cell];
    values_.push_back(std::clamp<std::int64_t>(0, model.low, model.high));
  }
  void set(CellId cell, std::int64_t value) {
    const auto at =
        std::find(stimulus_.inputs.begin(), stimulus_.inputs.end(), cell);
    values_[static_cast<std::size_t>(at - stimulus_.inputs.begin())] = value;
  }
  void begin_step(std::int64_t dt_ms) {
    for (std::size_t i = 0; i < values_.size(); ++i) {
      simulator_.set_input(stimulus_.inputs[i], values_[i]);
    }
    stimulus_.steps.push_back({dt_ms, 0, values_});
  }
  void scan() {
    StimulusStep& step = stimulus_.steps.back();
    ++step.repeat;
    simulator_.scan(step.dt_ms);
  }
  std::int64_t value(CellId cell) const { return simulator_.value(cell); }
  Stimulus take() { return std::move(stimulus_); }

 private:
  const Program& program_;
  Simulator simulator_;
  Stimulus stimulus_;
  std::vector<std::int64_t> values_;
};

/// The shared outputs of the first program, as they were some scans ago.
class Delayed {
 public:
  Delayed(const Program& program, const SharedSignals& shared,
          std::uint32_t delay)
      : shared_(&shared) {
    Values initial;
    for (const SignalPair& pair : shared.outputs) {
      initial.push_back(program.cells[pair.a].initial);
    }
    history_.assign(delay, initial);
  }
  void take(const Side& side) {
    Values now;
    for (const SignalPair& pair : shared_->outputs) {
      now.push_back(side.value(pair.a));
    }
    history_.push_back(std::move(now));
    shown_ = std::move(history_.front());
    history_.pop_front();
  }
  std::int64_t operator[](std::size_t output) const { return shown_[output]; }

 private:
  using Values = std::vector<std::int64_t>;

  const SharedSignals* shared_;
  std::deque<Values> history_;
  Values shown_;
};

void find_difference(const Program& a, const SharedSignals& shared,
                     const Delayed& expected, const Side& second,
                     LockStep& result) {
  for (std::size_t at = 0; at < shared.outputs.size(); ++at) {
    const SignalPair& pair = shared.outputs[at];
    if (expected[at] == second.value(pair.b)) continue;
    result.differs = true;
    result.output = a.cells[pair.a].name;
    return;
  }
}

/// Steps end where scans of `ends` do (ascending) and where they did.
void split(Stimulus& stimulus, const std::vector<std::uint64_t>& ends) {
  std::vector<StimulusStep> steps;
  std::uint64_t scan = 0;
  auto end = ends.begin();
  for (StimulusStep& step : stimulus.steps) {
    const std::uint64_t last = scan + step.repeat;
    while (scan < last) {
      end = std::upper_bound(end, ends.end(), scan);
      const std::uint64_t until =
          end == ends.end() ? last : std::min(last, *end);
      step.repeat = until - scan;
      steps.push_back(step);
      scan = until;
    }
  }
  stimulus.steps = std::move(steps);
}

}  // namespace

LockStep run_lockstep(const Program& a, const Program& b,
                      const SharedSignals& shared, const Stimulus& stimulus,
                      const Comparison& comparison) {
  LockStep result;
  Side first(a);
  Side second(b);
  Delayed expected(a, shared, comparison.delay);
  for (const SignalPair& pair : shared.inputs) {
    if (pair.a.has_value()) first.add_input(pair.a);
    if (pair.b.has_value()) second.add_input(pair.b);
  }
  for (const StimulusStep& step : stimulus.steps) {
    const bool last_step = &step == &stimulus.steps.back();
    for (std::size_t i = 0; i < stimulus.inputs.size(); ++i) {
      const SignalPair& pair = shared.inputs[stimulus.inputs[i].index()];
      if (pair.a.has_value()) first.set(pair.a, step.inputs[i]);
      if (pair.b.has_value()) second.set(pair.b, step.inputs[i]);
    }
    first.begin_step(step.dt_ms);
    second.begin_step(step.dt_ms);
    for (std::uint64_t i = 0; i < step.repeat && !result.differs; ++i) {
      first.scan();
      second.scan();
      expected.take(first);
      const bool last = last_step && i + 1 == step.repeat;
      if (comparison.settled && !last) continue;
      find_difference(a, shared, expected, second, result);
    }
    if (result.differs) break;
  }
  result.stimulus_a = first.take();
  result.stimulus_b = second.take();
  return result;
}

void split_where_cells_change(const Program& a, const Program& b,
                              LockStep& run) {
  std::vector<std::uint64_t> ends;
  for (const Trace& trace : {simulate_changes(a, run.stimulus_a),
                             simulate_changes(b, run.stimulus_b)}) {
    for (const Trace::Step& step : trace.steps) ends.push_back(step.scan);
  }
  std::sort(ends.begin(), ends.end());
  split(run.stimulus_a, ends);
  split(run.stimulus_b, ends);
}

}  // namespace rung
