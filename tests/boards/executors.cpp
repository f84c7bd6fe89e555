#include "executors.h"

#include <algorithm>
#include <utility>

#include "analysis/simulator.h"
#include "analysis/transition_system.h"
#include "avr_board.h"
#include "boards/emulator.h"
#include "boards/image.h"
#include "boards/stop.h"
#include "random_run.h"
#include "ts_interpreter.h"

namespace rung {
namespace {

std::string describe(const Program& program, const Execution& reference,
                     const Execution& other, std::size_t scans) {
  for (std::size_t scan = 0; scan < scans; ++scan) {
    for (const CellId id : ids_of(program.cells)) {
      const std::int64_t expected = reference.values[scan][id.index()];
      const std::int64_t seen = other.values[scan][id.index()];
      if (expected == seen) continue;
      return "scan " + std::to_string(scan + 1) + ": " +
             program.cells[id].name + " is " + std::to_string(expected) +
             " and " + std::to_string(seen);
    }
  }
  return {};
}

/// How many of `cases`, from the first on, fit on a tape.
std::vector<boards::Job> next_batch(std::span<const Case> cases,
                                    std::size_t capacity) {
  std::vector<boards::Job> jobs;
  for (const Case& test : cases) {
    jobs.push_back(test.job);
    if (boards::write_tape(jobs).size() <= capacity) continue;
    jobs.pop_back();
    break;
  }
  return jobs;
}

BoardRun run_avr(const std::string& mcu, const std::string& elf,
                 std::span<const Case> cases) {
  constexpr std::uint64_t kMostCycles = 4'000'000'000;
  BoardRun run;
  AvrBoard board(mcu, elf);
  run.problem = board.error();
  if (!run.problem.empty()) return run;
  const std::span<std::uint8_t> flash = board.flash();
  const auto place = boards::find_tape_place(
      {reinterpret_cast<const char*>(flash.data()), flash.size()});
  if (!place) run.problem = "no place for a tape";
  while (run.problem.empty() && run.executions.size() < cases.size()) {
    const std::vector<boards::Job> jobs =
        next_batch(cases.subspan(run.executions.size()), place->size);
    if (jobs.empty()) {
      run.problem = cases[run.executions.size()].name + " takes too much flash";
      break;
    }
    const std::string tape = boards::write_tape(jobs);
    std::copy(tape.begin(), tape.end(),
              flash.begin() + static_cast<std::ptrdiff_t>(place->at));
    board.reset();
    if (board.run(kMostCycles) != AvrBoard::State::Done) {
      run.problem = "the board does not come to the end";
      break;
    }
    const boards::Playback playback =
        boards::read_report(board.take_output(), jobs);
    run.problem = playback.error;
    run.executions.insert(run.executions.end(), playback.executions.begin(),
                          playback.executions.end());
  }
  return run;
}

BoardRun run_arm(const std::string& elf, std::span<const Case> cases) {
  std::vector<boards::Job> jobs;
  for (const Case& test : cases) jobs.push_back(test.job);
  const boards::Emulator emulator(*boards::find_board("arm"), elf);
  if (!emulator.error().empty()) return {{}, emulator.error()};
  boards::Playback playback = emulator.play(jobs, 300);
  return {std::move(playback.executions), std::move(playback.error)};
}

}  // namespace

Stimulus scan_by_scan(const Stimulus& stimulus) {
  Stimulus result;
  result.inputs = stimulus.inputs;
  for (StimulusStep step : stimulus.steps) {
    const std::uint64_t repeat = std::exchange(step.repeat, 1);
    result.steps.insert(result.steps.end(), repeat, step);
  }
  return result;
}

Execution run_simulator(const Program& program, const Stimulus& stimulus) {
  Execution execution;
  Simulator simulator(program);
  for (const StimulusStep& step : stimulus.steps) {
    for (std::size_t i = 0; i < step.inputs.size(); ++i) {
      simulator.set_input(stimulus.inputs[i], step.inputs[i]);
    }
    simulator.scan(step.dt_ms);
    if (boards::machine_stops(program, simulator)) break;
    std::vector<std::int64_t>& values = execution.values.emplace_back();
    for (const CellId id : ids_of(program.cells)) {
      values.push_back(simulator.value(id));
    }
  }
  return execution;
}

Execution run_system(const Program& program, const Stimulus& stimulus) {
  Execution execution;
  const TransitionSystem ts = build_transition_system(program);
  TsInterpreter interpreter(ts);
  for (const StimulusStep& step : stimulus.steps) {
    set_inputs(ts, stimulus, step, interpreter);
    interpreter.step();
    if (faulted(ts, interpreter)) break;
    std::vector<std::int64_t>& values = execution.values.emplace_back();
    for (const CellId id : ids_of(program.cells)) {
      values.push_back(interpreter.value(ts.cell_end[id.index()]));
    }
  }
  return execution;
}

BoardRun run_board(const std::string& board, const std::string& firmware,
                   std::span<const Case> cases) {
  const std::string elf =
      RUNG_FIRMWARE_DIR "/" + firmware + "-" + board + ".elf";
  if (board == "arm") return run_arm(elf, cases);
  return run_avr(board == "uno" ? "atmega328p" : "atmega32u4", elf, cases);
}

Program with_fault(Program program) {
  for (Node& node : program.nodes) {
    if (node.op == NodeOp::And) {
      node.op = NodeOp::Or;
    } else if (node.op == NodeOp::Or) {
      node.op = NodeOp::And;
    } else if (node.op == NodeOp::Branch) {
      node.skip_when = !node.skip_when;
    }
  }
  return program;
}

std::string difference(const Program& program, const Execution& reference,
                       const Execution& other) {
  if (reference == other) return {};
  if (reference.refusal != other.refusal) {
    return "refusals " + std::to_string(reference.refusal) + " and " +
           std::to_string(other.refusal);
  }
  const std::string cells =
      describe(program, reference, other,
               std::min(reference.values.size(), other.values.size()));
  if (!cells.empty()) return cells;
  return "they stop with faults " + std::to_string(reference.fault) + " and " +
         std::to_string(other.fault) + " in scans " +
         std::to_string(reference.values.size()) + " and " +
         std::to_string(other.values.size());
}

std::string difference_to_simulator(const Program& program,
                                    const Execution& simulated,
                                    const Execution& machine) {
  const std::string cells =
      describe(program, simulated, machine,
               std::min(simulated.values.size(), machine.values.size()));
  const std::size_t complete =
      machine.values.size() - (machine.fault != 0 ? 1 : 0);
  if (!cells.empty() || simulated.values.size() == complete) return cells;
  return "the simulator stops behind scan " +
         std::to_string(simulated.values.size()) + ", the machine behind " +
         std::to_string(complete);
}

std::string difference_before_end(const Program& program,
                                  const Execution& simulated,
                                  const Execution& system) {
  return describe(program, simulated, system,
                  std::min(simulated.values.size(), system.values.size()));
}

}  // namespace rung
