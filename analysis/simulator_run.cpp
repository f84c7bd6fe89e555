#include <algorithm>
#include <utility>

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

/// Writes down what a runner does, a stimulus step in at most `max_parts`.
class TraceWriter {
 public:
  TraceWriter(const Program& program, const Simulator& simulator,
              std::size_t max_parts)
      : simulator_(simulator),
        max_parts_(max_parts),
        values_(program.cells.size()) {}

  void begin_step(std::int64_t dt_ms) {
    dt_ms_ = dt_ms;
    parts_ = 0;
  }
  /// A scan was executed; those that were skipped before it changed nothing.
  void after_scan() {
    look();
    const bool same = parts_ > 0 && trace_.steps.back().values == values_;
    if (same) return;
    if (parts_ < max_parts_) {
      if (parts_ > 0) close(simulator_.scans() - 1);
      trace_.steps.emplace_back().dt_ms = dt_ms_;
      ++parts_;
    } else {
      trace_.steps.back().changes = true;
    }
    trace_.steps.back().values = values_;
  }
  void end_step() {
    if (parts_ == 0) {  // of no scans
      look();
      trace_.steps.emplace_back().dt_ms = dt_ms_;
      trace_.steps.back().values = values_;
    }
    close(simulator_.scans());
  }
  Trace take() { return std::move(trace_); }

 private:
  void look() {
    for (std::uint32_t i = 0; i < values_.size(); ++i) {
      values_[i] = simulator_.value(CellId(i));
    }
  }
  void close(std::uint64_t scan) {
    Trace::Step& step = trace_.steps.back();
    step.scan = scan;
    step.repeat = scan - closed_;
    closed_ = scan;
  }

  const Simulator& simulator_;
  std::size_t max_parts_;
  std::vector<std::int64_t> values_;
  std::int64_t dt_ms_ = 1;
  std::size_t parts_ = 0;     // of the stimulus step at hand
  std::uint64_t closed_ = 0;  // the last scan that stands in the trace
  Trace trace_;
};

Trace written(const Program& program, const Stimulus& stimulus,
              std::size_t max_parts) {
  Runner runner(program, stimulus);
  TraceWriter writer(program, runner.simulator(), max_parts);
  for (const StimulusStep& step : stimulus.steps) {
    writer.begin_step(step.dt_ms);
    runner.run(step, [&writer] { writer.after_scan(); });
    writer.end_step();
  }
  return writer.take();
}

}  // namespace

Trace simulate(const Program& program, const Stimulus& stimulus) {
  return written(program, stimulus, 1);
}

Trace simulate_changes(const Program& program, const Stimulus& stimulus) {
  constexpr std::size_t kMaxParts = 64;
  return written(program, stimulus, kMaxParts);
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
