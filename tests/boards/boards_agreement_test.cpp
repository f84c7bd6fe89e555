// Five executors, one answer: the simulator, the transition system, the machine
// on the host, on both AVR boards and on ARM execute the same programs with the
// same inputs, and all cells are alike at the end of every scan.
//
// RUNG_BOARD_PROGRAMS: how many (200 unless set), those of the corpora first.
// RUNG_BOARD_SEED: the first random one.

#include <gtest/gtest.h>

#include <iostream>

#include "cases.h"
#include "random_run.h"
#include "tests/setting.h"

namespace rung {
namespace {

constexpr std::uint64_t kScans = 40;

// Random programs seldom stop: one that leaves its range in the fourth scan,
// and one that leaves 32 bits in the third.
constexpr const char* kLeavesRange = R"(postfix 1
dialect none
evaluation strict
scan 1..100 ms
output word level in 0..10
rungs
level 3 + =level
)";
constexpr const char* kOverflows = R"(postfix 1
dialect none
evaluation strict
scan 1..100 ms
output word level in -2147483648..2147483647 = 50000
rungs
level 200 * =level
)";

struct Bench {
  Programs programs;
  std::vector<Case> cases;
  std::size_t of_corpora = 0;

  void add_cases(std::size_t from, std::uint64_t most) {
    for (std::size_t i = from; i < programs.items().size(); ++i) {
      Case test;
      if (cases.size() >= most) return;
      if (make_case(programs.items()[i], i + 1, kScans, test)) {
        cases.push_back(std::move(test));
      }
    }
  }
};

void add_random(Bench& bench, std::uint64_t count) {
  const std::uint64_t first = setting("RUNG_BOARD_SEED", 1);
  for (std::uint64_t seed = first; bench.cases.size() < count; ++seed) {
    const std::size_t before = bench.programs.items().size();
    bench.programs.add_random(seed);
    bench.add_cases(before, count);
  }
}

Bench make_bench(std::uint64_t count, bool corpora) {
  Bench bench;
  if (corpora) {
    EXPECT_TRUE(bench.programs.add("leaves its range", kLeavesRange));
    EXPECT_TRUE(bench.programs.add("overflows", kOverflows));
    bench.programs.add_corpus();
    // At least half of them are random.
    bench.add_cases(0, count / 2);
    bench.of_corpora = bench.cases.size();
  }
  add_random(bench, count);
  return bench;
}

/// What a machine's executions make different from those of the first one.
std::vector<std::string> differences(const std::vector<Case>& cases,
                                     const std::vector<Execution>& reference,
                                     const std::vector<Execution>& others) {
  std::vector<std::string> found;
  if (others.size() != cases.size()) found.emplace_back("not all are executed");
  for (std::size_t i = 0; i < std::min(cases.size(), others.size()); ++i) {
    const std::string what =
        difference(*cases[i].program, reference[i], others[i]);
    if (!what.empty()) found.push_back(what + "\n" + cases[i].name);
  }
  return found;
}

std::vector<Execution> run_host(const std::vector<Case>& cases) {
  std::vector<Execution> executions;
  executions.reserve(cases.size());
  for (const Case& test : cases) executions.push_back(run_machine(test));
  return executions;
}

std::size_t scans_of(const std::vector<Execution>& executions) {
  std::size_t scans = 0;
  for (const Execution& execution : executions) {
    scans += execution.values.size();
  }
  return scans;
}

TEST(BoardAgreement, FiveExecutorsGiveOneAnswer) {
  const std::uint64_t count = setting("RUNG_BOARD_PROGRAMS", 200);
  const Bench bench = make_bench(count, true);
  ASSERT_EQ(bench.cases.size(), count);
  const std::vector<Execution> reference = run_host(bench.cases);
  std::size_t system_scans = 0;
  for (std::size_t i = 0; i < bench.cases.size(); ++i) {
    const Case& test = bench.cases[i];
    EXPECT_EQ(reference[i].refusal, 0U) << test.name;
    const Execution simulated = run_simulator(*test.program, test.stimulus);
    EXPECT_EQ(difference_to_simulator(*test.program, simulated, reference[i]),
              "")
        << test.name;
    const Execution system = run_system(*test.program, test.stimulus);
    EXPECT_EQ(difference_before_end(*test.program, simulated, system), "")
        << test.name;
    system_scans += std::min(system.values.size(), simulated.values.size());
  }
  EXPECT_EQ(reference[0].fault, 2U);
  EXPECT_EQ(reference[0].values.size(), 4U);
  EXPECT_EQ(reference[1].fault, 1U);
  EXPECT_EQ(reference[1].values.size(), 3U);
  const std::size_t scans = scans_of(reference);
  EXPECT_GT(scans, count * kScans * 3 / 4);
  EXPECT_GT(system_scans, count * kScans * 3 / 4);
  for (const char* const board : {"uno", "yun", "arm"}) {
    const BoardRun run = run_board(board, "replay", bench.cases);
    EXPECT_EQ(run.problem, "") << board;
    EXPECT_EQ(scans_of(run.executions), scans) << board;
    for (const std::string& what :
         differences(bench.cases, reference, run.executions)) {
      ADD_FAILURE() << board << ": " << what;
    }
  }
  std::cout << count << " programs, " << bench.of_corpora
            << " of them of the corpora; " << scans << " scans, "
            << system_scans << " with the transition system\n";
}

// Each of them in turn takes `&&` for `||`: the comparison says so.
TEST(BoardAgreement, AFaultInEachExecutorIsCaught) {
  const Bench bench = make_bench(20, false);
  const std::vector<Execution> reference = run_host(bench.cases);
  std::size_t simulator = 0;
  std::size_t system = 0;
  std::vector<Execution> faulty;
  for (std::size_t i = 0; i < bench.cases.size(); ++i) {
    const Case& test = bench.cases[i];
    const Program& program = *test.program;
    const Program wrong = with_fault(program);
    const Execution simulated = run_simulator(program, test.stimulus);
    const std::string at_simulator = difference_to_simulator(
        program, run_simulator(wrong, test.stimulus), reference[i]);
    const std::string at_system = difference_before_end(
        program, simulated, run_system(wrong, test.stimulus));
    simulator += at_simulator.empty() ? 0 : 1;
    system += at_system.empty() ? 0 : 1;
    faulty.push_back(run_faulty_machine(test));
  }
  EXPECT_GT(simulator, 3U);
  EXPECT_GT(system, 3U);
  EXPECT_GT(differences(bench.cases, reference, faulty).size(), 3U);
  for (const char* const board : {"uno", "yun", "arm"}) {
    const BoardRun run = run_board(board, "faulty", bench.cases);
    EXPECT_EQ(run.problem, "") << board;
    EXPECT_EQ(differences(bench.cases, faulty, run.executions),
              std::vector<std::string>())
        << board << " has the fault of the machine on the host";
    EXPECT_GT(differences(bench.cases, reference, run.executions).size(), 3U)
        << board;
  }
}

}  // namespace
}  // namespace rung
