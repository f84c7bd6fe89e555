#include "smt/run.h"

#include <algorithm>
#include <optional>
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

/// In which scans of a run time stands still, and what its inputs are there.
class Freezing {
 public:
  Freezing(const TransitionSystem& ts, const std::vector<VarId>& inputs)
      : ts_(ts), inputs_(inputs) {
    if (!ts.frozen.has_value()) return;
    std::vector<ExprId> roots = {ts.frozen};
    for (const Variable& var : ts.vars) {
      if (var.role == VarRole::Input) {
        roots.push_back(ts.cell_end[var.cell.index()]);
      }
    }
    terms_.emplace(ts, roots);
  }

  /// Does time stand still in this scan? A stretch behind it changes nothing
  /// of that, and when it does, nothing at all.
  bool scan(const RunStep& step) {
    if (!terms_) return false;
    for (std::size_t i = 0; i < inputs_.size(); ++i) {
      terms_->set_input(inputs_[i], step.inputs[i]);
    }
    terms_->scan();
    return terms_->value(ts_.frozen) != 0;
  }
  std::int64_t input(CellId cell) const {
    return terms_->value(ts_.cell_end[cell.index()]);
  }

 private:
  const TransitionSystem& ts_;
  const std::vector<VarId>& inputs_;
  std::optional<Interpreter> terms_;
};

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
  Freezing freezing(ts, run.inputs);
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
    if (freezing.scan(step)) {
      for (const auto& [cell, column] : place) {
        values[column] = freezing.input(cell);
      }
      emit({0, 1});
      continue;
    }
    emit({dt, 1});
    for (const Beat& beat : beats(step.delta, ts.scan)) emit(beat);
  }
  return stimulus;
}

std::uint64_t scans_of(const Stimulus& stimulus) {
  std::uint64_t scans = 0;
  for (const StimulusStep& step : stimulus.steps) scans += step.repeat;
  return scans;
}

void drop_last_scan(Stimulus& stimulus) {
  if (stimulus.steps.empty()) return;
  if (--stimulus.steps.back().repeat == 0) stimulus.steps.pop_back();
}

void cut_to(Stimulus& stimulus, std::uint64_t scans) {
  std::size_t kept = 0;
  while (kept < stimulus.steps.size() && scans > 0) {
    StimulusStep& step = stimulus.steps[kept++];
    step.repeat = std::min(step.repeat, scans);
    scans -= step.repeat;
  }
  stimulus.steps.resize(kept);
}

namespace {

/// Executes the terms of a run, scan by scan.
class Execution {
 public:
  Execution(const Cone& cone, ExprId target, const std::vector<ExprId>& never,
            Stretches stretches)
      : ts_(cone.ts()),
        cone_(cone),
        target_(target),
        never_(never),
        stretches_(stretches),
        terms_(cone.ts(), roots(cone.ts(), target, never)) {}

  /// Does the target hold at the end of the step's scan?
  bool scan(const RunStep& step) {
    for (std::size_t i = 0; i < cone_.inputs().size(); ++i) {
      terms_.set_input(cone_.inputs()[i], step.inputs[i]);
    }
    scan();
    return terms_.value(target_) != 0;
  }
  void stretch(const RunStep& step) {
    if (stretches_ == Stretches::AsOneScan && step.delta > 0) {
      terms_.set_input(ts_.dt, step.delta);
      return scan();
    }
    for (const Beat& beat : beats(step.delta, ts_.scan)) {
      terms_.set_input(ts_.dt, beat.dt_ms);
      for (std::uint64_t i = 0; i < beat.repeat; ++i) scan();
    }
  }
  bool allowed() const { return allowed_; }

 private:
  static std::vector<ExprId> roots(const TransitionSystem& ts, ExprId target,
                                   const std::vector<ExprId>& never) {
    std::vector<ExprId> result = ts.constraints;
    result.insert(result.end(), never.begin(), never.end());
    result.push_back(target);
    return result;
  }

  void scan() {
    terms_.scan();
    for (ExprId constraint : ts_.constraints) {
      allowed_ = allowed_ && terms_.value(constraint) != 0;
    }
    for (ExprId fault : never_) allowed_ = allowed_ && terms_.value(fault) == 0;
  }

  const TransitionSystem& ts_;
  const Cone& cone_;
  ExprId target_;
  const std::vector<ExprId>& never_;
  Stretches stretches_;
  Interpreter terms_;
  bool allowed_ = true;
};

}  // namespace

bool reaches(const Cone& cone, const Run& run, ExprId target,
             const std::vector<ExprId>& never, Stretches stretches) {
  Execution execution(cone, target, never, stretches);
  bool holds = false;
  for (const RunStep& step : run) {
    holds = execution.scan(step);
    execution.stretch(step);
  }
  return holds && execution.allowed();
}

std::uint32_t first_hit(const Cone& cone, const Run& run, ExprId target,
                        const std::vector<ExprId>& never, Stretches stretches) {
  Execution execution(cone, target, never, stretches);
  for (std::uint32_t i = 0; i < run.size() && execution.allowed(); ++i) {
    if (execution.scan(run[i]) && execution.allowed()) return i + 1;
    execution.stretch(run[i]);
  }
  return 0;
}

bool run_terms(const TransitionSystem& ts, const Stimulus& stimulus,
               Interpreter& terms) {
  std::unordered_map<CellId, VarId> inputs;
  for (const VarId id : ids_of(ts.vars)) {
    const Variable& variable = ts.vars[id];
    if (variable.role == VarRole::Input) inputs.emplace(variable.cell, id);
  }
  bool allowed = true;
  for (const StimulusStep& step : stimulus.steps) {
    terms.set_input(ts.dt, step.dt_ms);
    for (std::size_t i = 0; i < stimulus.inputs.size(); ++i) {
      terms.set_input(inputs.at(stimulus.inputs[i]), step.inputs[i]);
    }
    for (std::uint64_t i = 0; i < step.repeat; ++i) {
      terms.scan();
      for (const ExprId constraint : ts.constraints) {
        allowed = allowed && terms.value(constraint) != 0;
      }
    }
  }
  return allowed;
}

}  // namespace rung
