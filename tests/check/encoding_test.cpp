// The checker's own encoding, scan by scan, against the simulator: every kind
// of element, and every form of property against the replay.
//
// RUNG_CHECK_ENCODINGS: how many programs of each sort (1,000 unless set).

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "analysis/property.h"
#include "analysis/simulator.h"
#include "block_programs.h"
#include "check/elements.h"
#include "check/encode_formula.h"
#include "check/encode_property.h"
#include "check/model.h"
#include "program_generator.h"
#include "property_generator.h"
#include "random_run.h"
#include "tests/setting.h"

namespace rung {
namespace {

using check::evaluate;
using check::Model;
using check::StateVariable;
using check::Value;

/// A run of the checker's model.
class ModelRun {
 public:
  explicit ModelRun(const Model& model) : model_(model) {
    for (const StateVariable& state : model.states) {
      states_.push_back(state.initial);
    }
  }

  /// Inputs in the order of the cells, behind dt.
  void scan(const StimulusStep& step) {
    if (!values_.empty()) {
      for (std::size_t i = 0; i < states_.size(); ++i) {
        states_[i] = at(model_.states[i].next);
      }
    }
    std::vector<std::int64_t> inputs = {step.dt_ms};
    inputs.insert(inputs.end(), step.inputs.begin(), step.inputs.end());
    values_ = evaluate(model_.terms(), states_, inputs);
  }
  std::int64_t at(Value value) const { return values_[value.id]; }

  /// Claims about states that are wrong before the scan.
  bool breaks_a_claim() const {
    for (std::size_t i = 0; i < states_.size(); ++i) {
      const StateVariable& state = model_.states[i];
      if (state.low && states_[i] < *state.low) return true;
      if (state.high && states_[i] > *state.high) return true;
    }
    return false;
  }

 private:
  const Model& model_;
  std::vector<std::int64_t> states_;
  std::vector<std::int64_t> values_;
};

bool leaves_range(const Program& program, const Simulator& simulator) {
  for (const CellId id : ids_of(program.cells)) {
    const Cell& cell = program.cells[id];
    const std::int64_t value = simulator.value(id);
    if (value < cell.low || value > cell.high) return true;
  }
  return false;
}

/// The first difference of a run; empty when there is none.
std::string compare_scans(const Program& program, const Stimulus& stimulus,
                          std::uint64_t& scans) {
  Model model;
  const check::ProgramValues values = encode_program(program, model);
  if (!model.unknown_element.empty()) return model.unknown_element;
  check::FormulaEncoder formulas(program, values, model);
  struct Observed {
    InstanceId id;
    bool timer = false;
    Value done;
    Value value;
  };
  std::vector<Observed> observed;
  for (const InstanceId id : ids_of(program.instances)) {
    const Instance& instance = program.instances[id];
    if (instance.kind->done.empty()) continue;
    const bool timer = instance.kind->family == ElementFamily::Timer;
    observed.push_back(
        {id, timer, formulas.value(instance.name + ".q"),
         formulas.value(instance.name + (timer ? ".elapsed" : ".value"))});
  }
  Simulator simulator(program);
  ModelRun run(model);
  for (const StimulusStep& step : stimulus.steps) {
    for (std::size_t i = 0; i < step.inputs.size(); ++i) {
      simulator.set_input(stimulus.inputs[i], step.inputs[i]);
    }
    for (std::uint64_t i = 0; i < step.repeat; ++i) {
      simulator.scan(step.dt_ms);
      run.scan(step);
      if (leaves_range(program, simulator)) return {};
      ++scans;
      const std::string at = "scan " + std::to_string(simulator.scans()) + ": ";
      if (run.breaks_a_claim()) return at + "a range is wrong";
      for (const CellId id : ids_of(program.cells)) {
        if (run.at(values.cells[id.index()]) != simulator.value(id)) {
          return at + program.cells[id].name;
        }
      }
      for (const Observed& one : observed) {
        const std::int64_t seen =
            one.timer ? simulator.elapsed(one.id) : simulator.count(one.id);
        const bool done = simulator.done(one.id);
        if ((run.at(one.done) != 0) != done || run.at(one.value) != seen) {
          return at + program.instances[one.id].name;
        }
      }
    }
  }
  return {};
}

TEST(CheckEncoding, KnowsEveryKindAndOperation) {
  for (const ElementKind& kind : element_kinds()) {
    const check::Kind* const known = check::find_kind(kind.id);
    ASSERT_NE(known, nullptr) << kind.id;
    for (const ElementOperation& operation : kind.operations) {
      const check::Operation* const found =
          check::find_operation(*known, operation.name);
      ASSERT_NE(found, nullptr) << kind.id << " " << operation.name;
      EXPECT_EQ(found->fires, operation.steps()) << operation.name;
    }
    ASSERT_EQ(known->states.size(), kind.states.size()) << kind.id;
    for (std::size_t i = 0; i < kind.states.size(); ++i) {
      EXPECT_EQ(known->states[i].name, kind.states[i].name) << kind.id;
    }
    EXPECT_EQ(known->done != nullptr, !kind.done.empty()) << kind.id;
    EXPECT_EQ(known->value >= 0, !kind.value.empty()) << kind.id;
  }
}

TEST(CheckEncoding, DoesNotKnowWhatIsNotThere) {
  EXPECT_EQ(check::find_kind("ton-of-nobody"), nullptr);
}

TEST(CheckEncoding, BlocksDoWhatTheSimulatorDoes) {
  const std::uint64_t count = setting("RUNG_CHECK_ENCODINGS", 1000);
  std::uint64_t scans = 0;
  for (std::uint64_t seed = 1; seed <= count; ++seed) {
    const std::vector<std::uint32_t> numbers = random_tape(seed, 600);
    Tape tape(numbers);
    const Program program = random_block_program(tape);
    const Stimulus stimulus = random_stimulus(program, tape, 50);
    ASSERT_EQ(compare_scans(program, stimulus, scans), "") << "seed " << seed;
  }
  EXPECT_GT(scans, 20 * count);
}

TEST(CheckEncoding, ScriptsDoWhatTheSimulatorDoes) {
  const std::uint64_t count = setting("RUNG_CHECK_ENCODINGS", 1000);
  std::uint64_t scans = 0;
  for (std::uint64_t seed = 1; seed <= count; ++seed) {
    const std::vector<std::uint32_t> numbers = random_tape(seed, 600);
    Tape tape(numbers);
    const GeneratedProgram generated = generate_program(tape, {});
    std::string error;
    const auto read = read_program(generated.dialect, generated.text, error);
    if (!read) continue;
    const Stimulus stimulus = random_stimulus(read->program, tape, 50);
    ASSERT_EQ(compare_scans(read->program, stimulus, scans), "")
        << "seed " << seed << "\n"
        << generated.text;
  }
  EXPECT_GT(scans, 20 * count);
}

// --- properties --------------------------------------------------------------

struct Decided {
  std::vector<std::uint64_t> first;  // by goal: scan in which it is decided
  bool assumptions_hold = true;
  bool in_range = true;
};

Decided run_goals(const Model& model, const std::vector<check::Goal>& goals,
                  const Program& program, const Stimulus& stimulus) {
  Decided result;
  result.first.resize(goals.size(), 0);
  ModelRun run(model);
  Simulator simulator(program);
  for (const StimulusStep& step : stimulus.steps) {
    for (std::size_t i = 0; i < step.inputs.size(); ++i) {
      simulator.set_input(stimulus.inputs[i], step.inputs[i]);
    }
    for (std::uint64_t i = 0; i < step.repeat; ++i) {
      simulator.scan(step.dt_ms);
      run.scan(step);
      if (leaves_range(program, simulator)) result.in_range = false;
      for (const Value assumption : model.assumptions) {
        if (run.at(assumption) == 0) result.assumptions_hold = false;
      }
      for (std::size_t k = 0; k < goals.size(); ++k) {
        const bool holds = run.at(goals[k].condition) != 0;
        const bool always = goals[k].kind == check::Goal::Kind::Always;
        if (holds == always || result.first[k] != 0) continue;
        result.first[k] = simulator.scans();
      }
    }
  }
  return result;
}

std::string compare_properties(const std::vector<std::uint32_t>& numbers,
                               std::uint64_t& decided) {
  Tape tape(numbers);
  const GeneratedProgram generated = generate_program(tape, {.max_rungs = 4});
  std::string error;
  const auto bare = read_program(generated.dialect, generated.text, error);
  if (!bare) return {};
  std::string text;
  for (int i = 0; i < 4; ++i) {
    text += generate_property(bare->program, tape, PropertyTimes::Long);
  }
  if (tape.pick(2) == 1) text += generate_assumption(bare->program, tape);
  text += generated.text;
  const auto read = read_program(generated.dialect, text, error);
  if (!read) return {};
  Model model;
  const check::ProgramValues values = encode_program(read->program, model);
  std::vector<check::Goal> goals =
      encode_properties(read->program, read->properties, values, model);
  std::erase_if(goals, [](const check::Goal& goal) {
    return goal.kind == check::Goal::Kind::Unknown;
  });
  TransitionSystem ts = build_transition_system(read->program);
  const std::vector<Obligation> obligations =
      make_obligations(read->program, read->properties, ts);
  if (goals.size() != obligations.size()) return "a goal is missing\n" + text;
  const Stimulus stimulus = random_stimulus(read->program, tape, 50);
  const Decided here = run_goals(model, goals, read->program, stimulus);
  if (!here.in_range) return {};
  std::vector<ReplayTarget> targets;
  for (const Obligation& one : obligations) {
    targets.push_back({one.property, one.part});
  }
  const ReplayAll replayed =
      replay_all(read->program, read->properties, targets, stimulus);
  if (replayed.assumptions_hold != here.assumptions_hold) {
    return "the assumptions\n" + text;
  }
  for (std::size_t k = 0; k < goals.size(); ++k) {
    if (here.first[k] != 0) ++decided;
    const bool named = goals[k].name == obligations[k].name &&
                       goals[k].form == obligations[k].kind &&
                       goals[k].text == obligations[k].text;
    if (!named) return goals[k].name + " is called otherwise\n" + text;
    if (here.first[k] == replayed.decided_at[k]) continue;
    return goals[k].name + ": scan " + std::to_string(here.first[k]) +
           ", replayed " + std::to_string(replayed.decided_at[k]) + "\n" + text;
  }
  return {};
}

TEST(CheckEncoding, PropertiesAreDecidedAsByTheReplay) {
  const std::uint64_t count = setting("RUNG_CHECK_ENCODINGS", 1000);
  std::uint64_t decided = 0;
  for (std::uint64_t seed = 1; seed <= count; ++seed) {
    ASSERT_EQ(compare_properties(random_tape(seed, 700), decided), "")
        << "seed " << seed;
  }
  EXPECT_GT(decided, count);
}

}  // namespace
}  // namespace rung
