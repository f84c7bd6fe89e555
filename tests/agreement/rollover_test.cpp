// Timers on a clock of 32 bits: the simulator subtracts readings of millis(),
// the encoding counts modulo 2^32. Scans are so long that clocks roll over.

#include "analysis/rollover.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <vector>

#include "analysis/simulator.h"
#include "comparison.h"
#include "program_generator.h"
#include "random_run.h"
#include "tests/setting.h"

namespace rung {
namespace {

TEST(Rollover, MeansTheSameToSimulatorAndEncoding) {
  const std::uint64_t count = setting("RUNG_AGREEMENT_PROGRAMS", 2000) / 4;
  std::uint64_t programs = 0;
  for (std::uint64_t seed = 1; seed <= count; ++seed) {
    const std::vector<std::uint32_t> numbers = random_tape(seed, 600);
    Tape tape(numbers);
    const GeneratedProgram generated = generate_program(tape, {});
    std::string error;
    auto read = read_program(generated.dialect, generated.text, error);
    if (!read) continue;
    const auto stimulus = rollover_stimulus(read->program, tape, 40);
    if (!stimulus) continue;
    ++programs;
    ASSERT_EQ(
        compare_encoding(
            read->program,
            {read->program, build_transition_system(read->program)}, *stimulus),
        "")
        << "seed " << seed << "\n"
        << generated.text;
  }
  EXPECT_GT(programs, count / 10);
}

TEST(Rollover, ATimerThatNobodyResetsBeginsAnew) {
  std::string error;
  auto read = read_program("yun", "pin3 = T(0, 5, pin4);\n", error);
  ASSERT_TRUE(read) << error;
  ASSERT_TRUE(use_rollover(read->program));
  Simulator simulator(read->program);
  simulator.set_input(find_cell(read->program, "pin4"), 1);
  const CellId out = find_cell(read->program, "pin3");
  const std::vector<std::pair<std::int64_t, int>> expected = {
      {1, 0},                              // it starts
      {5000, 0},                           // `>`, not `>=`
      {1, 1},    {kRolloverMs - 5002, 1},  // the last reading before
      {1, 0},                              // and 0 ms have passed
      {5000, 0}, {1, 1},
  };
  for (const auto& [dt, value] : expected) {
    simulator.scan(dt);
    EXPECT_EQ(simulator.value(out), value) << dt;
  }
}

// At 0 exactly the timer runs, and an event is still to come.
TEST(Rollover, NothingIsSkippedBehindATimeOfZero) {
  std::string error;
  auto read = read_program("yun", "pin3 = T(0, 5, pin4);\n", error);
  ASSERT_TRUE(read) << error;
  ASSERT_TRUE(use_rollover(read->program));
  Simulator simulator(read->program);
  simulator.set_input(find_cell(read->program, "pin4"), 1);
  for (int i = 0; i < 5; ++i) simulator.scan(kRolloverMs / 4);
  EXPECT_EQ(simulator.value(find_cell(read->program, "pin3")), 0);
  EXPECT_LE(simulator.idle_scans(1000), 5U);
}

TEST(Rollover, ChangesNothingElse) {
  for (const std::string_view dialect : {"sim", "yun"}) {
    std::string error;
    auto read = read_program(dialect, "pin3 = C(0, 5, pin4);\n", error);
    if (dialect == "sim") {
      read = read_program(dialect, "Q0 = T(0, 5, I0);\n", error);
    }
    ASSERT_TRUE(read) << error;
    EXPECT_FALSE(use_rollover(read->program));
  }
}

}  // namespace
}  // namespace rung
