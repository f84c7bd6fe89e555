// Random property lines, read in two ways on random runs of random programs:
// by replay(), over the simulator, with jumps; and as the conditions and
// monitors that proofs are about, interpreted scan by scan.
//
// RUNG_AGREEMENT_PROPERTIES: how many programs (2,000 unless set), with four
// lines each. RUNG_AGREEMENT_SEED: the first one.

#include <gtest/gtest.h>

#include <cstdint>
#include <iostream>
#include <string>
#include <vector>

#include "analysis/obligation.h"
#include "analysis/property.h"
#include "analysis/simulator.h"
#include "property_generator.h"
#include "random_run.h"
#include "shrink_tape.h"
#include "tests/setting.h"

namespace rung {
namespace {

struct Outcome {
  bool refused = false;
  std::uint32_t obligations = 0;
  std::uint32_t decided = 0;  // in the run
  std::string text;
  std::string difference;
};

/// When each obligation is decided, by its terms.
ReplayAll interpret(const TransitionSystem& ts,
                    const std::vector<Obligation>& obligations,
                    const Stimulus& stimulus, bool& has_fault) {
  ReplayAll result;
  result.decided_at.resize(obligations.size(), 0);
  result.last_at.resize(obligations.size(), 0);
  TsInterpreter interpreter(ts);
  std::uint64_t scan = 0;
  for (const StimulusStep& step : stimulus.steps) {
    set_inputs(ts, stimulus, step, interpreter);
    for (std::uint64_t i = 0; i < step.repeat; ++i) {
      interpreter.step();
      ++scan;
      has_fault = has_fault || faulted(ts, interpreter);
      for (const ExprId constraint : ts.constraints) {
        if (interpreter.value(constraint) == 0) result.assumptions_hold = false;
      }
      for (std::size_t k = 0; k < obligations.size(); ++k) {
        const bool holds = interpreter.value(obligations[k].condition) != 0;
        const bool decides = holds != (obligations[k].goal == Goal::Invariant);
        if (!decides) continue;
        if (result.decided_at[k] == 0) result.decided_at[k] = scan;
        result.last_at[k] = scan;
      }
    }
  }
  return result;
}

Outcome check(const std::vector<std::uint32_t>& numbers) {
  Tape tape(numbers);
  Outcome outcome;
  const GeneratedProgram generated = generate_program(tape, {.max_rungs = 4});
  std::string error;
  const auto bare = read_program(generated.dialect, generated.text, error);
  outcome.refused = true;
  if (!bare) return outcome;
  outcome.text = generated.text;
  std::string lines;
  for (int i = 0; i < 4; ++i) {
    lines += generate_property(bare->program, tape, PropertyTimes::Long);
  }
  if (tape.pick(2) == 1) lines += generate_assumption(bare->program, tape);
  outcome.text = lines + outcome.text;
  const auto read = read_program(generated.dialect, outcome.text, error);
  outcome.text += "// " + error + "\n";
  if (!read) return outcome;
  outcome.refused = false;

  TransitionSystem ts = build_transition_system(read->program);
  std::vector<Obligation> obligations =
      make_obligations(read->program, read->properties, ts);
  std::vector<ReplayTarget> targets;
  targets.reserve(obligations.size());
  const std::size_t count = obligations.size();
  for (std::size_t i = 0; i < count; ++i) {
    targets.push_back({obligations[i].property, obligations[i].part});
  }
  // What makes them vacuous is asked like a `reach`.
  for (std::size_t i = 0; i < count; ++i) {
    if (!obligations[i].trigger.has_value()) continue;
    targets.push_back({obligations[i].property, obligations[i].part, true});
    Obligation left = obligations[i];
    left.goal = Goal::Reach;
    left.condition = left.trigger;
    left.name += ", left side";
    obligations.push_back(std::move(left));
  }
  const Stimulus stimulus = random_stimulus(read->program, tape, 50);
  bool has_fault = false;
  const ReplayAll expected = interpret(ts, obligations, stimulus, has_fault);
  if (has_fault) return outcome;
  const ReplayAll replayed =
      replay_all(read->program, read->properties, targets, stimulus);
  for (std::size_t k = 0; k < obligations.size(); ++k) {
    ++outcome.obligations;
    if (expected.decided_at[k] != 0) ++outcome.decided;
    // What comes after a violation is not defined.
    const bool to_be_met = obligations[k].goal != Goal::Invariant;
    if (to_be_met && replayed.last_at[k] != expected.last_at[k]) {
      outcome.difference = "the last scan of `" + obligations[k].text + "`";
    }
    if (replayed.decided_at[k] == expected.decided_at[k]) continue;
    outcome.difference =
        "`" + obligations[k].text + "` (" + obligations[k].name +
        ") is decided in scan " + std::to_string(replayed.decided_at[k]) +
        " by the replay and in scan " + std::to_string(expected.decided_at[k]);
  }
  if (replayed.assumptions_hold != expected.assumptions_hold) {
    outcome.difference = "whether the assumptions hold";
  }
  return outcome;
}

TEST(ReplayAgreement, PropertiesAreDecidedInTheSameScan) {
  const std::uint64_t count = setting("RUNG_AGREEMENT_PROPERTIES", 2000);
  const std::uint64_t first = setting("RUNG_AGREEMENT_SEED", 1);
  std::uint64_t refused = 0;
  std::uint64_t obligations = 0;
  std::uint64_t decided = 0;
  for (std::uint64_t seed = first; seed < first + count; ++seed) {
    const std::vector<std::uint32_t> tape = random_tape(seed, 700);
    const Outcome outcome = check(tape);
    refused += outcome.refused ? 1 : 0;
    obligations += outcome.obligations;
    decided += outcome.decided;
    if (outcome.difference.empty()) continue;
    const Outcome smallest =
        check(shrink_tape(tape, [](const std::vector<std::uint32_t>& shorter) {
          return !check(shorter).difference.empty();
        }));
    FAIL() << "seed " << seed << ": " << outcome.difference
           << "\nThe smallest program that differs:\n"
           << smallest.text << smallest.difference;
  }
  std::cout << count << " programs, " << refused << " refused, " << obligations
            << " obligations, " << decided << " decided in their run\n";
  EXPECT_LT(refused * 20, count);
  EXPECT_GT(decided * 5, obligations);
  EXPECT_LT(decided * 5, obligations * 4);
}

}  // namespace
}  // namespace rung
