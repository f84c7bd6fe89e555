// What is said about violations of random programs: the changes of inputs that
// are listed suffice and are needed, and a repair is one, for a search of all
// states too.
//
// RUNG_EXPLAINED: how many violations (30 unless set). RUNG_AGREEMENT_SEED: the
// first program.

#include "analysis/explanation.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <iostream>
#include <map>
#include <string>
#include <vector>

#include "property_generator.h"
#include "random_run.h"
#include "smt/repair.h"
#include "state_search.h"
#include "tests/setting.h"

namespace rung {
namespace {

constexpr std::size_t kMaxStates = 5'000;

using Changes = std::vector<Explanation::InputChange>;

/// A run as long as the trace in which only these inputs change.
Stimulus run_of(const Program& program, const Trace& trace,
                const Changes& changes) {
  Stimulus stimulus = stimulus_of(program, trace);
  std::map<CellId, std::int64_t> now;
  for (const CellId cell : stimulus.inputs) {
    now[cell] = program.cells[cell].initial;
  }
  for (std::size_t i = 0; i < stimulus.steps.size(); ++i) {
    const std::uint64_t first = trace.steps[i].scan - trace.steps[i].repeat + 1;
    for (const Explanation::InputChange& change : changes) {
      if (change.scan == first) now[change.cell] = change.value;
    }
    for (std::size_t j = 0; j < stimulus.inputs.size(); ++j) {
      stimulus.steps[i].inputs[j] = now[stimulus.inputs[j]];
    }
  }
  return stimulus;
}

class Judge {
 public:
  Judge(const ReadProgram& read, const ObligationResult& result)
      : read_(read), result_(result) {}

  bool ends_the_same(const Changes& changes) const {
    const Replay replayed =
        replay(read_.program, read_.properties, result_.obligation.property,
               result_.obligation.part,
               run_of(read_.program, *result_.trace, changes));
    return replayed.assumptions_hold &&
           replayed.decided_at == result_.trace->steps.back().scan;
  }

  /// Only the last change of an input can be undone alone: what changes back
  /// behind it would be no change.
  bool is_last_of_its_input(const Changes& changes, std::size_t which) const {
    for (std::size_t i = which + 1; i < changes.size(); ++i) {
      if (changes[i].cell == changes[which].cell) return false;
    }
    return true;
  }

 private:
  const ReadProgram& read_;
  const ObligationResult& result_;
};

/// By obligation: what the search of all states says; empty: too many.
std::map<std::string, bool> truth(const Program& program,
                                  const PropertySet& properties) {
  TransitionSystem ts = build_transition_system(program);
  const std::vector<Obligation> obligations =
      make_obligations(program, properties, ts);
  std::map<std::string, bool> holds;
  if (obligations.size() > 64) return holds;
  const StateSearch search = search_states(ts, obligations, kMaxStates);
  if (!search.complete) return holds;
  for (std::size_t i = 0; i < obligations.size(); ++i) {
    const bool reach = obligations[i].goal == Goal::Reach;
    holds[obligations[i].name] = (search.decided_at[i] != 0) == reach;
  }
  return holds;
}

std::string random_text(Tape& tape, std::string_view& dialect) {
  const GeneratorOptions small = {
      .max_rungs = 4, .inputs = 3, .words = false, .long_presets = false};
  const GeneratedProgram generated = generate_program(tape, small);
  dialect = generated.dialect;
  std::string error;
  const auto bare = read_program(dialect, generated.text, error);
  if (!bare) return {};
  std::string lines = "//@ scan 10..10 ms\n";
  for (int i = 0; i < 3; ++i) {
    lines += generate_property(bare->program, tape, PropertyTimes::Short);
  }
  return lines + generated.text;
}

TEST(Explanation, InputsSufficeAndRepairsHold) {
  const std::uint64_t wanted = setting("RUNG_EXPLAINED", 30);
  const std::uint64_t first = setting("RUNG_AGREEMENT_SEED", 1);
  std::uint64_t explained = 0;
  std::uint64_t repaired = 0;
  VerifyOptions options;
  options.budget.seconds = 1;
  options.budget.max_depth = 20;
  for (std::uint64_t seed = first; explained < wanted; ++seed) {
    ASSERT_LT(seed - first, 100 + 20 * wanted);
    const std::vector<std::uint32_t> numbers = random_tape(seed, 300);
    Tape tape(numbers);
    std::string_view dialect;
    const std::string text = random_text(tape, dialect);
    std::string error;
    const auto read = read_program(dialect, text, error);
    if (!read) continue;
    const std::map<std::string, bool> before =
        truth(read->program, read->properties);
    if (before.empty()) continue;
    const VerifyReport report =
        verify(read->program, read->properties, options);
    for (const ObligationResult& result : report.results) {
      const bool has_run = result.verdict == Verdict::Violated &&
                           result.trace &&
                           result.obligation.goal == Goal::Invariant;
      if (!has_run) continue;
      SCOPED_TRACE("seed " + std::to_string(seed) + ", " +
                   result.obligation.text + "\n" + text);
      const Explanation why = explain_run(
          read->program, read->properties, result.obligation.property,
          result.obligation.part, *result.trace);
      const Judge judge(*read, result);
      EXPECT_TRUE(judge.ends_the_same(why.needed));
      for (std::size_t i = 0; i < why.needed.size(); ++i) {
        if (!judge.is_last_of_its_input(why.needed, i)) continue;
        Changes fewer = why.needed;
        fewer.erase(fewer.begin() + static_cast<std::ptrdiff_t>(i));
        EXPECT_FALSE(judge.ends_the_same(fewer)) << "change " << i;
      }
      ++explained;
      const auto repair =
          find_repair(read->program, read->properties, report.results, result,
                      result.obligation.property, why.blamed, options, 2);
      if (!repair) continue;
      ++repaired;
      const std::map<std::string, bool> after =
          truth(*repair->program, read->properties);
      if (after.empty()) continue;
      EXPECT_TRUE(after.at(result.obligation.name)) << repair->edit;
      for (const ObligationResult& other : report.results) {
        if (other.verdict != Verdict::Proved) continue;
        EXPECT_TRUE(after.at(other.obligation.name))
            << repair->edit << " loses " << other.obligation.name;
      }
      if (HasFailure()) return;
    }
  }
  std::cout << explained << " violations explained, " << repaired
            << " repaired\n";
  EXPECT_GT(repaired, 0U);
}

}  // namespace
}  // namespace rung
