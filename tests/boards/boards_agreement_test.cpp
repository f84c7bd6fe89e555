// Five executors, one answer: the simulator, the transition system, the machine
// on the host, on both AVR boards and on ARM execute the same programs with the
// same inputs, and all cells are alike at the end of every scan.
//
// Every instruction of the format is among them, with short and wide addresses.
//
// RUNG_BOARD_PROGRAMS: how many (200 unless set), those of the corpora first.
// RUNG_BOARD_SEED: the first random one.

#include <gtest/gtest.h>

#include <iostream>
#include <set>

#include "base/postfix_format.h"
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

constexpr const char* kHead =
    "postfix 1\ndialect none\nevaluation strict\nscan 1..100 ms\n";

/// What random scripts do not have: conversions, edges, a long constant, and
/// addresses above 255. Slots of all kinds are among the last.
std::string odd_instructions() {
  std::string text = kHead;
  text += R"(input bit a
input bit b
input word x in -40000..40000
output bit q
output word w in -2147483648..2147483647
)";
  for (int i = 0; i < 256; ++i) {
    text += "element E(" + std::to_string(i) + ") edge\n";
  }
  text += R"(element T(0) timer-yun
element T(1) timer-sim
element TOF(2) timer-off-sim
element C(0) counter-yun
element C(1) counter-sim
element E(300) edge
element E(301) edge
rungs
a RISE(0) b FALL(1) || =q
x to_bit q ^ =q
q to_word 100000 * x + =w
a RISE(300) b FALL(301) || q ^ =q
a T(0,25ms) b TR(0) ^ q ^ =q
a T(1,30ms) b TOF(2,40ms) ^ q ^ =q
a C(0,3) b CR(0) ^ q ^ =q
a b x to_bit C(1,2) q ^ =q
)";
  return text;
}

std::string wide_bits() {
  std::string text = kHead;
  text += "input bit a\n";
  for (int i = 1; i <= 258; ++i) {
    text += "memory bit m" + std::to_string(i) + "\n";
  }
  return text +
         "output bit q\nrungs\na m257 ^ =m258\nm258 ! m1 || =m257\n"
         "m257 m258 && =q\n";
}

std::string wide_words() {
  std::string text = kHead;
  text += "input word x in 0..1000\n";
  for (int i = 1; i <= 258; ++i) {
    text += "memory word m" + std::to_string(i) + " in -5000..5000\n";
  }
  return text +
         "output bit q\nrungs\nx m257 + 2 / =m258\n"
         "m258 neg =m257\nm258 m257 - 500 > =q\n";
}

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
    EXPECT_TRUE(bench.programs.add("odd", odd_instructions()));
    EXPECT_TRUE(bench.programs.add("wide bits", wide_bits()));
    EXPECT_TRUE(bench.programs.add("wide words", wide_words()));
    const std::size_t own = bench.programs.items().size();
    bench.programs.add_corpus();
    // At least half of them are random.
    bench.add_cases(0, count / 2);
    bench.of_corpora = bench.cases.size() - own;
  }
  add_random(bench, count);
  return bench;
}

/// How long the instruction is, without a prefix.
std::size_t instruction_bytes(std::uint8_t opcode, bool wide) {
  using postfix::Opcode;
  const std::size_t address = wide ? 2 : 1;
  if (const auto* const element = postfix::find_element(opcode)) {
    const bool preset = element->preset != postfix::ElementCode::Preset::None;
    return 1 + address + (preset ? 4 : 0);
  }
  switch (static_cast<Opcode>(opcode)) {
    case Opcode::ReadBit:
    case Opcode::WriteBit:
    case Opcode::ReadWord:
    case Opcode::WriteWord:
      return 1 + address;
    case Opcode::Push8:
      return 2;
    case Opcode::SkipFalse:
    case Opcode::SkipTrue:
    case Opcode::Push16:
      return 3;
    case Opcode::Push32:
      return 5;
    default:
      return 1;
  }
}

/// The instructions of a program, those with a wide address plus 256.
void add_instructions(const std::string& program, std::set<int>& found) {
  const auto byte = [&](std::size_t at) {
    return static_cast<std::uint8_t>(program[at]);
  };
  const auto number = [&](std::size_t at) {
    return static_cast<std::size_t>(byte(at) + 256 * byte(at + 1));
  };
  const std::size_t bits = number(postfix::BitsField);
  const std::size_t words = number(postfix::WordsField);
  std::size_t at = postfix::kHeaderBytes + bits + words +
                   words * postfix::kRangeBytes +
                   number(postfix::SlotsField) * postfix::kSlotBytes;
  const std::size_t end = at + number(postfix::CodeField);
  while (at < end) {
    const bool wide = byte(at) == static_cast<int>(postfix::Opcode::Wide);
    if (wide) ++at;
    found.insert(byte(at) + (wide ? 256 : 0));
    at += instruction_bytes(byte(at), wide);
  }
}

std::string missing_instructions(const std::vector<Case>& cases) {
  std::set<int> found;
  for (const Case& test : cases) add_instructions(test.job.program, found);
  std::string missing;
  for (int code = 0; code < 512; ++code) {
    const auto opcode = static_cast<std::uint8_t>(code % 256);
    const bool known = code % 256 <= 0x0a ||
                       (code % 256 >= 0x10 && code % 256 <= 0x25 &&
                        (code % 256 <= 0x1c || code % 256 >= 0x20)) ||
                       postfix::find_element(opcode) != nullptr;
    const bool addressed =
        instruction_bytes(opcode, true) != instruction_bytes(opcode, false);
    if (!known || (code >= 256 && !addressed)) continue;
    if (found.count(code) == 0) missing += std::to_string(code) + " ";
  }
  return missing;
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
  EXPECT_EQ(missing_instructions(bench.cases), "");
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
