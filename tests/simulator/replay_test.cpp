// What docs/properties.md says "exactly", on runs written out by hand: a
// program that copies inputs to P and Q, so a run is two rows of digits.

#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "analysis/loop_replay.h"
#include "analysis/property.h"
#include "analysis/simulator.h"
#include "program_maker.h"

namespace rung {
namespace {

using Form = Property::Form;

struct Signals {
  Signals() {
    for (const std::string_view name : {"P", "Q", "R"}) {
      inputs.push_back(maker.input("i" + std::string(name)));
      cells.push_back(maker.output(std::string(name)));
      maker.read(inputs.back());
      maker.rung(cells.back());
    }
  }
  ProgramMaker maker;
  std::vector<CellId> inputs;
  std::vector<CellId> cells;
};

Property property_of(Form form, std::vector<std::string> formulas) {
  Property property;
  property.form = form;
  property.formulas = std::move(formulas);
  return property;
}

/// Rows of digits, one a signal, one digit a scan of `dt` ms.
Stimulus run_of(const Signals& signals, const std::vector<std::string>& rows,
                std::int64_t dt) {
  Stimulus stimulus;
  stimulus.inputs = signals.inputs;
  for (std::size_t i = 0; i < rows.front().size(); ++i) {
    StimulusStep step{dt, 1, {0, 0, 0}};
    for (std::size_t k = 0; k < rows.size(); ++k) {
      step.inputs[k] = rows[k][i] - '0';
    }
    stimulus.steps.push_back(step);
  }
  return stimulus;
}

std::uint64_t decided(const Property& property,
                      const std::vector<std::string>& rows,
                      std::int64_t dt = 10, std::uint32_t part = 0) {
  Signals signals;
  PropertySet set;
  set.properties = {property};
  return replay(signals.maker.program(), set, 0, part,
                run_of(signals, rows, dt))
      .decided_at;
}

TEST(Replay, AlwaysNeverAndReach) {
  EXPECT_EQ(decided(property_of(Form::Always, {"P"}), {"1101"}), 3U);
  EXPECT_EQ(decided(property_of(Form::Always, {"P"}), {"111"}), 0U);
  EXPECT_EQ(decided(property_of(Form::Never, {"P && Q"}), {"0111", "1001"}),
            4U);
  EXPECT_EQ(decided(property_of(Form::Reach, {"P"}), {"001"}), 3U);
  EXPECT_EQ(decided(property_of(Form::Reach, {"P"}), {"000"}), 0U);
}

TEST(Replay, Operators) {
  const auto reach = [](const std::string& formula) {
    return decided(property_of(Form::Reach, {formula}),
                   {"0011", "0101", "0000"});
  };
  EXPECT_EQ(reach("P && Q"), 4U);
  EXPECT_EQ(reach("P || Q"), 2U);
  EXPECT_EQ(reach("P ^ Q"), 2U);
  EXPECT_EQ(reach("!(P -> Q)"), 3U);
  EXPECT_EQ(reach("!(P <-> Q)"), 2U);
  EXPECT_EQ(reach("P ? Q : R"), 4U);
  EXPECT_EQ(reach("NOT P AND Q"), 2U);
  EXPECT_EQ(reach("1 + 2 * 3 == 7 && 2 - 3 < 0 && -1 <= -1"), 1U);
  EXPECT_EQ(reach("3 > 3 || 3 != 3 || 2 >= 3"), 0U);
}

TEST(Replay, ValuesOfTheScanBefore) {
  const auto reach = [](const std::string& formula, const std::string& row) {
    return decided(property_of(Form::Reach, {formula}), {row});
  };
  EXPECT_EQ(reach("prev(P)", "0100"), 3U);
  EXPECT_EQ(reach("prev(prev(P))", "0100"), 4U);
  EXPECT_EQ(reach("begin(P)", "0100"), 3U);   // written in the scan
  EXPECT_EQ(reach("begin(iP)", "0100"), 2U);  // sampled before it
  EXPECT_EQ(reach("rose(P)", "1"), 1U);
  EXPECT_EQ(reach("fell(P)", "0110"), 4U);
  EXPECT_EQ(reach("once(P) && !P", "0010"), 4U);
  EXPECT_EQ(reach("prev(!P)", "1"), 1U) << "before the first scan P is false";
}

TEST(Replay, InterlockWithAGap) {
  Property property = property_of(Form::Interlock, {"P", "Q", "R"});
  EXPECT_EQ(decided(property, {"100", "010", "001"}), 0U);
  EXPECT_EQ(decided(property, {"000", "011", "001"}), 3U);
  property.milliseconds = 20;
  EXPECT_EQ(decided(property, {"1000", "0001", "0000"}), 0U);
  EXPECT_EQ(decided(property, {"1000", "0000", "0011"}), 0U);
  EXPECT_EQ(decided(property, {"1000", "0100", "0000"}), 2U);
  EXPECT_EQ(decided(property, {"1100", "0010", "0000"}), 3U);
  EXPECT_EQ(decided(property, {"1011", "0000", "0000"}), 0U)
      << "a signal needs no gap to itself";
}

TEST(Replay, ResponseWithinScans) {
  Property property = property_of(Form::After, {"P", "Q"});
  property.scans = 2;
  EXPECT_EQ(decided(property, {"10000", "00100"}), 0U);
  EXPECT_EQ(decided(property, {"10000", "00010"}), 3U);
  EXPECT_EQ(decided(property, {"11000", "01000"}), 0U);
  EXPECT_EQ(decided(property, {"10100", "00100"}), 0U);
  EXPECT_EQ(decided(property, {"11000", "00000"}), 3U) << "the oldest decides";
  property.scans = 0;
  EXPECT_EQ(decided(property, {"01", "00"}), 2U);
  EXPECT_EQ(decided(property, {"01", "01"}), 0U);
}

TEST(Replay, ResponseWithinTime) {
  Property property = property_of(Form::After, {"P", "Q"});
  property.milliseconds = 20;
  EXPECT_EQ(decided(property, {"1000", "0010"}), 0U);
  EXPECT_EQ(decided(property, {"1000", "0001"}), 4U) << "10 ms too late";
  EXPECT_EQ(decided(property, {"100", "000"}), 0U) << "there is time left";
  EXPECT_EQ(decided(property, {"1000", "1000"}), 0U);
  EXPECT_EQ(decided(property, {"10", "01"}, 21), 2U);
}

TEST(Replay, NoneForSoLong) {
  Property property = property_of(Form::After, {"P", "Q"});
  property.absent = true;
  property.milliseconds = 20;
  EXPECT_EQ(decided(property, {"1000", "0010"}), 0U);
  EXPECT_EQ(decided(property, {"1000", "0100"}), 2U);
  EXPECT_EQ(decided(property, {"1000", "1000"}), 1U);
  EXPECT_EQ(decided(property, {"1100", "0010"}), 3U) << "the latest decides";
  EXPECT_EQ(decided(property, {"0010", "1100"}), 0U) << "Q may be before P";
  property.milliseconds = -1;
  property.scans = 2;
  EXPECT_EQ(decided(property, {"1000", "0011"}), 0U);
  EXPECT_EQ(decided(property, {"1000", "0101"}), 2U);
  property.scans = 1;
  EXPECT_EQ(decided(property, {"1000", "0100"}), 0U);
  EXPECT_EQ(decided(property, {"0001", "0001"}), 4U);
}

TEST(Replay, HeldForATime) {
  Property property = property_of(Form::For, {"P", "Q"});
  property.milliseconds = 20;
  EXPECT_EQ(decided(property, {"110110", "000000"}), 0U);
  EXPECT_EQ(decided(property, {"01110", "00000"}), 4U);
  EXPECT_EQ(decided(property, {"01111", "00010"}), 5U);
  property.milliseconds = 0;
  EXPECT_EQ(decided(property, {"01", "00"}), 2U);
}

TEST(Replay, OnlyAfter) {
  const Property property = property_of(Form::OnlyAfter, {"Q", "P"});
  EXPECT_EQ(decided(property, {"001", "010"}), 2U);
  EXPECT_EQ(decided(property, {"010", "011"}), 0U) << "in the same scan";
  EXPECT_EQ(decided(property, {"100", "001"}), 0U);
}

// Q set P reset R, where nothing obliges Q to follow.
TEST(Replay, PartsOfALatch) {
  const Property latch = property_of(Form::Latch, {"Q", "P", "R"});
  const auto part = [&](std::uint32_t number, const std::string& p,
                        const std::string& q, const std::string& r) {
    return decided(latch, {p, q, r}, 10, number);
  };
  EXPECT_EQ(part(0, "00", "01", "00"), 2U);
  EXPECT_EQ(part(1, "01", "00", "00"), 2U);
  EXPECT_EQ(part(1, "01", "00", "01"), 0U) << "reset is dominant";
  EXPECT_EQ(part(2, "00", "10", "00"), 2U);
  EXPECT_EQ(part(2, "00", "10", "01"), 0U);
  EXPECT_EQ(part(3, "00", "10", "00"), 2U) << "it is off";
  EXPECT_EQ(part(3, "00", "11", "11"), 0U);
  EXPECT_EQ(part(4, "01", "01", "01"), 2U);
  EXPECT_EQ(part(5, "10", "11", "00"), 0U);
  EXPECT_EQ(part(5, "01", "10", "00"), 0U + 1U);
}

TEST(Replay, PartsOfALatchWithDominantSet) {
  Property latch = property_of(Form::Latch, {"Q", "P", "R"});
  latch.dominant_set = true;
  EXPECT_EQ(decided(latch, {"1", "0", "1"}, 10, 1), 1U);
  EXPECT_EQ(decided(latch, {"1", "1", "1"}, 10, 4), 0U);
  EXPECT_EQ(decided(latch, {"0", "1", "1"}, 10, 4), 1U);
}

TEST(Replay, AssumptionsAreAboutEveryScan) {
  Signals signals;
  PropertySet set;
  set.properties = {property_of(Form::Always, {"!Q"})};
  set.assumptions = {"!(iP && iR)"};
  const Program& program = signals.maker.program();
  EXPECT_TRUE(
      replay(program, set, 0, 0, run_of(signals, {"101", "000", "010"}, 10))
          .assumptions_hold);
  const Replay broken =
      replay(program, set, 0, 0, run_of(signals, {"110", "001", "010"}, 10));
  EXPECT_FALSE(broken.assumptions_hold);
  EXPECT_EQ(broken.decided_at, 3U);
  EXPECT_EQ(broken.trace.steps.size(), 3U);
  EXPECT_EQ(broken.trace.steps[2].values[signals.cells[1].index()], 1);
}

TEST(Replay, ManyTargetsInOneRun) {
  Signals signals;
  PropertySet set;
  set.properties = {property_of(Form::Reach, {"P"}),
                    property_of(Form::Latch, {"Q", "P", "R"})};
  const std::vector<ReplayTarget> targets = {{1, 1}, {0, 0}, {1, 0}, {0, 0}};
  const ReplayAll all =
      replay_all(signals.maker.program(), set, targets,
                 run_of(signals, {"0100", "0001", "0000"}, 10));
  EXPECT_EQ(all.decided_at, (std::vector<std::uint64_t>{2, 2, 4, 2}));
}

/// The same run twice: in long steps, and scan by scan.
class LongRun : public testing::Test {
 protected:
  LongRun() {
    set_.properties.clear();
    in_ = maker_.input("in");
    maker_.call("sim", "T", 0, 5000, {maker_.read(in_)});
    q_ = maker_.output("Q");
    maker_.rung(q_);
  }

  void expect_same(const Property& property, std::uint64_t at) {
    set_.properties = {property};
    for (const std::int64_t dt : {1, 7}) {
      Stimulus jumping;
      jumping.inputs = {in_};
      jumping.steps = {{dt, 40, {0}}, {dt, 9000, {1}}, {dt, 9000, {0}}};
      Stimulus plain = jumping;
      plain.steps.clear();
      for (const StimulusStep& step : jumping.steps) {
        for (std::uint64_t i = 0; i < step.repeat; ++i) {
          plain.steps.push_back({step.dt_ms, 1, step.inputs});
        }
      }
      const Program& program = maker_.program();
      const std::uint64_t expected =
          replay(program, set_, 0, 0, plain).decided_at;
      EXPECT_EQ(replay(program, set_, 0, 0, jumping).decided_at, expected)
          << "dt " << dt;
      if (dt == 1) {
        EXPECT_EQ(expected, at);
      }
    }
  }

  ProgramMaker maker_;
  CellId in_;
  CellId q_;
  PropertySet set_;
};

TEST_F(LongRun, TimersFire) {
  expect_same(property_of(Form::Reach, {"Q"}), 40 + 5001);
  expect_same(property_of(Form::Reach, {"prev(Q)"}), 40 + 5002);
}

TEST_F(LongRun, ElapsedTimes) {
  expect_same(property_of(Form::Reach, {"T(0).q"}), 40 + 5001);
  expect_same(property_of(Form::Reach, {"T(0).elapsed == 3123"}), 40 + 3124);
  expect_same(property_of(Form::Never, {"T(0).elapsed > 6000"}), 40 + 6002);
  expect_same(property_of(Form::Always, {"6000 >= T(0).elapsed * 2 + 1"}),
              40 + 3001);
  expect_same(property_of(Form::Reach, {"T(0).elapsed != 0 && !Q && in && "
                                        "!(T(0).elapsed < 4999)"}),
              40 + 5000);
}

TEST_F(LongRun, Deadlines) {
  Property held = property_of(Form::For, {"in", "false"});
  held.milliseconds = 4321;
  expect_same(held, 40 + 4322);
  Property response = property_of(Form::After, {"in", "Q"});
  response.milliseconds = 4321;
  expect_same(response, 40 + 4323);
  response.milliseconds = 5000;
  expect_same(response, 0);
  Property none = property_of(Form::After, {"in", "Q"});
  none.absent = true;
  none.milliseconds = 1;
  expect_same(none, 40 + 5001);
  response.milliseconds = -1;
  response.scans = 4321;
  expect_same(response, 40 + 4322);
}

TEST_F(LongRun, Gaps) {
  Property gap = property_of(Form::Interlock, {"Q", "!in && !rose(!in)"});
  gap.milliseconds = 1;
  expect_same(gap, 0);
  gap.milliseconds = 3;
  expect_same(gap, 40 + 9000 + 2);
}

TEST(Replay, YearsAreJumpedOver) {
  ProgramMaker maker;
  const CellId in = maker.input("in");
  constexpr std::int64_t kYear = std::int64_t{365} * 24 * 3'600'000;
  maker.call("yun", "T", 0, kYear, {maker.read(in)});
  maker.rung(maker.output("Q"));
  PropertySet set;
  set.properties = {property_of(Form::For, {"in", "T(0).elapsed < 9"}),
                    property_of(Form::Reach, {"Q"})};
  set.properties[0].milliseconds = kYear - 5;
  Stimulus stimulus;
  stimulus.inputs = {in};
  stimulus.steps = {{1, 2 * static_cast<std::uint64_t>(kYear), {1}}};
  const ReplayAll all =
      replay_all(maker.program(), set, {{0, 0}, {1, 0}}, stimulus);
  EXPECT_EQ(all.decided_at[0], static_cast<std::uint64_t>(kYear) - 4);
  EXPECT_EQ(all.decided_at[1], static_cast<std::uint64_t>(kYear) + 2);
}

// Q = P && !Q: while P is held, it changes in every scan.
std::uint64_t unsettled(std::int64_t scans, const std::vector<int>& inputs,
                        const std::vector<std::int64_t>& times) {
  ProgramMaker maker;
  const CellId in = maker.input("P");
  const CellId out = maker.output("Q");
  const std::uint32_t off = maker.node(NodeOp::Not, maker.read(out));
  maker.node(NodeOp::And, maker.read(in), off);
  maker.rung(out);
  Property property = property_of(Form::Settles, {"Q"});
  property.scans = scans;
  PropertySet set;
  set.properties = {property};
  Stimulus stimulus;
  stimulus.inputs = {in};
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    stimulus.steps.push_back({times[i], 1, {inputs[i]}});
  }
  return replay(maker.program(), set, 0, 0, stimulus).decided_at;
}

TEST(Replay, Settles) {
  EXPECT_EQ(unsettled(1, {1, 1, 1, 1}, {9, 0, 0, 0}), 3U);
  EXPECT_EQ(unsettled(2, {1, 1, 1, 1}, {9, 0, 0, 0}), 4U);
  EXPECT_EQ(unsettled(3, {1, 1, 1, 1}, {9, 0, 0, 0}), 0U);
  // The inputs change when time stops, not later.
  EXPECT_EQ(unsettled(1, {0, 1, 1, 1}, {9, 0, 0, 0}), 3U);
  EXPECT_EQ(unsettled(1, {1, 0, 1, 1, 1, 1}, {9, 0, 0, 0, 0, 0}), 0U);
  // It stops behind a scan, and for good.
  EXPECT_EQ(unsettled(1, {1, 1, 1}, {0, 0, 0}), 3U);
  EXPECT_EQ(unsettled(1, {1, 1}, {0, 0}), 0U);
  EXPECT_EQ(unsettled(1, {1, 1, 1, 1, 1}, {9, 0, 9, 0, 0}), 0U);
  EXPECT_EQ(unsettled(1, {1, 1, 1, 1}, {9, 9, 9, 9}), 0U);
}

std::string refuted(const std::vector<std::string>& stem,
                    const std::vector<std::string>& loop,
                    const std::vector<std::string>& formulas = {"P", "Q"},
                    bool may_meet_goal = false) {
  Signals signals;
  PropertySet set;
  set.properties = {property_of(Form::Eventually, formulas)};
  return refuted_loop(signals.maker.program(), set, 0,
                      {run_of(signals, stem, 10), run_of(signals, loop, 10)},
                      {signals.cells, {}}, may_meet_goal);
}

TEST(Replay, LoopsOfEventually) {
  EXPECT_EQ(refuted({"0", "1"}, {"0", "1"}), "");
  EXPECT_EQ(refuted({"10", "01"}, {"000", "011"}), "");
  EXPECT_EQ(refuted({"0", "0"}, {"00", "10"}), "");
  EXPECT_EQ(refuted({"", ""}, {"00", "10"}), "");  // from power-up on
  EXPECT_EQ(refuted({"0", "1"}, {"010", "111"}),
            "the simulator gets to the goal in round 1 of the loop");
  EXPECT_EQ(refuted({"0", "1"}, {"010", "111"}, {"P", "Q"}, true), "");
  EXPECT_EQ(refuted({"0", "1"}, {"000", "000"}),
            "what is given as fair is not true in round 1 of the loop");
  EXPECT_EQ(refuted({"0", "1"}, {"00", "10"}),
            "the simulator is not where it was after round 1 of the loop");
  EXPECT_EQ(refuted({"00", "10"}, {"", ""}), "the loop found has no scan");
  // Each of two, and what a formula remembers: Q rises only once.
  EXPECT_EQ(refuted({"0", "0", "0"}, {"000", "100", "010"}, {"P", "Q", "R"}),
            "");
  EXPECT_EQ(refuted({"0", "0", "0"}, {"000", "100", "000"}, {"P", "Q", "R"}),
            "what is given as fair is not true in round 1 of the loop");
  EXPECT_EQ(refuted({"0", "0"}, {"0", "1"}, {"P", "rose(Q)"}),
            "the simulator is not where it was after round 1 of the loop");
  EXPECT_EQ(refuted({"00", "01"}, {"00", "11"}, {"P", "rose(Q)"}),
            "what is given as fair is not true in round 1 of the loop");
}

// A timer that is done goes on for ever and is in one state; one that is not
// yet done is in another each scan.
TEST(Replay, LoopsAreClosedWhereTimersAreDone) {
  ProgramMaker maker;
  const CellId in = maker.input("in");
  maker.call("yun", "T", 0, 100, {maker.read(in)});
  maker.rung(maker.output("Q"));
  PropertySet set;
  set.properties = {property_of(Form::Eventually, {"!in"})};
  const auto run = [&](std::uint64_t scans) {
    return Stimulus{{in}, {{10, scans, {1}}}};
  };
  const auto refuted_after = [&](std::uint64_t scans) {
    return refuted_loop(maker.program(), set, 0, {run(scans), run(1)},
                        {{}, {InstanceId(0)}}, false);
  };
  EXPECT_EQ(refuted_after(12), "");
  EXPECT_EQ(refuted_after(8),
            "the simulator is not where it was after round 1 of the loop");
}

TEST(Replay, TheTraceOfALoopSaysWhereItBegins) {
  Signals signals;
  const Trace trace =
      trace_of(signals.maker.program(),
               {run_of(signals, {"0110"}, 10), run_of(signals, {"01"}, 10)});
  ASSERT_TRUE(trace.loop.has_value());
  EXPECT_EQ(*trace.loop, 4U);
  EXPECT_EQ(trace.steps[*trace.loop].scan, 5U);
}

}  // namespace
}  // namespace rung
