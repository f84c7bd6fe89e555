#include "boards/replay.h"

#include <algorithm>
#include <array>
#include <utility>

#include "analysis/execute.h"
#include "analysis/explanation.h"
#include "boards/stop.h"

namespace rung::boards {
namespace {

constexpr std::uint64_t kMostScans = 0xffff'ffff;
constexpr unsigned kNoMemory = 24;  // docs/postfix.md, section 5

Replayed not_run(std::string why) {
  return {Replayed::Outcome::NotRun, std::move(why)};
}
Replayed different(std::string what) {
  return {Replayed::Outcome::Different, std::move(what)};
}

/// The first cell of a step that is not as it should be.
std::string difference(const Program& program, const Trace::Step& step,
                       const std::vector<std::int64_t>& seen,
                       std::string_view board) {
  for (const CellId id : ids_of(program.cells)) {
    const std::int64_t expected = step.values[id.index()];
    if (seen[id.index()] == expected) continue;
    return "at scan " + std::to_string(step.scan) + " " +
           program.cells[id].name + " is " + std::to_string(expected) +
           " in the run and " + std::to_string(seen[id.index()]) + " on " +
           std::string(board);
  }
  return {};
}

/// Whether the machine has to stop in that scan of the run, and in none before.
bool must_stop_at(const Program& program, const Stimulus& stimulus,
                  std::uint64_t scan) {
  Simulator simulator(program);
  for (const StimulusStep& step : stimulus.steps) {
    set_inputs(simulator, stimulus, step);
    for (std::uint64_t done = 0; done < step.repeat; ++done) {
      simulator.scan(step.dt_ms);
      const bool stops = machine_stops(program, simulator);
      if (stops || simulator.scans() == scan) {
        return stops && simulator.scans() == scan;
      }
    }
  }
  return false;
}

Replayed judge_fault(const Program& program, const Stimulus& stimulus,
                     const Trace& trace, const Execution& execution) {
  const std::size_t before = execution.values.size() - 1;
  const std::uint64_t scan =
      execution.fault_scan + (before == 0 ? 0 : trace.steps[before - 1].scan);
  const std::string stops = "the machine stops in scan " +
                            std::to_string(scan) + " with fault " +
                            std::to_string(execution.fault);
  return must_stop_at(program, stimulus, scan)
             ? not_run(stops + ": a value leaves its range")
             : different(stops + ", and nothing leaves its range there");
}

Replayed judge(const Program& program, const Stimulus& stimulus,
               const Trace& trace, const Execution& execution,
               std::string_view board) {
  if (execution.refusal == kNoMemory) {
    return not_run("the program needs more memory than it has");
  }
  if (execution.refusal != 0) {
    return different("its loader refuses the program, refusal " +
                     std::to_string(execution.refusal));
  }
  for (std::size_t i = 0; i < execution.values.size(); ++i) {
    const bool fault = execution.fault != 0 && i + 1 == execution.values.size();
    if (fault) return judge_fault(program, stimulus, trace, execution);
    std::string what =
        difference(program, trace.steps[i], execution.values[i], board);
    if (!what.empty()) return different(std::move(what));
  }
  return {Replayed::Outcome::Alike, {}};
}

}  // namespace

Replayed replay_on_board(const Emulator& emulator, const Program& program,
                         const Trace& trace, double seconds) {
  for (const Trace::Step& step : trace.steps) {
    if (step.scan <= kMostScans) continue;
    return not_run("the run has too many scans: " + std::to_string(step.scan));
  }
  const Stimulus stimulus = stimulus_of(program, trace);
  DiagnosticList found;
  const std::optional<Job> job = make_job(program, stimulus, found);
  if (!job) {
    for (const Diagnostic& diagnostic : found.items()) {
      if (diagnostic.severity == Severity::Error) {
        return not_run("it cannot be lowered: " + diagnostic.message);
      }
    }
    return not_run("it cannot be lowered");
  }
  const std::array<Job, 1> jobs = {*job};
  const Playback playback = emulator.play(jobs, seconds);
  if (!playback.error.empty()) return not_run(playback.error);
  return judge(program, stimulus, trace, playback.executions.front(),
               emulator.board().name);
}

}  // namespace rung::boards
