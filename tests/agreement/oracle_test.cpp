// Verdicts on random properties of small random programs, held against a
// search of all their states.
//
// RUNG_ORACLE_PROPERTIES: how many property lines (200 unless set; CI sets
// 2,000). RUNG_AGREEMENT_SEED: the first program.

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <iostream>
#include <string>
#include <vector>

#include "property_generator.h"
#include "random_run.h"
#include "rest_search.h"
#include "shrink_tape.h"
#include "smt/verify.h"
#include "state_search.h"

namespace rung {
namespace {

constexpr int kLines = 4;
constexpr std::size_t kMaxStates = 20'000;

struct Outcome {
  bool searched = false;  // read, and its states are few enough
  std::array<std::uint32_t, 5> verdicts = {};  // by Verdict
  std::uint32_t longer = 0;   // traces that are not the shortest
  std::uint32_t vacuous = 0;  // proved, and not found vacuous in the budget
  std::string text;
  std::string wrong;
};

/// What is wrong with a result, if its verdict or its trace is.
std::string judge(const ObligationResult& result, std::uint64_t decided_at) {
  const bool reach = result.obligation.goal == Goal::Reach;
  const bool decided = decided_at != 0;
  const std::string shortest = std::to_string(decided_at);
  switch (result.verdict) {
    case Verdict::Proved:
      if (reach != decided) return "but the state search says otherwise";
      break;
    case Verdict::Violated:
      if (reach == decided) return "but the state search says otherwise";
      break;
    case Verdict::Bounded:
      if (decided && decided_at <= result.scans) {
        return "for " + std::to_string(result.scans) +
               " scans, but it is decided after " + shortest;
      }
      return {};
    case Verdict::Vacuous:
      return decided ? "but it is decided after " + shortest : "";
    case Verdict::Unknown:
      return {};
  }
  if (decided && result.scans < decided_at) {
    return "after " + std::to_string(result.scans) +
           " scans, but it takes at least " + shortest;
  }
  return {};
}

/// What the lines of a program are.
enum class Lines : std::uint8_t { Any, Recoverable, Settles };

constexpr std::uint32_t kMostScans = 4;  // of a `settles` line

std::string random_line(Tape& tape, Lines what, const Program& program) {
  switch (what) {
    case Lines::Any:
      break;
    case Lines::Recoverable:
      return generate_recoverable(program, tape);
    case Lines::Settles:
      return "//@ settles within " +
             std::to_string(1 + tape.pick(1 + tape.pick(kMostScans))) +
             " scans\n";
  }
  return generate_property(program, tape, PropertyTimes::Short);
}

std::string random_text(Tape& tape, Lines what, std::string_view& dialect) {
  const GeneratorOptions small = {
      .max_rungs = 3, .inputs = 2, .words = false, .long_presets = false};
  const GeneratedProgram generated = generate_program(tape, small);
  dialect = generated.dialect;
  std::string error;
  const auto bare = read_program(dialect, generated.text, error);
  if (!bare) return {};
  std::string lines =
      tape.pick(2) == 0 ? "//@ scan 10..10 ms\n" : "//@ scan 10..11 ms\n";
  if (tape.pick(2) == 1) lines += generate_assumption(bare->program, tape);
  for (int i = 0; i < kLines; ++i) {
    lines += random_line(tape, what, bare->program);
  }
  return lines + generated.text;
}

Outcome check(const std::vector<std::uint32_t>& numbers, Lines what) {
  Tape tape(numbers);
  Outcome outcome;
  std::string_view dialect;
  outcome.text = random_text(tape, what, dialect);
  std::string error;
  const auto read = read_program(dialect, outcome.text, error);
  if (!read) return outcome;
  TransitionSystem ts = build_transition_system(read->program);
  const std::vector<Obligation> obligations =
      make_obligations(read->program, read->properties, ts);
  const StateSearch search = search_states(ts, obligations, kMaxStates);
  if (!search.complete || !search.runs) return outcome;
  outcome.searched = true;

  // An answer that takes longer is no wrong answer.
  VerifyOptions options;
  options.budget.seconds = 1;
  options.budget.max_depth = 40;
  const VerifyReport report = verify(read->program, read->properties, options);
  if (!report.failures.empty()) {
    outcome.wrong = report.failures.front().obligation + ": " +
                    report.failures.front().what;
    return outcome;
  }
  Program stoppable = read->program;  // its terms know that dt may be 0
  stoppable.scan.min_ms = 0;
  TransitionSystem stopped = build_transition_system(stoppable);
  make_obligations(stoppable, read->properties, stopped);
  const std::vector<std::uint64_t> rest =
      search_rest(read->program, stopped, search, kMostScans);
  std::size_t place = 0;  // among the obligations of runs in which time passes
  for (const ObligationResult& result : report.results) {
    const Property& property =
        read->properties.properties[result.obligation.property];
    const bool settles = property.form == Property::Form::Settles;
    const std::size_t i = settles ? place : place++;
    if (i >= obligations.size()) break;
    const std::uint64_t decided_at =
        settles ? rest[static_cast<std::size_t>(property.scans)]
                : search.decided_at[i];
    if (what == Lines::Settles && !settles) continue;
    ++outcome.verdicts[static_cast<std::size_t>(result.verdict)];
    const bool has_trace = result.trace.has_value();
    if (has_trace && result.scans > decided_at) ++outcome.longer;
    if (result.verdict == Verdict::Proved && !settles && !search.triggered[i]) {
      ++outcome.vacuous;
    }
    const std::string wrong = judge(result, decided_at);
    if (wrong.empty()) continue;
    outcome.wrong = "`" + result.obligation.text + "` (" +
                    result.obligation.name + ") is " +
                    std::string(to_string(result.verdict)) + " by " +
                    result.engine + " " + wrong;
  }
  if (place != obligations.size()) outcome.wrong = "a result is missing";
  return outcome;
}

void hold_against_search(Lines what, std::uint64_t lines) {
  const std::uint64_t first = setting("RUNG_AGREEMENT_SEED", 1);
  std::array<std::uint32_t, 5> verdicts = {};
  std::uint32_t longer = 0;
  std::uint32_t vacuous = 0;
  std::uint64_t searched = 0;
  std::uint64_t seed = first;
  for (; searched * kLines < lines; ++seed) {
    ASSERT_LT(seed - first, 100 + lines) << "too few programs can be searched";
    const std::vector<std::uint32_t> tape = random_tape(seed, 300);
    const Outcome outcome = check(tape, what);
    searched += outcome.searched ? 1 : 0;
    longer += outcome.longer;
    vacuous += outcome.vacuous;
    for (std::size_t i = 0; i < verdicts.size(); ++i) {
      verdicts[i] += outcome.verdicts[i];
    }
    if (outcome.wrong.empty()) continue;
    const Outcome smallest =
        check(shrink_tape(
                  tape,
                  [what](const std::vector<std::uint32_t>& shorter) {
                    return !check(shorter, what).wrong.empty();
                  },
                  300),
              what);
    FAIL() << "seed " << seed << ": " << outcome.wrong
           << "\nThe smallest program with a wrong verdict:\n"
           << smallest.text << smallest.wrong;
  }
  std::cout << searched << " of " << seed - first << " programs searched\n";
  for (std::size_t i = 0; i < verdicts.size(); ++i) {
    std::cout << to_string(static_cast<Verdict>(i)) << ": " << verdicts[i]
              << "\n";
  }
  std::cout << "traces that are not the shortest: " << longer
            << "\nproved, and not found vacuous in time: " << vacuous << "\n";
  EXPECT_GT(verdicts[static_cast<std::size_t>(Verdict::Proved)], 0U);
  EXPECT_GT(verdicts[static_cast<std::size_t>(Verdict::Violated)], 0U);
}

TEST(Oracle, NoVerdictIsWrong) {
  hold_against_search(Lines::Any, setting("RUNG_ORACLE_PROPERTIES", 200));
}

TEST(Oracle, NoWayBackIsMissedOrMadeUp) {
  hold_against_search(Lines::Recoverable,
                      setting("RUNG_ORACLE_PROPERTIES", 200));
}

TEST(Oracle, WhatSettlesIsWhatComesToRest) {
  hold_against_search(Lines::Settles, setting("RUNG_ORACLE_PROPERTIES", 200));
}

}  // namespace
}  // namespace rung
