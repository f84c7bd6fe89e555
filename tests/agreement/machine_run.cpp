#include "machine_run.h"

#include <limits>

#include "backend/postfix/lower.h"

namespace rung {
namespace {

bool fits_32_bits(std::int64_t value) {
  return value >= std::numeric_limits<std::int32_t>::min() &&
         value <= std::numeric_limits<std::int32_t>::max();
}

}  // namespace

MachineRun::MachineRun(const Program& program, std::string& problem)
    : program_(program) {
  DiagnosticList diagnostics;
  const auto lowered = lower_to_postfix_binary(program, diagnostics);
  if (!lowered) {
    problem = "it is not lowered: " + diagnostics.items().front().message;
    return;
  }
  bytes_ = *lowered;
  // The machine's bytes are unsigned; reading a char as one is allowed.
  const auto* const code = reinterpret_cast<const std::uint8_t*>(bytes_.data());
  const auto length = static_cast<std::uint32_t>(bytes_.size());
  memory_.resize(rungproof::Machine::memory_words(code, length));
  const rungproof::Refusal refusal = machine_.begin(
      code, length, memory_.data(), static_cast<std::uint32_t>(memory_.size()));
  if (refusal != rungproof::Refusal::None) {
    problem =
        "the machine refuses it: " + std::to_string(static_cast<int>(refusal));
    return;
  }
  for (const Cell& cell : program.cells) {
    cells_.push_back(machine_.find(cell.name.c_str()));
    if (cells_.back() != machine_.cell_count()) continue;
    problem = "the machine has no " + cell.name;
  }
}

std::string MachineRun::scan(const Stimulus& stimulus, const StimulusStep& step,
                             const Simulator& simulator) {
  if (stopped_) return {};
  for (std::size_t i = 0; i < stimulus.inputs.size(); ++i) {
    const CellId cell = stimulus.inputs[i];
    if (!machine_.set(cells_[cell.index()],
                      static_cast<std::int32_t>(step.inputs[i]))) {
      return "the machine does not take " + program_.cells[cell].name;
    }
  }
  stopped_ = !machine_.scan(static_cast<std::uint32_t>(step.dt_ms));
  if (stopped_) return judge_stop(simulator);
  for (const CellId id : ids_of(program_.cells)) {
    const std::int64_t value = machine_.value(cells_[id.index()]);
    if (value == simulator.value(id)) continue;
    return program_.cells[id].name + " is " +
           std::to_string(simulator.value(id)) + " in the simulator and " +
           std::to_string(value) + " in the machine";
  }
  return {};
}

std::string MachineRun::judge_stop(const Simulator& simulator) const {
  for (const CellId id : ids_of(program_.cells)) {
    const Cell& cell = program_.cells[id];
    const std::int64_t value = simulator.value(id);
    if (value < cell.low || value > cell.high) return {};
  }
  for (std::uint32_t i = 0; i < program_.nodes.size(); ++i) {
    if (!fits_32_bits(simulator.node_value(i))) return {};
  }
  return "the machine stops with fault " +
         std::to_string(static_cast<int>(machine_.fault()));
}

}  // namespace rung
