#include <fmt/format.h>

#include "analysis/simulator.h"
#include "analysis/stimulus.h"
#include "app/commands.h"
#include "app/output.h"
#include "app/session.h"
#include "app/version.h"
#include "reports/run.h"
#include "reports/vcd.h"

namespace rung {
namespace {

constexpr std::int64_t kDefaultDtMs = 10;
constexpr std::uint64_t kDefaultScans = 10;

/// All inputs at their initial values.
StimulusStep idle(const Program& program, const Stimulus& stimulus) {
  StimulusStep step;
  for (const CellId id : stimulus.inputs) {
    step.inputs.push_back(program.cells[id].initial);
  }
  return step;
}

/// As many scans as --scans says: longer, the last inputs are held; shorter,
/// the rest is left out.
void fit(const Program& program, std::uint64_t scans, std::int64_t dt_ms,
         Stimulus& stimulus) {
  std::uint64_t left = scans;
  std::size_t used = 0;
  while (used < stimulus.steps.size() && left > 0) {
    StimulusStep& step = stimulus.steps[used++];
    step.repeat = std::min(step.repeat, left);
    left -= step.repeat;
  }
  stimulus.steps.resize(used);
  if (left == 0) return;
  StimulusStep rest =
      stimulus.steps.empty() ? idle(program, stimulus) : stimulus.steps.back();
  if (stimulus.steps.empty()) rest.dt_ms = dt_ms;
  rest.repeat = left;
  stimulus.steps.push_back(std::move(rest));
}

/// Without a stimulus every input keeps its initial value, unless the plant
/// writes it.
Stimulus no_stimulus(const Program& program) {
  Stimulus stimulus;
  for (const CellId id : ids_of(program.cells)) {
    const Cell& cell = program.cells[id];
    if (cell.role == CellRole::Input && !cell.plant_written) {
      stimulus.inputs.push_back(id);
    }
  }
  return stimulus;
}

/// The run's inputs; nothing when the stimulus has errors: they are in
/// `report` then.
std::optional<Stimulus> make_stimulus(Session& session, const Program& program,
                                      FileReport& report) {
  const Options& options = session.options();
  const std::int64_t dt_ms = options.dt_ms.value_or(kDefaultDtMs);
  Stimulus stimulus = no_stimulus(program);
  if (!options.stimulus.empty()) {
    const Input input = read_input(options.stimulus, session.sources());
    DiagnosticList errors;
    if (input.error) {
      errors.report(*input.error);
    } else {
      stimulus =
          read_stimulus(program, session.sources(), input.file, dt_ms, errors);
    }
    if (errors.has_errors()) {
      report.findings = errors.take();
      return std::nullopt;
    }
  }
  if (options.scans || stimulus.steps.empty()) {
    fit(program, options.scans.value_or(kDefaultScans), dt_ms, stimulus);
  }
  return stimulus;
}

}  // namespace

int run_simulation(const Options& options) {
  Session session(options);
  if (session.error()) return usage_error(*session.error());
  for (const FormatRequest& request : options.formats) {
    if (request.format != "text" && request.format != "json") {
      return usage_error("run writes the formats text and json, not " +
                         request.format);
    }
  }
  if (session.inputs().size() != 1) {
    return usage_error("run takes one program, and a directory is none");
  }
  Loaded loaded = session.load(session.inputs().front());
  if (!loaded.program) {
    return print_input_errors(session.sources(), loaded.report, options);
  }
  const Program& program = *loaded.program;
  const auto stimulus = make_stimulus(session, program, loaded.report);
  if (!stimulus) {
    return print_input_errors(session.sources(), loaded.report, options);
  }
  const Recording recording = record(program, *stimulus);
  if (!options.output.empty()) {
    const auto error =
        write_file(options.output, write_vcd(program, recording));
    if (error) return output_error(options.output, *error);
  }
  const bool inputs_rest =
      options.stimulus.empty() && !stimulus->inputs.empty();
  return emit(RunReport{loaded.report.path, kVersion, program,
                        changes_of(*stimulus, recording), inputs_rest},
              options);
}

}  // namespace rung
