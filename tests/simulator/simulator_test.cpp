#include "analysis/simulator.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <limits>
#include <vector>

#include "program_maker.h"

namespace rung {
namespace {

constexpr std::int64_t kHour = 3'600'000;

std::int64_t value_of(const Program& program, const Simulator& simulator,
                      std::string_view name) {
  for (const CellId cell : ids_of(program.cells)) {
    if (program.cells[cell].name == name) return simulator.value(cell);
  }
  ADD_FAILURE() << name;
  return 0;
}

TEST(Simulator, RungsSeeWhatRungsAboveWroteInThisScan) {
  ProgramMaker maker;
  const CellId in = maker.input("in");
  const CellId above = maker.output("above");
  const CellId first = maker.output("first");
  const CellId last = maker.output("last");
  maker.read(last);  // written below: the value of the scan before
  maker.rung(above);
  maker.read(in);
  maker.rung(first);
  maker.read(first);
  maker.rung(last);
  Simulator simulator(maker.program());
  simulator.set_input(in, 5);  // any value but 0 is 1
  simulator.scan(1);
  EXPECT_EQ(simulator.value(last), 1);
  EXPECT_EQ(simulator.value(above), 0);
  simulator.scan(1);
  EXPECT_EQ(simulator.value(above), 1);
  simulator.reset();
  EXPECT_EQ(simulator.value(last), 0);
  EXPECT_EQ(simulator.value(in), 0);
  EXPECT_EQ(simulator.scans(), 0U);
}

TEST(Simulator, BitOperators) {
  struct Case {
    NodeOp op;
    std::string_view table;  // of 00, 01, 10, 11
  };
  const std::vector<Case> cases = {{NodeOp::And, "0001"},
                                   {NodeOp::Or, "0111"},
                                   {NodeOp::Xor, "0110"},
                                   {NodeOp::Not, "1100"}};
  for (const Case& test : cases) {
    ProgramMaker maker;
    const CellId a = maker.input("a");
    const CellId b = maker.input("b");
    const CellId q = maker.output("q");
    const std::uint32_t left = maker.read(a);
    maker.node(test.op, left, maker.read(b));
    maker.rung(q);
    Simulator simulator(maker.program());
    std::string table;
    for (int i = 0; i < 4; ++i) {
      simulator.set_input(a, i / 2);
      simulator.set_input(b, i % 2);
      simulator.scan(1);
      table += simulator.value(q) != 0 ? '1' : '0';
    }
    EXPECT_EQ(table, test.table) << static_cast<int>(test.op);
  }
}

TEST(Simulator, WordOperators) {
  struct Case {
    NodeOp op;
    std::int64_t a;
    std::int64_t b;
    std::int64_t result;
  };
  constexpr std::int64_t kMax = std::numeric_limits<std::int64_t>::max();
  constexpr std::int64_t kMin = std::numeric_limits<std::int64_t>::min();
  const std::vector<Case> cases = {
      {NodeOp::Add, 3, -5, -2},
      {NodeOp::Subtract, 3, -5, 8},
      {NodeOp::Multiply, 3, -5, -15},
      {NodeOp::Divide, 7, 2, 3},
      {NodeOp::Divide, -7, 2, -3},
      {NodeOp::Divide, 7, -2, -3},
      {NodeOp::Negate, 3, 0, -3},
      {NodeOp::Wrap16, 32768, 0, -32768},
      {NodeOp::Wrap16, -32769, 0, 32767},
      {NodeOp::Wrap16, 65536, 0, 0},
      {NodeOp::Equal, 2, 2, 1},
      {NodeOp::Equal, 2, 3, 0},
      {NodeOp::NotEqual, 2, 2, 0},
      {NodeOp::NotEqual, 2, 3, 1},
      {NodeOp::Less, 2, 2, 0},
      {NodeOp::Less, -3, 2, 1},
      {NodeOp::LessEqual, 2, 2, 1},
      {NodeOp::LessEqual, 3, 2, 0},
      {NodeOp::Greater, 2, 2, 0},
      {NodeOp::Greater, 3, 2, 1},
      {NodeOp::GreaterEqual, 2, 2, 1},
      {NodeOp::GreaterEqual, -3, 2, 0},
      {NodeOp::ToBit, -3, 0, 1},
      {NodeOp::ToBit, 0, 0, 0},
      {NodeOp::Add, kMax, 1, kMax},
      {NodeOp::Subtract, kMin, 1, kMin},
      {NodeOp::Multiply, kMin, 2, kMin},
      {NodeOp::Negate, kMin, 0, kMax},
      {NodeOp::Divide, kMin, -1, kMax},
  };
  for (const Case& test : cases) {
    ProgramMaker maker;
    const CellId q = maker.word("q", CellRole::Memory);
    const std::uint32_t a = maker.constant(test.a, Type::Word);
    const std::uint32_t b = maker.constant(test.b, Type::Word);
    maker.node(test.op, a, b, Type::Word);
    maker.rung(q);
    Simulator simulator(maker.program());
    simulator.scan(1);
    EXPECT_EQ(simulator.value(q), test.result)
        << static_cast<int>(test.op) << " " << test.a << " " << test.b;
  }
}

// q = a || C(0,2,b) and q = a && C(0,2,b): skipped, the counter sees no edge.
TEST(Simulator, ShortCircuitDoesNotExecuteTheRightOperand) {
  for (const bool is_or : {true, false}) {
    ProgramMaker maker;
    const CellId a = maker.input("a");
    const CellId b = maker.input("b");
    const CellId q = maker.output("q");
    const std::uint32_t left = maker.read(a);
    const std::uint32_t marker = maker.branch(left, is_or);
    const std::uint32_t in = maker.read(b);
    const std::uint32_t call = maker.call("yun", "C", 0, 2, {in});
    const NodeOp op = is_or ? NodeOp::Or : NodeOp::And;
    const std::uint32_t root = maker.short_circuit(op, marker, call);
    maker.rung(q);
    Simulator simulator(maker.program());
    EXPECT_FALSE(simulator.node_executed(left));
    simulator.set_input(a, is_or ? 1 : 0);
    simulator.set_input(b, 1);
    simulator.scan(1);
    EXPECT_EQ(simulator.value(q), is_or ? 1 : 0);
    EXPECT_EQ(simulator.count(InstanceId(0)), 0);
    EXPECT_TRUE(simulator.node_executed(left));
    EXPECT_FALSE(simulator.node_executed(in));
    EXPECT_FALSE(simulator.node_executed(call));
    EXPECT_TRUE(simulator.node_executed(root));
    EXPECT_EQ(simulator.node_value(root), is_or ? 1 : 0);
    simulator.set_input(a, is_or ? 0 : 1);
    simulator.scan(1);
    EXPECT_EQ(simulator.count(InstanceId(0)), 1);
    EXPECT_TRUE(simulator.node_executed(call));
    EXPECT_EQ(simulator.node_value(in), 1);
    simulator.set_input(a, is_or ? 1 : 0);
    simulator.scan(1);
    EXPECT_EQ(simulator.node_value(in), 0) << "skipped: no power there";
  }
}

/// Q1=(Q1||I1)&&!I0; Q2=T(0,5,Q1); Q3=TOF(3,10,Q2); Q4=TOF(4,1,Q3);
struct PaperExample {
  PaperExample() {
    i0 = maker.input("I0");
    i1 = maker.input("I1");
    const CellId q1 = maker.output("Q1");
    const CellId q2 = maker.output("Q2");
    const CellId q3 = maker.output("Q3");
    const std::uint32_t old = maker.read(q1);
    const std::uint32_t set = maker.node(NodeOp::Or, old, maker.read(i1));
    const std::uint32_t stop = maker.read(i0);
    maker.node(NodeOp::And, set, maker.node(NodeOp::Not, stop));
    maker.rung(q1);
    maker.call("sim", "T", 0, 5000, {maker.read(q1)});
    maker.rung(q2);
    maker.call("sim", "TOF", 3, 10000, {maker.read(q2)});
    maker.rung(q3);
    maker.call("sim", "TOF", 4, 1000, {maker.read(q3)});
    maker.rung(maker.output("Q4"));
  }
  ProgramMaker maker;
  CellId i0;
  CellId i1;
};

/// The time of the scan in which `name` first has `value`.
std::int64_t time_of(const Program& program, const Recording& recording,
                     std::string_view name, std::int64_t value) {
  for (const Recording::Sample& sample : recording.samples) {
    for (const Recording::Change& change : sample.changes) {
      if (program.cells[change.cell].name == name && change.value == value) {
        return sample.now_ms;
      }
    }
  }
  return -1;
}

// Published with it: the on-delay is off by up to 0.062 s, the off-delay by up
// to 0.046 s. A scan of that length is what it takes.
TEST(Simulator, TimerExampleOfTheSimulatorPaper) {
  for (const std::int64_t dt : {1, 7, 25, 46}) {
    PaperExample example;
    const Program& program = example.maker.program();
    Stimulus stimulus;
    stimulus.inputs = {example.i0, example.i1};
    const auto scans = [dt](std::int64_t ms) {
      return static_cast<std::uint64_t>(ms / dt);
    };
    stimulus.steps = {{dt, scans(2000), {0, 0}},
                      {dt, 1, {0, 1}},
                      {dt, scans(9000), {0, 0}},
                      {dt, 1, {1, 0}},
                      {dt, scans(20000), {0, 0}}};
    const Recording recording = record(program, stimulus);
    const auto at = [&](std::string_view name, std::int64_t value) {
      return time_of(program, recording, name, value);
    };
    const std::int64_t on = at("Q1", 1);
    const std::int64_t off = at("Q1", 0);
    EXPECT_GE(at("Q2", 1) - on, 5000);
    EXPECT_LT(at("Q2", 1) - on, 5000 + dt);
    EXPECT_EQ(at("Q3", 1), at("Q2", 1));
    EXPECT_EQ(at("Q4", 1), at("Q2", 1));
    EXPECT_EQ(at("Q2", 0), off);
    EXPECT_GE(at("Q3", 0) - off, 10000);
    EXPECT_LT(at("Q3", 0) - off, 10000 + dt);
    EXPECT_GE(at("Q4", 0) - at("Q3", 0), 1000);
    EXPECT_LT(at("Q4", 0) - at("Q3", 0), 1000 + dt);
  }
}

// An hour timer, a year of it: the runs are jumped over.
TEST(Simulate, LongRunsAreExact) {
  ProgramMaker maker;
  const CellId in = maker.input("in");
  const CellId q = maker.output("q");
  maker.call("sim", "T", 0, kHour, {maker.read(in)});
  maker.rung(q);
  Stimulus stimulus;
  stimulus.inputs = {in};
  stimulus.steps = {{1, 1, {1}},
                    {1, static_cast<std::uint64_t>(kHour) - 1, {1}},
                    {1, 1, {1}},
                    {1, 8760ULL * kHour, {1}},
                    {1, 1, {0}}};
  const Trace trace = simulate(maker.program(), stimulus);
  std::vector<std::int64_t> results;
  for (const Trace::Step& step : trace.steps) {
    results.push_back(step.values[q.index()]);
  }
  EXPECT_EQ(results, (std::vector<std::int64_t>{0, 0, 1, 1, 0}));
  EXPECT_EQ(trace.steps.back().scan, 8761ULL * kHour + 2);
}

TEST(Simulate, TimersThatAreRestartedInEveryScanAreIdle) {
  // T(0) is started by one rung and cleared by the next, T(1) runs.
  ProgramMaker maker;
  const CellId in = maker.input("in");
  maker.call("sim", "T", 0, kHour, {maker.constant(1)});
  maker.rung(maker.output("a"));
  maker.call("sim", "T", 0, kHour, {maker.constant(0)});
  maker.rung(maker.output("b"));
  maker.call("sim", "T", 1, 10 * kHour, {maker.read(in)});
  const CellId c = maker.output("c");
  maker.rung(c);
  Simulator simulator(maker.program());
  simulator.set_input(in, 1);
  EXPECT_EQ(simulator.idle_scans(1), 0U);
  simulator.scan(1);
  EXPECT_EQ(simulator.idle_scans(1), 0U) << "T(1) was started";
  simulator.scan(1);
  EXPECT_EQ(simulator.idle_scans(1), 0U) << "only one scan without a start";
  simulator.scan(1);
  const std::uint64_t idle = simulator.idle_scans(1);
  EXPECT_EQ(idle, static_cast<std::uint64_t>(10 * kHour) - 3);
  simulator.skip(idle, 1);
  EXPECT_EQ(simulator.value(c), 0);
  EXPECT_EQ(simulator.elapsed(InstanceId(0)), 0);
  simulator.scan(1);
  EXPECT_EQ(simulator.value(c), 1);
  EXPECT_EQ(simulator.elapsed(InstanceId(1)), 10 * kHour);
}

TEST(Simulate, OtherStepsOfTimeAreNotIdle) {
  ProgramMaker maker;
  maker.call("sim", "T", 0, kHour, {maker.constant(1)});
  maker.rung(maker.output("a"));
  Simulator simulator(maker.program());
  simulator.scan(1);
  simulator.idle_scans(1);
  simulator.scan(1);
  simulator.idle_scans(1);
  simulator.scan(2);
  EXPECT_EQ(simulator.idle_scans(1), 0U);
}

TEST(Simulate, ACounterThatCountsIsNotIdle) {
  ProgramMaker maker;
  const CellId m = maker.output("m");  // m = !m
  maker.node(NodeOp::Not, maker.read(m));
  maker.rung(m);
  maker.call("yun", "C", 0, 1000, {maker.read(m)});
  const CellId q = maker.output("q");
  maker.rung(q);
  Stimulus stimulus;
  stimulus.steps = {{1, 1998, {}}, {1, 1, {}}};
  const Trace trace = simulate(maker.program(), stimulus);
  EXPECT_EQ(trace.steps[0].values[q.index()], 0);
  EXPECT_EQ(trace.steps[1].values[q.index()], 1);
}

TEST(SimulateChanges, NoValueIsHiddenBetweenTwoSteps) {
  ProgramMaker maker;
  const CellId i0 = maker.input("I0");
  const CellId q0 = maker.output("Q0");
  const std::uint32_t before = maker.read(q0);
  maker.node(NodeOp::Xor, before, maker.read(i0));
  maker.rung(q0);
  const Stimulus stimulus = {{i0}, {{10, 5, {0}}, {10, 2, {1}}, {7, 99, {1}}}};
  const Trace merged = simulate(maker.program(), stimulus);
  ASSERT_EQ(merged.steps.size(), 3U);
  EXPECT_FALSE(merged.steps[0].changes);
  EXPECT_TRUE(merged.steps[1].changes);
  const Trace trace = simulate_changes(maker.program(), stimulus);
  ASSERT_EQ(trace.steps.size(), 3U + 64U);
  EXPECT_EQ(trace.steps[0].repeat, 5U);
  EXPECT_EQ(trace.steps[1].scan, 6U);
  EXPECT_EQ(trace.steps[1].values[q0.index()], 1);
  EXPECT_EQ(trace.steps[2].scan, 7U);
  EXPECT_EQ(trace.steps[2].values[q0.index()], 0);
  EXPECT_FALSE(trace.steps[65].changes);
  EXPECT_TRUE(trace.steps[66].changes);  // the rest, in one
  EXPECT_EQ(trace.steps[66].scan, 106U);
  EXPECT_EQ(trace.steps[66].repeat, 36U);
  EXPECT_EQ(trace.steps[66].values, merged.steps[2].values);
}

TEST(Simulate, StepsOfNoScansDoNothing) {
  ProgramMaker maker;
  const CellId in = maker.input("in");
  const CellId q = maker.output("q");
  maker.read(in);
  maker.rung(q);
  Stimulus stimulus;
  stimulus.inputs = {in};
  stimulus.steps = {{1, 0, {1}}};
  const Trace trace = simulate(maker.program(), stimulus);
  EXPECT_EQ(trace.steps[0].scan, 0U);
  EXPECT_EQ(trace.steps[0].values[q.index()], 0);
}

TEST(Simulator, ValueOfInitialWords) {
  ProgramMaker maker;
  const CellId level = maker.word("level", CellRole::Input);
  maker.program().cells[level].initial = -12;
  Simulator simulator(maker.program());
  EXPECT_EQ(value_of(maker.program(), simulator, "level"), -12);
  EXPECT_EQ(simulator.now_ms(), 0);
  simulator.scan(40);
  EXPECT_EQ(simulator.now_ms(), 40);
}

}  // namespace
}  // namespace rung
