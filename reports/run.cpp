#include "reports/run.h"

#include <fmt/format.h>

#include <algorithm>

#include "reports/explain.h"
#include "reports/json_parts.h"
#include "reports/scan_table.h"
#include "reports/unicode.h"

namespace rung {
namespace {

class Expansion {
 public:
  Expansion(const Stimulus& stimulus, const Recording& recording)
      : stimulus_(stimulus), recording_(recording), now_(recording.initial) {}

  Trace expand() {
    for (const StimulusStep& step : stimulus_.steps) expand(step);
    return std::move(trace_);
  }

 private:
  void expand(const StimulusStep& step) {
    std::uint64_t left = step.repeat;
    while (left > 0) {
      const std::uint64_t idle = scans_until_change(step.dt_ms, left);
      if (idle > 0) add(idle, step.dt_ms);
      left -= idle;
      if (left == 0) return;
      for (const auto& change : recording_.samples[next_].changes) {
        now_[change.cell.index()] = change.value;
      }
      ++next_;
      add(1, step.dt_ms);
      --left;
    }
  }

  /// How many of the next `left` scans change nothing.
  std::uint64_t scans_until_change(std::int64_t dt_ms, std::uint64_t left) {
    if (next_ >= recording_.samples.size()) return left;
    const std::int64_t until = recording_.samples[next_].now_ms - time_;
    const auto scans = static_cast<std::uint64_t>(until / dt_ms);
    return scans > left ? left : scans - 1;
  }

  void add(std::uint64_t scans, std::int64_t dt_ms) {
    scan_ += scans;
    time_ += static_cast<std::int64_t>(scans) * dt_ms;
    Trace::Step step;
    step.scan = scan_;
    step.dt_ms = dt_ms;
    step.repeat = scans;
    step.values = now_;
    trace_.steps.push_back(std::move(step));
  }

  const Stimulus& stimulus_;
  const Recording& recording_;
  std::vector<std::int64_t> now_;
  std::size_t next_ = 0;
  std::uint64_t scan_ = 0;
  std::int64_t time_ = 0;
  Trace trace_;
};

/// Inputs, outputs, memory: those that are ever not what they were at first.
std::vector<CellId> moving(const Program& program, const Trace& trace) {
  std::vector<CellId> all;
  std::vector<CellId> shown;
  for (const CellId id : ids_of(program.cells)) {
    all.push_back(id);
    const std::int64_t initial = program.cells[id].initial;
    const bool moves = std::any_of(trace.steps.begin(), trace.steps.end(),
                                   [id, initial](const Trace::Step& step) {
                                     return step.values[id.index()] != initial;
                                   });
    if (moves) shown.push_back(id);
  }
  if (shown.empty()) shown = std::move(all);
  std::stable_sort(shown.begin(), shown.end(), [&](CellId a, CellId b) {
    return program.cells[a].role < program.cells[b].role;
  });
  return shown;
}

}  // namespace

Trace changes_of(const Stimulus& stimulus, const Recording& recording) {
  return Expansion(stimulus, recording).expand();
}

std::string write_text(const RunReport& report, const TextOptions& options) {
  Trace shown = report.trace;
  const std::size_t rows = shown.steps.size();
  if (rows > kMaxRows) shown.steps.resize(kMaxRows);
  const Painter paint(options.colour);
  std::string out = draw_scan_table(
      {report.program, shown, moving(report.program, shown), ""}, paint);
  if (rows > kMaxRows) {
    out += fmt::format(
        "... {} more; --out FILE.vcd and --format json have "
        "all of them\n",
        quantity(rows - kMaxRows, "row"));
  }
  if (options.detail == TextOptions::Detail::Quiet) return out;
  const std::uint64_t scans =
      report.trace.steps.empty() ? 0 : report.trace.steps.back().scan;
  out += fmt::format("ran {}: {} of {}\n", printable(report.path),
                     quantity(scans, "scan"),
                     quantity(report.program.rungs.size(), "rung"));
  if (report.inputs_rest) {
    out += "note: no input changes: --stimulus FILE.csv says what they do\n";
  }
  return out;
}

std::string write_json(const RunReport& report) {
  std::vector<CellId> all;
  for (const CellId id : ids_of(report.program.cells)) all.push_back(id);
  return dump({{"schema", "rungproof.run/1"},
               {"tool", {{"name", "rungproof"}, {"version", report.version}}},
               {"file", report.path},
               {"trace", json_of(report.program, report.trace, all)}});
}

}  // namespace rung
