// Built twice: also over a machine with a fault, in a namespace of its own.
#include "executors.h"
#include "rungproof_machine.h"

namespace rung {

Execution RUNG_RUN_MACHINE(const Case& test) {
  Execution execution;
  const std::string& text = test.job.program;
  const auto* const program =
      reinterpret_cast<const std::uint8_t*>(text.data());
  const auto length = static_cast<std::uint32_t>(text.size());
  std::vector<std::uint32_t> memory(
      rungproof::Machine::memory_words(program, length));
  rungproof::Machine machine;
  execution.refusal = static_cast<unsigned>(
      machine.begin(program, length, memory.data(),
                    static_cast<std::uint32_t>(memory.size())));
  execution.refused_at = machine.refused_at();
  if (execution.refusal != 0) return execution;
  for (const StimulusStep& step : test.stimulus.steps) {
    for (std::uint32_t cell = 0; cell < test.job.cells.size(); ++cell) {
      for (std::size_t i = 0; i < test.stimulus.inputs.size(); ++i) {
        if (test.stimulus.inputs[i] != test.job.cells[cell]) continue;
        machine.set(cell, static_cast<std::int32_t>(step.inputs[i]));
      }
    }
    const bool runs = machine.scan(static_cast<std::uint32_t>(step.dt_ms));
    std::vector<std::int64_t>& values =
        execution.values.emplace_back(test.job.cells.size());
    for (std::uint32_t cell = 0; cell < test.job.cells.size(); ++cell) {
      values[test.job.cells[cell].index()] = machine.value(cell);
    }
    if (runs) continue;
    execution.fault = static_cast<unsigned>(machine.fault());
    execution.fault_scan = 1;
    break;
  }
  return execution;
}

}  // namespace rung
