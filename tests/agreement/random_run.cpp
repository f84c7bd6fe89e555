#include "random_run.h"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "analysis/rollover.h"
#include "frontend/script/reader.h"

namespace rung {
namespace {

// Small values meet the program's constants, the ends of the range its
// overflows.
std::int64_t random_word(const Cell& cell, Tape& tape) {
  switch (tape.pick(4)) {
    case 0:
      return std::clamp<std::int64_t>(tape.pick(60), cell.low, cell.high);
    case 1:
      return cell.high - tape.pick(2);
    case 2:
      return cell.low + tape.pick(2);
    default:
      return cell.low +
             tape.pick(static_cast<std::uint32_t>(cell.high - cell.low + 1));
  }
}

std::int64_t random_dt(const ScanInterval& scan, Tape& tape) {
  constexpr std::array<std::int64_t, 6> kDts = {10, 1, 7, 100, 33, 16};
  return std::clamp(kDts[tape.pick(6)], scan.min_ms, scan.max_ms);
}

}  // namespace

std::optional<ReadProgram> read_program(std::string_view dialect,
                                        const std::string& text,
                                        std::string& error) {
  ReadProgram result;
  const FileId file = result.sources.add("random.txt", text);
  DiagnosticList diagnostics;
  const Ast ast = read_script(result.sources, file, dialect, diagnostics);
  result.program = build_program(ast, {}, diagnostics);
  if (!diagnostics.has_errors()) {
    result.properties =
        read_properties(result.program, {}, result.sources, diagnostics);
  }
  for (const Diagnostic& diagnostic : diagnostics.items()) {
    if (diagnostic.severity != Severity::Error) continue;
    error = diagnostic.message;
    return std::nullopt;
  }
  return result;
}

Stimulus random_stimulus(const Program& program, Tape& tape,
                         std::uint64_t scans) {
  Stimulus stimulus;
  std::vector<std::int64_t> sample;
  for (const CellId id : ids_of(program.cells)) {
    if (program.cells[id].role != CellRole::Input) continue;
    stimulus.inputs.push_back(id);
    sample.push_back(program.cells[id].initial);
  }
  for (std::uint64_t done = 0; done < scans;) {
    StimulusStep step;
    step.dt_ms = random_dt(program.scan, tape);
    step.repeat = tape.pick(4) == 3 ? 2 + tape.pick(20) : 1;
    for (std::size_t i = 0; i < sample.size(); ++i) {
      const Cell& cell = program.cells[stimulus.inputs[i]];
      if (tape.pick(3) != 1) continue;  // the input is held
      sample[i] =
          cell.type == Type::Bit ? 1 - sample[i] : random_word(cell, tape);
    }
    step.inputs = sample;
    done += step.repeat;
    stimulus.steps.push_back(std::move(step));
  }
  return stimulus;
}

std::optional<Stimulus> rollover_stimulus(Program& program, Tape& tape,
                                          std::uint64_t scans) {
  constexpr std::int64_t kQuarter = kRolloverMs / 4;
  constexpr std::array<std::int64_t, 6> kSteps = {
      kQuarter, kQuarter - 1, kQuarter + 1, 1, 500, kQuarter};
  if (!use_rollover(program)) return std::nullopt;
  program.scan = {1, kQuarter + 1};
  Stimulus stimulus = random_stimulus(program, tape, scans);
  for (StimulusStep& step : stimulus.steps) {
    step.dt_ms = kSteps[tape.pick(kSteps.size())];
  }
  return stimulus;
}

void set_inputs(const TransitionSystem& ts, const Stimulus& stimulus,
                const StimulusStep& step, TsInterpreter& interpreter) {
  interpreter.set(ts.dt, step.dt_ms);
  for (const VarId id : ids_of(ts.vars)) {
    if (ts.vars[id].role != VarRole::Input) continue;
    const auto at = std::find(stimulus.inputs.begin(), stimulus.inputs.end(),
                              ts.vars[id].cell);
    interpreter.set(
        id,
        step.inputs[static_cast<std::size_t>(at - stimulus.inputs.begin())]);
  }
}

bool faulted(const TransitionSystem& ts, const TsInterpreter& interpreter) {
  return std::any_of(ts.faults.begin(), ts.faults.end(),
                     [&](const Fault& fault) {
                       return interpreter.value(fault.condition) != 0;
                     });
}

}  // namespace rung
