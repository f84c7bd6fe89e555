// Mutants die: the encoding with one mistake in it differs from the simulator
// on some program, or is listed below with the reason why no program can tell.
//
// Prints what kills each mutant. RUNG_MUTANT_PROGRAMS: random programs to try
// before a mutant is called alive.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <iostream>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "mutant.h"
#include "mutant_runs.h"
#include "random_run.h"
#include "tests/setting.h"

namespace rung {
namespace {

struct Equivalent {
  std::string_view mutant;
  std::string_view reason;
};

constexpr std::string_view kNotStarted =
    "while a timer is not started its elapsed time is 0 already";
constexpr std::string_view kClearedBelow =
    "the last update clears the elapsed time unless it is out and not armed, "
    "and then TOF was armed by the scan before, which had cleared it";
constexpr std::string_view kSlack =
    "bounds may be wider than the values: engines only use more bits";

constexpr std::string_view kAtPreset =
    "where the elapsed time equals the preset both choices are the same";

constexpr std::string_view kFarEnd =
    "no run gets there: a count of 32 bits takes 2^31 edges to its end";

constexpr std::string_view kArmed =
    "a pair of timers that is armed does not look at its clock, and starts it";

constexpr std::string_view kStillOn =
    "a timer whose IN was true in the execution before is timing or over, so "
    "it "
    "does not start again";

constexpr std::array<Equivalent, 44> kEquivalent = {{
    {"ton-esbmc, TON.ET is `elapsed <= p ? elapsed : p`", kAtPreset},
    {"ton-esbmc, TON.ET is `elapsed < (p + 1) ? elapsed : p`", kAtPreset},
    {"ton-matiec, TON.ET is `over ? p : !timing ? 0 : elapsed <= p ? elapsed "
     ": p`",
     kAtPreset},
    {"ton-matiec, TON.ET is `over ? p : !timing ? 0 : elapsed < (p + 1) ? "
     "elapsed : p`",
     kAtPreset},
    {"tof-esbmc, TOF.ET is `elapsed <= p ? elapsed : p`", kAtPreset},
    {"tof-esbmc, TOF.ET is `elapsed < (p + 1) ? elapsed : p`", kAtPreset},
    {"tof-matiec, TOF.ET is `over ? p : !timing ? 0 : elapsed <= p ? elapsed "
     ": p`",
     kAtPreset},
    {"tof-matiec, TOF.ET is `over ? p : !timing ? 0 : elapsed < (p + 1) ? "
     "elapsed : p`",
     kAtPreset},
    {"tp-esbmc, TP.ET is `elapsed <= p ? elapsed : p`", kAtPreset},
    {"tp-esbmc, TP.ET is `elapsed < (p + 1) ? elapsed : p`", kAtPreset},
    {"tp-matiec, TP.ET is `over ? p : !timing ? 0 : elapsed <= p ? elapsed "
     ": p`",
     kAtPreset},
    {"tp-matiec, TP.ET is `over ? p : !timing ? 0 : elapsed < (p + 1) ? "
     "elapsed : p`",
     kAtPreset},
    {"ton-matiec, TON, update 6: prev `prev'`", kStillOn},
    {"tp-matiec, TP, update 6: prev `prev'`", kStillOn},
    {"ton, TON.ET is `elapsed <= p ? elapsed : p`", kAtPreset},
    {"ton, TON.ET is `elapsed < (p + 1) ? elapsed : p`", kAtPreset},
    {"tof, TOF.ET is `elapsed <= p ? elapsed : p`", kAtPreset},
    {"tof, TOF.ET is `elapsed < (p + 1) ? elapsed : p`", kAtPreset},
    {"tp, TP.ET is `elapsed <= p ? elapsed : p`", kAtPreset},
    {"tp, TP.ET is `elapsed < (p + 1) ? elapsed : p`", kAtPreset},
    {"rto-logix, RTO, update 1: ACC `!IN || !EN ? ACC : ACC + lap <= p ? ACC + "
     "lap : p`",
     kAtPreset},
    {"rto-logix, RTO, update 1: ACC `!IN || !EN ? ACC : ACC + lap < (p + 1) ? "
     "ACC + lap : p`",
     kAtPreset},
    {"counter-logix, CTU, update 1: ACC `!IN || !up ? ACC : ACC <= 2147483647 "
     "? ACC + 1 : -2147483648`",
     kFarEnd},
    {"counter-logix, CTU, update 1: ACC `!IN || !up ? ACC : ACC < 2147483648 ? "
     "ACC + 1 : -2147483648`",
     kFarEnd},
    {"counter-logix, CTU, update 1: ACC `!IN || !up ? ACC : ACC < (2147483647 "
     "- 1) ? ACC + 1 : -2147483648`",
     kFarEnd},
    {"counter-logix, CTU, update 1: ACC `!IN || !up ? ACC : ACC < 2147483647 ? "
     "ACC + 1 : 2147483648`",
     kFarEnd},
    {"counter-logix, CTU, update 1: ACC `!IN || !up ? ACC : ACC < 2147483647 ? "
     "ACC + 1 : -2147483649`",
     kFarEnd},
    {"counter-logix, CTU, update 1: ACC `!IN || !up ? ACC : ACC < 2147483647 ? "
     "ACC + 1 : -(2147483648 - 1)`",
     kFarEnd},
    {"counter-logix, CTD, update 1: ACC `!IN || !down ? ACC : ACC >= "
     "-2147483648 ? ACC - 1 : 2147483647`",
     kFarEnd},
    {"counter-logix, CTD, update 1: ACC `!IN || !down ? ACC : ACC > "
     "-2147483649 ? ACC - 1 : 2147483647`",
     kFarEnd},
    {"counter-logix, CTD, update 1: ACC `!IN || !down ? ACC : ACC > "
     "-(2147483648 - 1) ? ACC - 1 : 2147483647`",
     kFarEnd},
    {"counter-logix, CTD, update 1: ACC `!IN || !down ? ACC : ACC > "
     "-2147483648 ? ACC - 1 : 2147483648`",
     kFarEnd},
    {"counter-logix, CTD, update 1: ACC `!IN || !down ? ACC : ACC > "
     "-2147483648 ? ACC - 1 : (2147483647 - 1)`",
     kFarEnd},
    {"timer-yun, T, update 1: elapsed `!v && !started ? 0 : elapsed`",
     kNotStarted},
    {"timer-yun, T, update 1: elapsed `elapsed'`", kNotStarted},
    {"timer-yun-rollover, T, update 2: elapsed "
     "`!v && !started ? 0 : elapsed'`",
     kNotStarted},
    {"timer-yun-rollover, T, update 2: elapsed `elapsed'`", kNotStarted},
    {"timer-off-sim, TOF, update 1: elapsed `v && armed ? 0 : elapsed`",
     kClearedBelow},
    {"timer-off-sim, TOF, update 1: elapsed `!!v && armed ? 0 : elapsed`",
     kClearedBelow},
    {"timer-off-sim, TOF, update 1: elapsed `elapsed'`", kClearedBelow},
    {"cycle-plclib, elapsed runs while `!armed || !turn`", kArmed},
    {"cycle-plclib14, elapsed runs while `!armed || !turn`", kArmed},
    {"the lowest value of counts is one smaller than it was", kSlack},
    {"the highest value of counts is one larger than it was", kSlack},
}};

const Equivalent* find_equivalent(const std::string& name) {
  for (const Equivalent& row : kEquivalent) {
    if (row.mutant == name) return &row;
  }
  return nullptr;
}

/// Where the mutant dies, as the table prints it; empty: it lives.
std::string killed_by(const Mutant& mutant,
                      const std::vector<ProgramRun>& runs) {
  for (const ProgramRun& run : runs) {
    std::optional<Encoding> encoding = mutant.encode(run.read.program);
    if (!encoding) continue;
    const std::string difference =
        compare_encoding(run.read.program, std::move(*encoding), run.stimulus);
    if (!difference.empty()) return run.name + ", " + difference;
  }
  return {};
}

class EncodingMutants : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    runs_ = mutant_runs(setting("RUNG_MUTANT_PROGRAMS", 2000));
  }
  static void TearDownTestSuite() { runs_.clear(); }

  static void expect_dead(const std::vector<Mutant>& mutants) {
    EXPECT_GT(mutants.size(), 50U);
    std::size_t equivalent = 0;
    for (const Mutant& mutant : mutants) {
      const std::string how = killed_by(mutant, runs_);
      const Equivalent* const row = find_equivalent(mutant.name);
      equivalent += row == nullptr ? 0 : 1;
      if (row == nullptr) {
        EXPECT_FALSE(how.empty()) << "alive: " << mutant.name;
      } else {
        EXPECT_TRUE(how.empty())
            << "listed as equivalent, but dies: " << mutant.name << " by "
            << how;
      }
      std::cout << mutant.name << "\n    "
                << (row == nullptr ? how
                                   : "equivalent: " + std::string(row->reason))
                << "\n";
    }
    std::cout << mutants.size() - equivalent << " mutants die, " << equivalent
              << " are equivalent\n";
  }

  static std::vector<ProgramRun> runs_;
};

std::vector<ProgramRun> EncodingMutants::runs_;

TEST_F(EncodingMutants, UnchangedEncodingAgrees) {
  for (const ProgramRun& run : runs_) {
    const Program& program = run.read.program;
    EXPECT_EQ(
        compare_encoding(program, {program, build_transition_system(program)},
                         run.stimulus),
        "")
        << run.name;
  }
}

TEST_F(EncodingMutants, OfElementsDie) { expect_dead(element_mutants()); }
TEST_F(EncodingMutants, OfProgramsDie) { expect_dead(program_mutants()); }
TEST_F(EncodingMutants, OfTransitionSystemsDie) {
  expect_dead(system_mutants());
}

TEST(EncodingMutantsList, NamesMutants) {
  std::vector<Mutant> mutants = element_mutants();
  for (const auto& more : {program_mutants(), system_mutants()}) {
    mutants.insert(mutants.end(), more.begin(), more.end());
  }
  for (const Equivalent& row : kEquivalent) {
    EXPECT_TRUE(std::any_of(
        mutants.begin(), mutants.end(),
        [&row](const Mutant& mutant) { return mutant.name == row.mutant; }))
        << row.mutant;
  }
}

}  // namespace
}  // namespace rung
