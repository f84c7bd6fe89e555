#include <algorithm>

#include "analysis/simulator.h"

namespace rung {
namespace {

class Runner {
 public:
  Runner(const Program& program, const Stimulus& stimulus)
      : simulator_(program), stimulus_(stimulus) {
    const bool driven = std::any_of(
        stimulus.inputs.begin(), stimulus.inputs.end(),
        [&program](CellId cell) { return program.cells[cell].plant_written; });
    runs_plant_ = simulator_.has_plant() && !driven;
  }

  const Simulator& simulator() const { return simulator_; }

  /// Calls `after_scan` after each scan that is executed; those that are
  /// skipped change no cell.
  template <class AfterScan>
  void run(const StimulusStep& step, const AfterScan& after_scan) {
    std::uint64_t left = step.repeat;
    while (left > 0) {
      // The plant of the scan before: what it gives the inputs is for this one.
      if (runs_plant_ && simulator_.scans() > 0) simulator_.run_plant();
      if (left == step.repeat) set_inputs(step);
      simulator_.scan(step.dt_ms);
      --left;
      after_scan();
      if (left > 0 && !runs_plant_) left -= skip_idle(left, step.dt_ms);
    }
  }

 private:
  void set_inputs(const StimulusStep& step) {
    for (std::size_t i = 0; i < stimulus_.inputs.size(); ++i) {
      simulator_.set_input(stimulus_.inputs[i], step.inputs[i]);
    }
  }

  std::uint64_t skip_idle(std::uint64_t limit, std::int64_t dt_ms) {
    const std::uint64_t idle = std::min(limit, simulator_.idle_scans(dt_ms));
    simulator_.skip(idle, dt_ms);
    return idle;
  }

  Simulator simulator_;
  const Stimulus& stimulus_;
  bool runs_plant_ = false;
};

}  // namespace

Trace simulate(const Program& program, const Stimulus& stimulus) {
  Runner runner(program, stimulus);
  Trace trace;
  trace.steps.reserve(stimulus.steps.size());
  for (const StimulusStep& step : stimulus.steps) {
    runner.run(step, [] {});
    const Simulator& simulator = runner.simulator();
    Trace::Step& out = trace.steps.emplace_back();
    out.scan = simulator.scans();
    out.dt_ms = step.dt_ms;
    out.repeat = step.repeat;
    for (const CellId cell : ids_of(program.cells)) {
      out.values.push_back(simulator.value(cell));
    }
  }
  return trace;
}

Recording record(const Program& program, const Stimulus& stimulus) {
  Runner runner(program, stimulus);
  const Simulator& simulator = runner.simulator();
  Recording recording;
  for (const CellId cell : ids_of(program.cells)) {
    recording.initial.push_back(simulator.value(cell));
  }
  std::vector<std::int64_t> last = recording.initial;
  for (const StimulusStep& step : stimulus.steps) {
    runner.run(step, [&] {
      Recording::Sample sample;
      sample.now_ms = simulator.now_ms();
      for (const CellId cell : ids_of(program.cells)) {
        const std::int64_t value = simulator.value(cell);
        if (value == last[cell.index()]) continue;
        sample.changes.push_back({cell, value});
        last[cell.index()] = value;
      }
      if (!sample.changes.empty()) {
        recording.samples.push_back(std::move(sample));
      }
    });
  }
  recording.end_ms = simulator.now_ms();
  return recording;
}

}  // namespace rung
