#include <algorithm>
#include <cassert>
#include <unordered_map>
#include <utility>

#include "analysis/property.h"
#include "analysis/replay_formula.h"
#include "analysis/simulator.h"
#include "analysis/simulator_word.h"

namespace rung {
namespace {

enum LatchPart : std::uint32_t {
  Settable,
  Sets,
  Holds,
  Releasable,
  Resets,
  NoSpuriousStart,
};

// `time` ms or more are left of a deadline that is met as long as less than
// `time` have passed: how many scans of dt_ms are certain to be before it.
std::uint64_t scans_before(std::int64_t time, std::int64_t dt_ms) {
  if (dt_ms == 0) return kForever;
  return time <= 0 ? 0 : static_cast<std::uint64_t>((time - 1) / dt_ms);
}

/// One property, followed through a run as docs/properties.md defines it.
class PropertyWatch {
 public:
  PropertyWatch(const Program& program, const ObservationNames& names,
                const Property& property)
      : property_(property) {
    if (property.form == Property::Form::Settles) watch_rest(program);
    for (const std::string& text : property.formulas) {
      if (property.form == Property::Form::Settles) break;  // outputs
      formulas_.emplace_back(program, names, text);
    }
    last_true_.assign(formulas_.size(), -1);
  }

  void start(const Simulator& simulator) {
    for (FormulaWatch& formula : formulas_) formula.start(simulator);
  }
  void begin(const Simulator& simulator) {
    for (FormulaWatch& formula : formulas_) formula.begin(simulator);
  }
  void end(const Simulator& simulator) {
    for (FormulaWatch& formula : formulas_) formula.end(simulator);
    update(simulator);
  }

  /// An invariant part is false, or a part to be reached is there, at the end
  /// of the scan just seen.
  bool decided(std::uint32_t part) const {
    if (property_.form == Property::Form::Latch) return latch_decided(part);
    return decided_;
  }

  /// The left side of an invariant part is true at that scan's end.
  bool triggered(std::uint32_t part, std::int64_t now_ms) const {
    switch (property_.form) {
      case Property::Form::Always:
        return formulas_[0].left_side_holds();
      case Property::Form::Latch:
        return latch_triggered(part);
      case Property::Form::For:
        return holds(0) && now_ms - since_ >= property_.milliseconds;
      case Property::Form::After:
      case Property::Form::OnlyAfter:
        return holds(0);
      case Property::Form::Settles:
        return rested_ > property_.scans;
      case Property::Form::Eventually:
        return formulas_.size() == 1 || holds(1 + part);
      case Property::Form::Never:
      case Property::Form::Reach:
      case Property::Form::Recoverable:
      case Property::Form::Interlock:
        break;
    }
    return true;  // nothing makes it vacuous
  }

  std::uint64_t steady_scans(const Simulator& simulator, std::int64_t dt_ms) {
    std::uint64_t limit = time_limit(simulator, dt_ms);
    for (FormulaWatch& formula : formulas_) {
      limit = std::min(limit, formula.steady_scans(simulator, dt_ms));
    }
    return limit;
  }

  void skip(const Simulator& after, std::uint64_t count) {
    for (FormulaWatch& formula : formulas_) formula.skip(count);
    if (open_scans_ >= 0) open_scans_ += static_cast<std::int64_t>(count);
    if (property_.absent) note_cause(after);
    remember_true(after);
    if (property_.form != Property::Form::Settles) return;
    since_ = after.now_ms();
    if (rested_ > 0) rested_ += static_cast<std::int64_t>(count);
  }

 private:
  bool holds(std::size_t formula) const { return formulas_[formula].holds(); }

  void update(const Simulator& simulator) {
    switch (property_.form) {
      case Property::Form::Always:
        decided_ = !holds(0);
        break;
      case Property::Form::Never:
      case Property::Form::Reach:
      case Property::Form::Recoverable:
      case Property::Form::Eventually:
        decided_ = holds(0);
        break;
      case Property::Form::Interlock:
        decided_ = interlock_broken(simulator);
        remember_true(simulator);
        break;
      case Property::Form::Latch:
        break;
      case Property::Form::After:
        decided_ = property_.absent ? response_early(simulator)
                                    : response_late(simulator);
        break;
      case Property::Form::For:
        decided_ = held_in_vain(simulator);
        break;
      case Property::Form::OnlyAfter:
        preceded_ = preceded_ || holds(1);
        decided_ = holds(0) && !preceded_;
        break;
      case Property::Form::Settles:
        decided_ = unsettled(simulator);
        break;
    }
  }

  void watch_rest(const Program& program) {
    for (const CellId cell : ids_of(program.cells)) {
      const CellRole role = program.cells[cell].role;
      if (role == CellRole::Input) inputs_.push_back({cell, 0});
      if (role == CellRole::Output) outputs_.push_back({cell, 0});
    }
  }

  static bool changes(std::vector<std::pair<CellId, std::int64_t>>& cells,
                      const Simulator& simulator) {
    bool changed = false;
    for (auto& [cell, value] : cells) {
      const std::int64_t now = simulator.value(cell);
      changed = changed || value != now;
      value = now;
    }
    return changed;
  }

  // An output changes behind the N-th scan at rest. Once time stands still it
  // does so for good, and inputs are those of the first such scan; a run in
  // which that is not so shows nothing.
  bool unsettled(const Simulator& simulator) {
    const bool first = simulator.scans() == 1;
    const bool stands_still = !first && simulator.now_ms() == since_;
    since_ = simulator.now_ms();
    const bool new_inputs = changes(inputs_, simulator);
    const bool new_outputs = changes(outputs_, simulator);
    const bool broken = rested_ > 0 && (!stands_still || new_inputs);
    if (broken) rested_ = kNoRest;
    if (rested_ != kNoRest && stands_still) ++rested_;
    return new_outputs && rested_ > property_.scans;
  }

  // Two are true together, or one is less than the gap after another was.
  bool interlock_broken(const Simulator& simulator) const {
    for (std::size_t one = 0; one < formulas_.size(); ++one) {
      if (!holds(one)) continue;
      for (std::size_t other = 0; other < formulas_.size(); ++other) {
        if (other == one) continue;
        if (holds(other)) return true;
        const bool too_early =
            last_true_[other] >= 0 &&
            simulator.now_ms() - last_true_[other] < property_.milliseconds;
        if (too_early) return true;
      }
    }
    return false;
  }

  void remember_true(const Simulator& simulator) {
    if (property_.form != Property::Form::Interlock) return;
    for (std::size_t i = 0; i < formulas_.size(); ++i) {
      if (holds(i)) last_true_[i] = simulator.now_ms();
    }
  }

  // The oldest P that no Q has answered decides: it is late first.
  bool response_late(const Simulator& simulator) {
    if (open_scans_ >= 0) ++open_scans_;
    const bool in_ms = property_.milliseconds >= 0;
    if (open_scans_ >= 0 && in_ms &&
        simulator.now_ms() - since_ > property_.milliseconds) {
      return true;  // a Q now is too late
    }
    if (holds(1)) {
      open_scans_ = -1;
      return false;
    }
    if (open_scans_ < 0 && holds(0)) {
      open_scans_ = 0;
      since_ = simulator.now_ms();
    }
    return !in_ms && open_scans_ >= std::max<std::int64_t>(0, property_.scans);
  }

  // A Q too soon behind the last P.
  bool response_early(const Simulator& simulator) {
    if (open_scans_ >= 0) ++open_scans_;
    note_cause(simulator);
    if (open_scans_ < 0 || !holds(1)) return false;
    return property_.milliseconds >= 0
               ? simulator.now_ms() - since_ < property_.milliseconds
               : open_scans_ < property_.scans;
  }

  void note_cause(const Simulator& simulator) {
    if (!holds(0)) return;
    open_scans_ = 0;
    since_ = simulator.now_ms();
  }

  bool held_in_vain(const Simulator& simulator) {
    if (!holds(0)) {
      open_scans_ = -1;
      return false;
    }
    if (open_scans_ < 0) {
      open_scans_ = 0;
      since_ = simulator.now_ms();
    }
    return simulator.now_ms() - since_ >= property_.milliseconds && !holds(1);
  }

  // Scans in which no deadline of the property passes, its formulas constant.
  std::uint64_t time_limit(const Simulator& simulator,
                           std::int64_t dt_ms) const {
    if (rested_ > 0 && rested_ <= property_.scans) {
      return static_cast<std::uint64_t>(property_.scans - rested_);
    }
    if (open_scans_ < 0 || property_.absent) return kForever;
    const std::int64_t passed = simulator.now_ms() - since_;
    const std::int64_t left =
        saturating_subtract(property_.milliseconds, passed);
    if (property_.form == Property::Form::For) {
      return left <= 0 ? kForever : scans_before(left, dt_ms);
    }
    if (property_.milliseconds < 0) {
      const std::int64_t scans = property_.scans - open_scans_ - 1;
      return scans > 0 ? static_cast<std::uint64_t>(scans) : 0;
    }
    return scans_before(saturating_add(left, 1), dt_ms);
  }

  bool latch_decided(std::uint32_t part) const {
    const bool q = holds(0);
    const bool before = formulas_[0].held_before();
    const bool rises = q && !before;
    const bool set = holds(1);
    const bool reset = holds(2);
    const bool sets = set && (property_.dominant_set || !reset);
    const bool resets = reset && (!property_.dominant_set || !set);
    switch (part) {
      case Settable:
        return rises;
      case Sets:
        return sets && !q;
      case Holds:
        return before && !reset && !q;
      case Releasable:
        return !q;
      case Resets:
        return resets && q;
      case NoSpuriousStart:
        return rises && !set;
      default:
        assert(false && "a latch has six parts");
        return false;
    }
  }

  bool latch_triggered(std::uint32_t part) const {
    const bool set = holds(1);
    const bool reset = holds(2);
    switch (part) {
      case Sets:
        return set && (property_.dominant_set || !reset);
      case Holds:
        return formulas_[0].held_before() && !reset;
      case Releasable:
        return holds(0);
      case Resets:
        return reset && (!property_.dominant_set || !set);
      case NoSpuriousStart:
        return holds(0) && !formulas_[0].held_before();
      default:
        return true;
    }
  }

  const Property& property_;
  std::vector<FormulaWatch> formulas_;
  bool decided_ = false;
  bool preceded_ = false;         // OnlyAfter: P was true
  std::int64_t open_scans_ = -1;  // After: scans since `since_`; -1: none
  std::int64_t since_ = 0;        // After: the open P. For: P true since.
                                  // Settles: the end of the scan before
  static constexpr std::int64_t kNoRest = -1;
  std::int64_t rested_ = 0;  // Settles: scans at rest
  std::vector<std::pair<CellId, std::int64_t>> inputs_;   // Settles: as they
  std::vector<std::pair<CellId, std::int64_t>> outputs_;  // were last
  std::vector<std::int64_t> last_true_;  // Interlock, by formula; -1: never
};

class Replayer {
 public:
  Replayer(const Program& program, const PropertySet& properties,
           const std::vector<ReplayTarget>& targets)
      : simulator_(program), targets_(targets) {
    const ObservationNames names(program);
    std::unordered_map<std::uint32_t, std::uint32_t> watch_of;
    for (const ReplayTarget& target : targets) {
      assert(target.property < properties.properties.size());
      const auto [found, added] = watch_of.emplace(
          target.property, static_cast<std::uint32_t>(watches_.size()));
      if (added) {
        watches_.emplace_back(program, names,
                              properties.properties[target.property]);
      }
      target_watch_.push_back(found->second);
    }
    for (const std::string& text : properties.assumptions) {
      assumptions_.emplace_back(program, names, text);
    }
    result_.decided_at.resize(targets.size(), 0);
    result_.last_at.resize(targets.size(), 0);
    for (PropertyWatch& watch : watches_) watch.start(simulator_);
    for (FormulaWatch& watch : assumptions_) watch.start(simulator_);
  }

  const Simulator& simulator() const { return simulator_; }
  ReplayAll take() { return std::move(result_); }

  void run(const std::vector<CellId>& inputs, const StimulusStep& step) {
    for (std::size_t i = 0; i < inputs.size(); ++i) {
      simulator_.set_input(inputs[i], step.inputs[i]);
    }
    std::uint64_t left = step.repeat;
    while (left > 0) {
      scan(step.dt_ms);
      --left;
      if (left > 0) left -= skip(left, step.dt_ms);
    }
  }

 private:
  void scan(std::int64_t dt_ms) {
    for (PropertyWatch& watch : watches_) watch.begin(simulator_);
    for (FormulaWatch& watch : assumptions_) watch.begin(simulator_);
    simulator_.scan(dt_ms);
    for (PropertyWatch& watch : watches_) watch.end(simulator_);
    for (FormulaWatch& watch : assumptions_) {
      watch.end(simulator_);
      if (!watch.holds()) result_.assumptions_hold = false;
    }
    for (std::size_t i = 0; i < targets_.size(); ++i) {
      if (!is_met(i)) continue;
      std::uint64_t& at = result_.decided_at[i];
      if (at == 0) at = simulator_.scans();
      result_.last_at[i] = simulator_.scans();
    }
  }

  bool is_met(std::size_t i) const {
    const ReplayTarget& target = targets_[i];
    const PropertyWatch& watch = watches_[target_watch_[i]];
    return target.trigger ? watch.triggered(target.part, simulator_.now_ms())
                          : watch.decided(target.part);
  }

  std::uint64_t skip(std::uint64_t count, std::int64_t dt_ms) {
    count = std::min(count, simulator_.idle_scans(dt_ms));
    for (std::size_t i = 0; i < watches_.size() && count > 0; ++i) {
      count = std::min(count, watches_[i].steady_scans(simulator_, dt_ms));
    }
    for (std::size_t i = 0; i < assumptions_.size() && count > 0; ++i) {
      count = std::min(count, assumptions_[i].steady_scans(simulator_, dt_ms));
    }
    if (count == 0) return 0;
    simulator_.skip(count, dt_ms);
    for (PropertyWatch& watch : watches_) watch.skip(simulator_, count);
    for (FormulaWatch& watch : assumptions_) watch.skip(count);
    for (std::size_t i = 0; i < targets_.size(); ++i) {
      if (is_met(i)) result_.last_at[i] = simulator_.scans();
    }
    return count;
  }

  Simulator simulator_;
  const std::vector<ReplayTarget>& targets_;
  std::vector<PropertyWatch> watches_;
  std::vector<std::uint32_t> target_watch_;
  std::vector<FormulaWatch> assumptions_;
  ReplayAll result_;
};

}  // namespace

Replay replay(const Program& program, const PropertySet& properties,
              std::uint32_t property, std::uint32_t part,
              const Stimulus& stimulus) {
  const std::vector<ReplayTarget> targets = {{property, part}};
  Replayer replayer(program, properties, targets);
  Replay result;
  for (const StimulusStep& step : stimulus.steps) {
    replayer.run(stimulus.inputs, step);
    Trace::Step& out = result.trace.steps.emplace_back();
    out.scan = replayer.simulator().scans();
    out.dt_ms = step.dt_ms;
    out.repeat = step.repeat;
    for (const CellId cell : ids_of(program.cells)) {
      out.values.push_back(replayer.simulator().value(cell));
    }
  }
  const ReplayAll all = replayer.take();
  result.decided_at = all.decided_at.front();
  result.last_at = all.last_at.front();
  result.assumptions_hold = all.assumptions_hold;
  return result;
}

ReplayAll replay_all(const Program& program, const PropertySet& properties,
                     const std::vector<ReplayTarget>& targets,
                     const Stimulus& stimulus) {
  Replayer replayer(program, properties, targets);
  for (const StimulusStep& step : stimulus.steps) {
    replayer.run(stimulus.inputs, step);
  }
  return replayer.take();
}

}  // namespace rung
