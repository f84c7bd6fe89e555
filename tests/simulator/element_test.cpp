// Each element against tables worked out by hand from the published listings:
// Sensors and Materials 32(12), 2020, section 2.1 (yun), and the I/O simulator
// for boolean ladder scripts, section 3.2 (sim).

#include <gtest/gtest.h>

#include <cstdint>
#include <string_view>
#include <vector>

#include "analysis/simulator.h"
#include "analysis/simulator_elements.h"
#include "program_maker.h"

namespace rung {
namespace {

struct Call {
  std::string_view name;
  std::int64_t index = 0;
  std::int64_t parameter = 0;
  std::size_t operands = 1;
};

/// Inputs i0, i1, ... feed the operands of the calls in order; the result of
/// call k is output k.
class Bench {
 public:
  Bench(std::string_view dialect, const std::vector<Call>& calls) {
    for (const Call& call : calls) {
      for (std::size_t i = 0; i < call.operands; ++i) {
        inputs_.push_back(maker_.input("i" + std::to_string(inputs_.size())));
      }
    }
    std::size_t next = 0;
    for (const Call& call : calls) {
      std::vector<std::uint32_t> arguments;
      for (std::size_t i = 0; i < call.operands; ++i) {
        arguments.push_back(maker_.read(inputs_[next++]));
      }
      maker_.call(dialect, call.name, call.index, call.parameter, arguments);
      outputs_.push_back(maker_.output("q" + std::to_string(outputs_.size())));
      maker_.rung(outputs_.back());
    }
    simulator_ = std::make_unique<Simulator>(maker_.program());
  }

  /// One scan; digits of `inputs` are the operands. Gives the results.
  std::string scan(std::int64_t dt_ms, std::string_view inputs) {
    EXPECT_EQ(inputs.size(), inputs_.size());
    for (std::size_t i = 0; i < inputs.size(); ++i) {
      simulator_->set_input(inputs_[i], inputs[i] - '0');
    }
    simulator_->scan(dt_ms);
    std::string result;
    for (const CellId output : outputs_) {
      result += simulator_->value(output) != 0 ? '1' : '0';
    }
    return result;
  }

  std::int64_t elapsed() const { return simulator_->elapsed(InstanceId(0)); }
  std::int64_t count() const { return simulator_->count(InstanceId(0)); }
  bool done() const { return simulator_->done(InstanceId(0)); }

 private:
  ProgramMaker maker_;
  std::vector<CellId> inputs_;
  std::vector<CellId> outputs_;
  std::unique_ptr<Simulator> simulator_;
};

TEST(Elements, EveryOperationIsKnown) {
  for (const ElementKind& kind : element_kinds()) {
    for (const ElementOperation& operation : kind.operations) {
      EXPECT_NE(find_simulated(kind, operation), nullptr)
          << kind.id << " " << operation.name;
    }
  }
}

TEST(TimerYun, FiresWhenMoreThanThePresetHasPassed) {
  Bench bench("yun", {{"T", 0, 20}});
  EXPECT_EQ(bench.scan(10, "0"), "0");
  EXPECT_EQ(bench.scan(10, "1"), "0");  // starts: t = 0
  EXPECT_EQ(bench.scan(10, "1"), "0");
  EXPECT_EQ(bench.scan(10, "1"), "0");  // t = 20 is not more than 20
  EXPECT_EQ(bench.scan(1, "1"), "1");
}

TEST(TimerYun, StartsAtThePresetZeroOneScanLater) {
  Bench bench("yun", {{"T", 0, 0}});
  EXPECT_EQ(bench.scan(10, "1"), "0");
  EXPECT_EQ(bench.scan(1, "1"), "1");
}

TEST(TimerYun, KeepsRunningWhenItsInputGoesFalse) {
  Bench bench("yun", {{"T", 0, 20}});
  EXPECT_EQ(bench.scan(10, "1"), "0");
  EXPECT_EQ(bench.scan(10, "0"), "0");
  EXPECT_EQ(bench.scan(10, "0"), "0");
  EXPECT_EQ(bench.scan(10, "1"), "1");  // t = 30 since the first start
}

TEST(TimerYun, HasNoDelayTheSecondTimeWithoutAReset) {
  Bench bench("yun", {{"T", 0, 20}});
  bench.scan(10, "1");
  EXPECT_EQ(bench.scan(30, "1"), "1");
  EXPECT_EQ(bench.scan(10, "0"), "0");
  EXPECT_EQ(bench.scan(10, "1"), "1");
}

TEST(TimerYun, ResetMakesTheNextActivationWait) {
  Bench bench("yun", {{"T", 0, 20}, {"TR", 0, 0}});
  bench.scan(10, "10");
  EXPECT_EQ(bench.scan(30, "10"), "10");
  EXPECT_EQ(bench.scan(10, "01"), "01");  // TR returns its input
  EXPECT_EQ(bench.scan(10, "10"), "00");
  EXPECT_EQ(bench.scan(20, "10"), "00");
  EXPECT_EQ(bench.scan(1, "10"), "10");
}

TEST(TimerYun, ResetWithAFalseInputDoesNothing) {
  Bench bench("yun", {{"T", 0, 20}, {"TR", 0, 0}});
  bench.scan(10, "10");
  EXPECT_EQ(bench.scan(21, "10"), "10");
}

TEST(TimerYun, ElapsedIsSinceTheStartUntilTheReset) {
  Bench bench("yun", {{"T", 0, 20}, {"TR", 0, 0}});
  bench.scan(10, "00");
  EXPECT_EQ(bench.elapsed(), 0);
  bench.scan(10, "10");
  EXPECT_EQ(bench.elapsed(), 0);
  bench.scan(21, "00");
  EXPECT_EQ(bench.elapsed(), 21);
  EXPECT_TRUE(bench.done());
  bench.scan(5, "01");
  EXPECT_EQ(bench.elapsed(), 0);
  EXPECT_FALSE(bench.done());
}

TEST(TimerYun, TwoCallsWithOneIndexShareTheClock) {
  Bench bench("yun", {{"T", 3, 20}, {"T", 3, 50}});
  bench.scan(10, "10");
  EXPECT_EQ(bench.scan(21, "11"), "10");
  EXPECT_EQ(bench.scan(30, "01"), "01");  // t = 51, started by the first
}

TEST(TimerSim, FiresWhenThePresetHasPassed) {
  Bench bench("sim", {{"T", 0, 20}});
  EXPECT_EQ(bench.scan(10, "1"), "0");
  EXPECT_EQ(bench.scan(19, "1"), "0");
  EXPECT_EQ(bench.scan(1, "1"), "1");  // t = 20 is enough
}

TEST(TimerSim, FalseInputStartsItAnew) {
  Bench bench("sim", {{"T", 0, 20}});
  bench.scan(10, "1");
  EXPECT_EQ(bench.scan(30, "1"), "1");
  EXPECT_EQ(bench.scan(10, "0"), "0");
  EXPECT_EQ(bench.scan(10, "1"), "0");
  EXPECT_EQ(bench.scan(20, "1"), "1");
}

TEST(TimerSim, PresetZeroIsTrueWithoutAnInput) {
  Bench bench("sim", {{"T", 0, 0}});
  EXPECT_EQ(bench.scan(10, "0"), "1");
  EXPECT_EQ(bench.scan(10, "1"), "1");
}

TEST(TimerSim, ElapsedIsSinceTheLastScanWithoutInput) {
  Bench bench("sim", {{"T", 0, 20}});
  bench.scan(10, "0");
  EXPECT_EQ(bench.elapsed(), 0);
  bench.scan(10, "1");
  EXPECT_EQ(bench.elapsed(), 0);
  bench.scan(25, "1");
  EXPECT_EQ(bench.elapsed(), 25);
  EXPECT_TRUE(bench.done());
}

TEST(TimerOff, NeverArmedStaysFalse) {
  Bench bench("sim", {{"TOF", 0, 20}});
  for (int i = 0; i < 5; ++i) EXPECT_EQ(bench.scan(100, "0"), "0");
  EXPECT_EQ(bench.elapsed(), 0);
}

TEST(TimerOff, FollowsUpAtOnceAndDownAfterThePreset) {
  Bench bench("sim", {{"TOF", 0, 20}});
  EXPECT_EQ(bench.scan(10, "1"), "1");
  EXPECT_EQ(bench.scan(10, "0"), "1");  // t0: now
  EXPECT_EQ(bench.scan(19, "0"), "1");
  EXPECT_EQ(bench.scan(1, "0"), "0");
  EXPECT_EQ(bench.scan(10, "0"), "0");
}

TEST(TimerOff, ElapsedIsThatOfTheDelay) {
  Bench bench("sim", {{"TOF", 0, 20}});
  bench.scan(10, "1");
  EXPECT_EQ(bench.elapsed(), 0);
  bench.scan(10, "0");
  bench.scan(15, "0");
  EXPECT_EQ(bench.elapsed(), 15);
  bench.scan(5, "0");
  EXPECT_EQ(bench.elapsed(), 0);
}

TEST(TimerOff, AShortGapDoesNotShow) {
  Bench bench("sim", {{"TOF", 0, 20}});
  bench.scan(10, "1");
  bench.scan(10, "0");
  EXPECT_EQ(bench.scan(15, "1"), "1");
  EXPECT_EQ(bench.scan(10, "0"), "1");
  EXPECT_EQ(bench.scan(15, "0"), "1");  // counted from the second fall
  EXPECT_EQ(bench.scan(5, "0"), "0");
}

TEST(TimerOff, PresetZeroFollowsItsInput) {
  Bench bench("sim", {{"TOF", 0, 0}});
  EXPECT_EQ(bench.scan(10, "1"), "1");
  EXPECT_EQ(bench.scan(10, "0"), "0");
}

TEST(CounterYun, CountsRisingEdgesUpToItsPreset) {
  Bench bench("yun", {{"C", 0, 2}});
  EXPECT_EQ(bench.scan(1, "1"), "0");
  EXPECT_EQ(bench.scan(1, "1"), "0");  // no edge
  EXPECT_EQ(bench.scan(1, "0"), "0");
  EXPECT_EQ(bench.scan(1, "1"), "1");
  EXPECT_EQ(bench.scan(1, "0"), "1");  // stays
  EXPECT_EQ(bench.scan(1, "1"), "1");
  EXPECT_EQ(bench.count(), 2);  // not counted past the preset
}

TEST(CounterYun, ResetKeepsTheLastInput) {
  Bench bench("yun", {{"C", 0, 1}, {"CR", 0, 0}});
  EXPECT_EQ(bench.scan(1, "10"), "10");
  EXPECT_EQ(bench.scan(1, "11"), "11");  // cleared after the call
  EXPECT_EQ(bench.count(), 0);
  EXPECT_EQ(bench.scan(1, "10"), "00");  // still held: no edge
  EXPECT_EQ(bench.scan(1, "00"), "00");
  EXPECT_EQ(bench.scan(1, "10"), "10");
}

TEST(CounterYun, PresetZeroIsTrueAtOnce) {
  Bench bench("yun", {{"Cnt", 0, 0}});
  EXPECT_EQ(bench.scan(1, "0"), "1");
}

TEST(CounterYun, CallsWithOneIndexSeeEachOthersInputAsTheLast) {
  Bench bench("yun", {{"C", 0, 9}, {"C", 0, 9}});
  bench.scan(1, "10");
  EXPECT_EQ(bench.count(), 1);
  bench.scan(1, "10");  // the second call saw false: an edge again
  EXPECT_EQ(bench.count(), 2);
  bench.scan(1, "11");
  EXPECT_EQ(bench.count(), 3);
}

TEST(CounterSim, IsTrueAtItsPresetAndNotPastIt) {
  Bench bench("sim", {{"C", 0, 1, 3}});
  EXPECT_EQ(bench.scan(1, "000"), "0");
  EXPECT_EQ(bench.scan(1, "100"), "1");
  EXPECT_EQ(bench.scan(1, "000"), "1");
  EXPECT_EQ(bench.scan(1, "100"), "0");
  EXPECT_EQ(bench.count(), 2);
}

TEST(CounterSim, CountsDownBelowZero) {
  Bench bench("sim", {{"C", 0, 1, 3}});
  bench.scan(1, "010");
  EXPECT_EQ(bench.count(), -1);
  bench.scan(1, "000");
  bench.scan(1, "010");
  EXPECT_EQ(bench.count(), -2);
  bench.scan(1, "110");  // up has an edge, down has none
  EXPECT_EQ(bench.count(), -1);
  bench.scan(1, "000");
  bench.scan(1, "110");  // both at once
  EXPECT_EQ(bench.count(), -1);
}

TEST(CounterSim, AnInputHeldThroughAResetIsCountedAgain) {
  Bench bench("sim", {{"C", 0, 1, 3}});
  EXPECT_EQ(bench.scan(1, "100"), "1");
  EXPECT_EQ(bench.scan(1, "101"), "0");
  EXPECT_EQ(bench.count(), 0);
  EXPECT_EQ(bench.scan(1, "100"), "1");
}

TEST(CounterSim, ResetIsFalseEvenWithPresetZero) {
  Bench bench("sim", {{"C", 0, 0, 3}});
  EXPECT_EQ(bench.scan(1, "000"), "1");
  EXPECT_EQ(bench.scan(1, "001"), "0");
}

TEST(CounterSim, IsCutBackPastFiftyTimesItsPreset) {
  Bench bench("sim", {{"C", 0, 1, 3}});
  for (int i = 0; i < 50; ++i) {
    bench.scan(1, "100");
    bench.scan(1, "000");
  }
  EXPECT_EQ(bench.count(), 50);
  EXPECT_EQ(bench.scan(1, "100"), "0");
  EXPECT_EQ(bench.count(), 2);
}

// Preset 0: one count is past 50 times it, and is cut back to 1. The result is
// taken before.
TEST(CounterSim, ResultIsTakenBeforeTheCutBack) {
  Bench bench("sim", {{"C", 0, 0, 3}});
  EXPECT_EQ(bench.scan(1, "100"), "0");
  EXPECT_EQ(bench.count(), 1);
  EXPECT_EQ(bench.scan(1, "000"), "0");
  EXPECT_EQ(bench.scan(1, "010"), "1");
  EXPECT_EQ(bench.count(), 0);
}

TEST(Edges, RiseAndFallAreTrueForOneScan) {
  Bench bench("yun", {{"RISE", 0}, {"FALL", 1}});
  EXPECT_EQ(bench.scan(1, "11"), "10");
  EXPECT_EQ(bench.scan(1, "11"), "00");
  EXPECT_EQ(bench.scan(1, "00"), "01");
  EXPECT_EQ(bench.scan(1, "00"), "00");
}

}  // namespace
}  // namespace rung
