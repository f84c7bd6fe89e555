// The machine against tables worked by hand from docs/postfix.md section 2.

#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <vector>

#include "tests/postfix/image.h"
#include "tests/postfix/machine_adapter.h"

namespace rung {
namespace {

struct Row {
  std::int64_t dt;
  std::vector<std::int64_t> inputs;
  std::int64_t output;
};

// Inputs are the first cells of the text, the output is the cell `q`.
void expect_rows(const std::string& text, const std::vector<Row>& rows) {
  const Program program = program_of(text);
  MachineRun run(program);
  ASSERT_EQ(run.error(), "") << text;
  const CellId output(run.machine().find("q"));
  int number = 0;
  for (const Row& row : rows) {
    ++number;
    for (std::size_t i = 0; i < row.inputs.size(); ++i) {
      run.set_input(CellId(static_cast<std::uint32_t>(i)), row.inputs[i]);
    }
    ASSERT_TRUE(run.scan(row.dt)) << "scan " << number;
    EXPECT_EQ(run.value(output), row.output) << "scan " << number;
  }
}

constexpr const char* kOneBit = "input bit v\noutput bit q\n";

std::string one_element(const std::string& declaration,
                        const std::string& rung) {
  return postfix_text(kOneBit + declaration + "\n", rung + "\n");
}

// q = x, where x is computed from constants.
std::int64_t word_of(const std::string& expression) {
  const Program program = program_of(postfix_text(
      "output word q in -2147483648..2147483647\n", expression + " =q\n"));
  MachineRun run(program);
  EXPECT_EQ(run.error(), "") << expression;
  EXPECT_TRUE(run.scan(1)) << expression;
  return run.value(CellId(0));
}

rungproof::Fault fault_of(const std::string& expression) {
  const Program program = program_of(postfix_text(
      "output word q in -2147483648..2147483647\n", expression + " =q\n"));
  MachineRun run(program);
  EXPECT_EQ(run.error(), "") << expression;
  EXPECT_FALSE(run.scan(1)) << expression;
  EXPECT_FALSE(run.scan(1)) << "a stopped machine went on: " << expression;
  return run.machine().fault();
}

TEST(PostfixMachine, BitOperators) {
  const std::string cells = "input bit a\ninput bit b\noutput bit q\n";
  const auto table = [&](const char* expression,
                         const std::vector<std::int64_t>& results) {
    expect_rows(postfix_text(cells, std::string(expression) + " =q\n"),
                {{1, {0, 0}, results[0]},
                 {1, {0, 1}, results[1]},
                 {1, {1, 0}, results[2]},
                 {1, {1, 1}, results[3]}});
  };
  table("a b &&", {0, 0, 0, 1});
  table("a b ||", {0, 1, 1, 1});
  table("a b ^", {0, 1, 1, 0});
  table("a ! b &&", {0, 1, 0, 0});
  table("true", {1, 1, 1, 1});
  table("false", {0, 0, 0, 0});
}

TEST(PostfixMachine, RungsSeeWhatStandsAbove) {
  // m is a's value of this scan, q that of the scan before.
  expect_rows(postfix_text("input bit a\noutput bit q\nmemory bit m = 1\n",
                           "m =q\na =m\n"),
              {{1, {0}, 1}, {1, {1}, 0}, {1, {0}, 1}, {1, {0}, 0}});
}

TEST(PostfixMachine, WordOperators) {
  EXPECT_EQ(word_of("2 3 +"), 5);
  EXPECT_EQ(word_of("2 3 -"), -1);
  EXPECT_EQ(word_of("-7 3 *"), -21);
  EXPECT_EQ(word_of("-7 2 /"), -3);
  EXPECT_EQ(word_of("7 -2 /"), -3);
  EXPECT_EQ(word_of("40000 wrap16"), -25536);
  EXPECT_EQ(word_of("-32769 wrap16"), 32767);
  EXPECT_EQ(word_of("32767 wrap16"), 32767);
  EXPECT_EQ(word_of("-5 neg"), 5);
  EXPECT_EQ(word_of("true to_word 4 +"), 5);
  EXPECT_EQ(word_of("7 to_bit to_word"), 1);
  EXPECT_EQ(word_of("0 to_bit to_word"), 0);
  for (const char* literal :
       {"127", "128", "-128", "-129", "32767", "32768", "-32768", "-32769",
        "2147483647", "-2147483648"}) {
    EXPECT_EQ(std::to_string(word_of(literal)), literal);
  }
}

TEST(PostfixMachine, WordsReachTheirEnds) {
  EXPECT_EQ(word_of("2147483646 1 +"), 2147483647);
  EXPECT_EQ(word_of("-2147483647 1 -"), -2147483648LL);
  EXPECT_EQ(word_of("-1 -2147483648 -"), 2147483647);
  EXPECT_EQ(word_of("-65536 32768 *"), -2147483648LL);
  EXPECT_EQ(word_of("0 -2147483648 *"), 0);
  EXPECT_EQ(word_of("-2147483648 1 *"), -2147483648LL);
  EXPECT_EQ(word_of("2147483647 neg"), -2147483647);
  EXPECT_EQ(word_of("-2147483648 -2147483648 -"), 0);
}

TEST(PostfixMachine, StopsWhereAWordWouldLeave32Bits) {
  for (const char* expression :
       {"2147483647 1 +", "-2147483648 1 -", "0 -2147483648 -", "65536 32768 *",
        "-65536 -32768 *", "-2147483648 -1 *", "-2147483648 -1 /",
        "-2147483648 neg", "-2147483648 -1 +"}) {
    EXPECT_EQ(fault_of(expression), rungproof::Fault::Overflow) << expression;
  }
}

TEST(PostfixMachine, StopsWhereACellWouldLeaveItsRange) {
  const Program program = program_of(postfix_text(
      "memory word w in -3..3 = 2\noutput bit q\n", "w 1 + =w\ntrue =q\n"));
  MachineRun run(program);
  ASSERT_EQ(run.error(), "");
  EXPECT_TRUE(run.scan(1));
  EXPECT_FALSE(run.scan(1));
  EXPECT_EQ(run.machine().fault(), rungproof::Fault::Range);
  EXPECT_EQ(run.value(CellId(0)), 3);
  run.reset();
  EXPECT_EQ(run.machine().fault(), rungproof::Fault::None);
  EXPECT_EQ(run.value(CellId(0)), 2);
  EXPECT_EQ(run.value(CellId(1)), 0);
  EXPECT_TRUE(run.scan(1));
}

TEST(PostfixMachine, Comparisons) {
  const auto table = [](const char* token,
                        const std::vector<std::int64_t>& results) {
    expect_rows(postfix_text("output bit q\ninput word a in -9..9\n",
                             std::string("a 3 ") + token + " =q\n"),
                {});
    const Program program =
        program_of(postfix_text("output bit q\ninput word a in -9..9\n",
                                std::string("a 3 ") + token + " =q\n"));
    MachineRun run(program);
    for (int i = 0; i < 3; ++i) {
      run.set_input(CellId(1), 2 + i);
      ASSERT_TRUE(run.scan(1));
      EXPECT_EQ(run.value(CellId(0)), results[static_cast<std::size_t>(i)])
          << token << i;
    }
  };
  table("==", {0, 1, 0});
  table("!=", {1, 0, 1});
  table("<", {1, 0, 0});
  table("<=", {1, 1, 0});
  table(">", {0, 0, 1});
  table(">=", {0, 1, 1});
}

TEST(PostfixMachine, TimerYun) {
  expect_rows(one_element("element T(0) timer-yun", "v T(0,20ms) =q"),
              {{10, {0}, 0},
               {10, {1}, 0},  // starts; elapsed 0
               {20, {1}, 0},  // 20 is not past 20
               {1, {1}, 1},
               {1, {0}, 0},    // false with its input, and runs on
               {1, {1}, 1}});  // so a second activation has no delay
  const std::string reset = postfix_text(
      "input bit v\ninput bit r\noutput bit q\nmemory bit m\n"
      "element T(7) timer-yun\n",
      "r TR(7) =m\nv T(7,20ms) =q\n");
  expect_rows(reset, {{1, {1, 0}, 0},
                      {21, {1, 0}, 1},
                      {1, {0, 1}, 0},
                      {50, {1, 0}, 0},  // starts anew
                      {21, {1, 0}, 1}});
  expect_rows(one_element("element T(0) timer-yun", "v T(0,-1ms) =q"),
              {{1, {0}, 0}, {1, {1}, 1}});
}

TEST(PostfixMachine, TimerSim) {
  expect_rows(one_element("element T(0) timer-sim", "v T(0,20ms) =q"),
              {{10, {0}, 0},
               {10, {1}, 0},
               {19, {1}, 0},
               {1, {1}, 1},  // 20 reaches 20
               {1, {0}, 0},
               {50, {1}, 0},
               {20, {1}, 1}});
  expect_rows(one_element("element T(0) timer-sim", "v T(0,0ms) =q"),
              {{1, {0}, 1}, {1, {1}, 1}});
}

TEST(PostfixMachine, OffDelaySim) {
  expect_rows(one_element("element TOF(0) timer-off-sim", "v TOF(0,20ms) =q"),
              {{30, {0}, 0},
               {1, {1}, 1},
               {99, {1}, 1},
               {1, {0}, 1},  // its time begins
               {19, {0}, 1},
               {1, {0}, 0},
               {1, {1}, 1},
               {1, {0}, 1},
               {5, {1}, 1},
               {5, {0}, 1},  // begins anew
               {19, {0}, 1},
               {1, {0}, 0}});
}

TEST(PostfixMachine, CounterYun) {
  const std::string text = postfix_text(
      "input bit v\ninput bit r\noutput bit q\nmemory bit m\n"
      "element C(0) counter-yun\n",
      "v C(0,2) =q\nr CR(0) =m\n");
  expect_rows(text, {{1, {1, 0}, 0},
                     {1, {1, 0}, 0},  // no second edge
                     {1, {0, 0}, 0},
                     {1, {1, 0}, 1},
                     {1, {0, 0}, 1},
                     {1, {1, 1}, 1},  // at its preset; then cleared
                     {1, {1, 0}, 0},  // held input: not counted again
                     {1, {0, 0}, 0},
                     {1, {1, 0}, 0},
                     {1, {0, 0}, 0},
                     {1, {1, 0}, 1}});
}

// It counts up to the preset of the call that counts, no further.
TEST(PostfixMachine, CounterYunOfTwoPresets) {
  const std::string text = postfix_text(
      "input bit a\ninput bit b\noutput bit q\nmemory bit m\n"
      "element C(0) counter-yun\n",
      "a C(0,1) =m\nb C(0,2) =q\n");
  expect_rows(text, {{1, {1, 0}, 0}, {1, {1, 0}, 0}, {1, {0, 1}, 1}});
}

TEST(PostfixMachine, CounterSim) {
  const std::string text = postfix_text(
      "input bit up\ninput bit down\ninput bit reset\noutput bit q\n"
      "element C(0) counter-sim\n",
      "up down reset C(0,2) =q\n");
  expect_rows(text, {{1, {1, 0, 0}, 0},
                     {1, {0, 0, 0}, 0},
                     {1, {1, 0, 0}, 1},
                     {1, {1, 0, 1}, 0},
                     {1, {1, 0, 0}, 0},  // held through reset: counted again
                     {1, {0, 0, 0}, 0},
                     {1, {1, 0, 0}, 1},
                     {1, {0, 0, 0}, 1},
                     {1, {1, 0, 0}, 0},  // 3 is past 2, not at it
                     {1, {0, 1, 0}, 1},
                     {1, {0, 0, 0}, 1},
                     {1, {1, 1, 0}, 1}});  // up and down
}

// Preset 0: above 50 * 0 the value is set to 1, so it never grows.
TEST(PostfixMachine, CounterSimIsBroughtBackAboveFiftyPresets) {
  const std::string text = postfix_text(
      "input bit up\ninput bit down\noutput bit q\n"
      "element C(0) counter-sim\n",
      "up down false C(0,0) =q\n");
  expect_rows(text, {{1, {0, 0}, 1},
                     {1, {1, 0}, 0},
                     {1, {0, 0}, 0},
                     {1, {1, 0}, 0},
                     {1, {0, 1}, 1}});  // from 1, not from 2
}

TEST(PostfixMachine, Edges) {
  expect_rows(one_element("element E(0) edge", "v RISE(0) =q"),
              {{1, {1}, 1}, {1, {1}, 0}, {1, {0}, 0}, {1, {1}, 1}});
  expect_rows(one_element("element E(0) edge", "v FALL(0) =q"),
              {{1, {0}, 0}, {1, {1}, 0}, {1, {0}, 1}, {1, {0}, 0}});
}

TEST(PostfixMachine, ShortCircuitSkipsTheElement) {
  const std::string cells =
      "input bit a\ninput bit v\noutput bit q\nelement E(0) edge\n";
  const std::string rung = "a v RISE(0) && =q\n";
  // v rises while a is false: strict evaluation sees it, and has seen it.
  expect_rows(postfix_text(cells, rung),
              {{1, {0, 1}, 0}, {1, {1, 1}, 0}, {1, {1, 0}, 0}});
  expect_rows(postfix_text(cells, rung, "short-circuit"),
              {{1, {0, 1}, 0}, {1, {1, 1}, 1}, {1, {1, 1}, 0}});
  expect_rows(postfix_text(cells, "a v RISE(0) || =q\n", "short-circuit"),
              {{1, {1, 1}, 1}, {1, {0, 1}, 1}, {1, {0, 1}, 0}, {1, {1, 0}, 1}});
  // Two skips that land at one place, and one inside the other.
  expect_rows(postfix_text(cells, "a a v RISE(0) && || =q\n", "short-circuit"),
              {{1, {1, 1}, 1}, {1, {0, 1}, 0}});
  expect_rows(
      postfix_text(cells, "a a ! v RISE(0) && || =q\n", "short-circuit"),
      {{1, {1, 1}, 1}, {1, {0, 1}, 1}, {1, {0, 1}, 0}});
}

// Elapsed times stop at 2^32 - 1 and never start again.
TEST(PostfixMachine, TimesDoNotRollOver) {
  const Program program = program_of(
      one_element("element T(0) timer-yun", "v T(0,2147483647ms) =q"));
  MachineRun run(program);
  ASSERT_EQ(run.error(), "");
  run.set_input(CellId(0), 1);
  ASSERT_TRUE(run.scan(1));
  for (int i = 0; i < 10; ++i) {
    ASSERT_TRUE(run.scan(0x7fffffff));
    EXPECT_EQ(run.value(CellId(1)), i >= 1 ? 1 : 0) << i;
  }
}

TEST(PostfixMachine, SaysWhenAScanLeavesItsInterval) {
  const Program program =
      program_of(postfix_text("output bit q\n", "true =q\n"));
  MachineRun run(program);
  EXPECT_EQ(run.machine().scan_min_ms(), 1U);
  EXPECT_EQ(run.machine().scan_max_ms(), 100U);
  EXPECT_TRUE(run.scan(1));
  EXPECT_TRUE(run.scan(100));
  EXPECT_TRUE(run.machine().interval_held());
  EXPECT_TRUE(run.scan(101));
  EXPECT_FALSE(run.machine().interval_held());
  run.reset();
  EXPECT_TRUE(run.machine().interval_held());
  EXPECT_TRUE(run.scan(0));
  EXPECT_FALSE(run.machine().interval_held());
}

TEST(PostfixMachine, OnlyInputsAreSetAndInTheirRange) {
  const Program program = program_of(postfix_text(
      "input bit a\noutput bit q\ninput word w in 0..1023 = 5\n", "a =q\n"));
  MachineRun run(program);
  rungproof::Machine& machine = run.machine();
  EXPECT_EQ(machine.value(2), 5);
  EXPECT_TRUE(machine.set(2, 1023));
  EXPECT_FALSE(machine.set(2, 1024));
  EXPECT_EQ(machine.value(2), 1023);
  EXPECT_FALSE(machine.set(2, -1));
  EXPECT_EQ(machine.value(2), 0);
  EXPECT_TRUE(machine.set(0, 7));
  EXPECT_EQ(machine.value(0), 1);
  EXPECT_FALSE(machine.set(1, 1));
  EXPECT_EQ(machine.value(1), 0);
  EXPECT_FALSE(machine.set(3, 1));
  EXPECT_EQ(machine.value(3), 0);
}

TEST(PostfixMachine, FindsCellsByName) {
  const Program program = program_of(postfix_text(
      "input bit a\noutput bit \"a b\"\nmemory word ab in 0..9\n", ""));
  MachineRun run(program);
  const rungproof::Machine& machine = run.machine();
  EXPECT_EQ(machine.cell_count(), 3U);
  EXPECT_EQ(machine.bit_count(), 2U);
  EXPECT_EQ(machine.find("a"), 0U);
  EXPECT_EQ(machine.find("a b"), 1U);
  EXPECT_EQ(machine.find("ab"), 2U);
  EXPECT_EQ(machine.find(""), 3U);
  EXPECT_EQ(machine.find("abc"), 3U);
  EXPECT_EQ(machine.role(0), rungproof::Role::Input);
  EXPECT_EQ(machine.role(1), rungproof::Role::Output);
  EXPECT_EQ(machine.role(2), rungproof::Role::Memory);
  char buffer[2] = {'x', 'x'};
  EXPECT_EQ(machine.name(1, buffer, 2), 3);
  EXPECT_EQ(std::string(buffer, 2), "a ");
  EXPECT_EQ(machine.name(3, buffer, 2), 0);
}

// 300 bits: addresses above 255 take the wide form.
TEST(PostfixMachine, WideAddresses) {
  std::string cells = "input bit v\n";
  std::string rungs = "v =b0\n";
  for (int i = 0; i < 300; ++i) {
    cells += "memory bit b" + std::to_string(i) + "\n";
    if (i > 0) {
      rungs += "b" + std::to_string(i - 1) + " RISE(" + std::to_string(i) +
               ") =b" + std::to_string(i) + "\n";
    }
  }
  for (int i = 0; i < 300; ++i) {
    cells += "element E(" + std::to_string(i) + ") edge\n";
  }
  cells += "output bit q\n";
  expect_rows(postfix_text(cells, rungs + "b299 =q\n"),
              {{1, {1}, 1}, {1, {1}, 0}, {1, {0}, 0}, {1, {1}, 1}});
}

}  // namespace
}  // namespace rung
