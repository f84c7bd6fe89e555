#include "smt/run.h"

#include <algorithm>
#include <unordered_map>

#include "smt/interpret.h"

namespace rung {
namespace {

/// Scans of equal length.
struct Beat {
  std::int64_t dt_ms = 1;
  std::uint64_t repeat = 1;
};

/// The scans of a stretch: their number is the least, their lengths differ by
/// one at the most.
std::vector<Beat> beats(std::int64_t delta, const ScanInterval& scan) {
  if (delta <= 0) return {};
  const std::int64_t longest = std::max<std::int64_t>(scan.max_ms, 1);
  const std::int64_t count = (delta + longest - 1) / longest;
  const std::int64_t longer = delta % count;
  std::vector<Beat> result;
  if (longer > 0) {
    result.push_back({delta / count + 1, static_cast<std::uint64_t>(longer)});
  }
  result.push_back({delta / count, static_cast<std::uint64_t>(count - longer)});
  return result;
}

std::int64_t resting(const Variable& var) {
  return std::clamp<std::int64_t>(0, var.low, var.high);
}

}  // namespace

std::uint64_t scan_count(const Run& run, const ScanInterval& scan) {
  std::uint64_t scans = 0;
  for (const RunStep& step : run) {
    ++scans;
    for (const Beat& beat : beats(step.delta, scan)) scans += beat.repeat;
  }
  return scans;
}

Stimulus to_stimulus(const TransitionSystem& ts, const FoundRun& run) {
  Stimulus stimulus;
  std::vector<std::int64_t> values;
  std::unordered_map<CellId, std::size_t> place;
  for (const Variable& var : ts.vars) {
    if (var.role != VarRole::Input || !var.cell.has_value()) continue;
    place[var.cell] = values.size();
    stimulus.inputs.push_back(var.cell);
    values.push_back(resting(var));
  }
  std::int64_t dt = ts.scan.min_ms;
  const auto emit = [&](Beat beat) {
    if (!stimulus.steps.empty()) {
      StimulusStep& last = stimulus.steps.back();
      if (last.dt_ms == beat.dt_ms && last.inputs == values) {
        last.repeat += beat.repeat;
        return;
      }
    }
    stimulus.steps.push_back({beat.dt_ms, beat.repeat, values});
  };
  for (const RunStep& step : run.steps) {
    for (std::size_t i = 0; i < run.inputs.size(); ++i) {
      const Variable& var = ts.vars[run.inputs[i]];
      if (var.role == VarRole::Dt) dt = step.inputs[i];
      if (var.role != VarRole::Input) continue;
      values[place[var.cell]] = step.inputs[i];
    }
    emit({dt, 1});
    for (const Beat& beat : beats(step.delta, ts.scan)) emit(beat);
  }
  return stimulus;
}

bool reaches(const Cone& cone, const Run& run, ExprId target,
             const std::vector<ExprId>& never) {
  const TransitionSystem& ts = cone.ts();
  std::vector<ExprId> roots = ts.constraints;
  roots.push_back(target);
  roots.insert(roots.end(), never.begin(), never.end());
  Interpreter terms(ts, roots);
  bool allowed = true;
  const auto scan = [&] {
    terms.scan();
    for (ExprId constraint : ts.constraints) {
      allowed = allowed && terms.value(constraint) != 0;
    }
    for (ExprId fault : never) allowed = allowed && terms.value(fault) == 0;
  };
  for (const RunStep& step : run) {
    for (std::size_t i = 0; i < cone.inputs().size(); ++i) {
      terms.set_input(cone.inputs()[i], step.inputs[i]);
    }
    scan();
    for (const Beat& beat : beats(step.delta, ts.scan)) {
      terms.set_input(ts.dt, beat.dt_ms);
      for (std::uint64_t i = 0; i < beat.repeat; ++i) scan();
    }
  }
  return allowed && terms.value(target) != 0;
}

}  // namespace rung
