#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

#include "backend/postfix/lower.h"
#include "fake_board.h"
#include "image.h"
#include "rungproof_controller.h"

namespace rung {
namespace {

using rungproof::Controller;
using rungproof::Outputs;
using rungproof::Pin;
using rungproof::Refusal;
using rungproof::State;
using rungproof::Wiring;

/// The bytes of a program, in an array of exactly their length.
std::vector<std::uint8_t> bytes_of(const std::string& file) {
  return {file.begin(), file.end()};
}

std::vector<std::uint8_t> lowered(const std::string& text) {
  DiagnosticList errors;
  const auto file = lower_to_postfix_binary(program_of(text), errors);
  EXPECT_TRUE(file.has_value());
  return file ? bytes_of(*file) : std::vector<std::uint8_t>{};
}

/// Starts with pin 4, stops with pin 5, drives pin 3.
std::vector<std::uint8_t> start_stop() {
  return lowered(
      postfix_text("input bit pin4\ninput bit pin5\noutput bit pin3\n",
                   "pin3 pin4 || pin5 ! && =pin3\n"));
}

/// A controller on a fake board; its memory is as large as `words`, or as the
/// first program asks for.
class ControllerTest : public testing::Test {
 protected:
  Refusal begin(const std::vector<std::uint8_t>& program,
                const Wiring& wiring = Wiring(), std::size_t words = 0) {
    programs_.push_back(program);
    const std::vector<std::uint8_t>& kept = programs_.back();
    const std::uint32_t asked =
        Controller::memory_words(kept.data(), size(kept));
    memory_.assign(words == 0 ? asked : words, 0xa5a5a5a5U);
    return controller_.begin(kept.data(), size(kept), memory_.data(),
                             static_cast<std::uint32_t>(memory_.size()), board_,
                             wiring);
  }

  Refusal replace(const std::vector<std::uint8_t>& program, Outputs outputs) {
    programs_.push_back(program);
    return controller_.replace(programs_.back().data(), size(programs_.back()),
                               outputs);
  }

  bool update_after(std::uint32_t ms) {
    board_.now += ms;
    return controller_.update();
  }

  static std::uint32_t size(const std::vector<std::uint8_t>& bytes) {
    return static_cast<std::uint32_t>(bytes.size());
  }

  FakeBoard board_;
  // A list would do; what matters is that the bytes stay where they are.
  std::vector<std::vector<std::uint8_t>> programs_ = [] {
    std::vector<std::vector<std::uint8_t>> room;
    room.reserve(16);
    return room;
  }();
  std::vector<std::uint32_t> memory_;
  Controller controller_;
};

TEST_F(ControllerTest, TheProgramSetsDirectionsLevelFirst) {
  ASSERT_EQ(begin(start_stop()), Refusal::None);
  EXPECT_EQ(board_.take_log(), "4:in 5:in 3=0 3:out ");
}

TEST_F(ControllerTest, AScanReadsAllInputsOnceThenWritesAllOutputsOnce) {
  ASSERT_EQ(begin(start_stop()), Refusal::None);
  board_.take_log();
  board_.levels[4] = 1;
  ASSERT_TRUE(update_after(1));
  EXPECT_EQ(board_.take_log(), "<4 <5 3=1 ");
  board_.levels[4] = 0;
  ASSERT_TRUE(update_after(1));
  EXPECT_EQ(board_.levels[3], 1);  // held
  board_.levels[5] = 1;
  ASSERT_TRUE(update_after(1));
  EXPECT_EQ(board_.levels[3], 0);
}

TEST_F(ControllerTest, NoScanBeforeTheShortestScanTimeHasPassed) {
  const auto program = lowered(
      "postfix 1\ndialect yun\nevaluation strict\nscan 10..20 ms\n"
      "input bit pin4\noutput bit pin3\nrungs\npin4 =pin3\n");
  board_.now = 1000;
  ASSERT_EQ(begin(program), Refusal::None);
  board_.take_log();
  EXPECT_FALSE(update_after(9));
  EXPECT_EQ(board_.log, "");
  EXPECT_EQ(board_.alive_count, 0);
  EXPECT_TRUE(update_after(1));
  EXPECT_EQ(board_.alive_count, 1);
  EXPECT_TRUE(update_after(20));
  EXPECT_TRUE(controller_.machine().interval_held());
  EXPECT_TRUE(update_after(21));  // late, and made all the same
  EXPECT_FALSE(controller_.machine().interval_held());
}

std::vector<std::uint8_t> timer_of(int ms) {
  return lowered(
      postfix_text("input bit pin4\noutput bit pin3\n"
                   "element T(0) timer-yun\n",
                   "pin4 T(0," + std::to_string(ms) + "ms) =pin3\n"));
}

TEST_F(ControllerTest, TimeGoesOnWhereTheClockRollsOver) {
  board_.now = 0xffffffffU - 30;
  ASSERT_EQ(begin(timer_of(100)), Refusal::None);
  board_.levels[4] = 1;
  ASSERT_TRUE(update_after(1));  // the timer starts
  for (int scan = 0; scan < 5; ++scan) {
    ASSERT_TRUE(update_after(20));
    EXPECT_EQ(board_.levels[3], 0) << scan;
  }
  ASSERT_LT(board_.now, 1000U);  // it has rolled over
  EXPECT_TRUE(controller_.machine().interval_held());
  ASSERT_TRUE(update_after(1));
  EXPECT_EQ(board_.levels[3], 1);
}

TEST_F(ControllerTest, ALateScanTakesTheTimeThatItTook) {
  ASSERT_EQ(begin(timer_of(5000)), Refusal::None);
  board_.levels[4] = 1;
  ASSERT_TRUE(update_after(1));
  ASSERT_TRUE(update_after(5001));
  EXPECT_EQ(board_.levels[3], 1);
  EXPECT_FALSE(controller_.machine().interval_held());
}

TEST_F(ControllerTest, WordsAreReadAsWordsAndBroughtIntoTheirRange) {
  const auto program =
      lowered(postfix_text("input word A0 in 0..1023\noutput bit pin2\n"
                           "output word pin9 in 0..1023\n",
                           "A0 500 > =pin2\nA0 =pin9\n"));
  ASSERT_EQ(begin(program), Refusal::None);
  EXPECT_EQ(board_.take_log(), "2=0 2:out 128:in 9=w0 9:out ");
  board_.levels[rungproof::kAnalogPin] = 2000;
  ASSERT_TRUE(update_after(1));
  EXPECT_EQ(board_.take_log(), "<w128 2=1 9=w1023 ");
}

/// Its output is pin 3, too; adds A0 to a word of at most 100.
std::vector<std::uint8_t> faulting() {
  return lowered(
      postfix_text("input word A0 in 0..1023\noutput bit pin3\n"
                   "output bit pin7\nmemory word sum in 0..100\n",
                   "true =pin3\ntrue =pin7\nsum A0 + =sum\n"));
}

const Pin kSafePins[] = {{"pin7", 7, 1}, {"start", 4, 1}, {"motor", 3, 0}};

TEST_F(ControllerTest, AFaultPutsOutputsIntoTheirDeclaredSafeState) {
  ASSERT_EQ(begin(faulting(), Wiring(kSafePins, 3)), Refusal::None);
  EXPECT_EQ(board_.levels[7], 1);  // safe before the first scan too
  ASSERT_TRUE(update_after(1));
  EXPECT_EQ(board_.levels[3], 1);
  board_.levels[rungproof::kAnalogPin] = 101;
  board_.levels[7] = 5;
  EXPECT_FALSE(update_after(1));
  EXPECT_EQ(controller_.state(), State::Faulted);
  EXPECT_EQ(controller_.machine().fault(), rungproof::Fault::Range);
  EXPECT_EQ(board_.levels[3], 0);
  EXPECT_EQ(board_.levels[7], 1);
  board_.take_log();
  const int alive = board_.alive_count;
  EXPECT_FALSE(update_after(1));
  EXPECT_EQ(board_.log, "");
  EXPECT_EQ(board_.alive_count, alive + 1);  // safe on purpose

  board_.levels[rungproof::kAnalogPin] = 0;
  controller_.restart();
  EXPECT_EQ(controller_.state(), State::Running);
  EXPECT_TRUE(update_after(1));
  EXPECT_EQ(board_.levels[3], 1);
}

TEST_F(ControllerTest, StopMakesOutputsSafeUntilRestart) {
  ASSERT_EQ(begin(start_stop()), Refusal::None);
  board_.levels[4] = 1;
  ASSERT_TRUE(update_after(1));
  controller_.stop();
  EXPECT_EQ(board_.levels[3], 0);
  EXPECT_FALSE(update_after(1));
  EXPECT_EQ(board_.levels[3], 0);
  board_.levels[4] = 0;
  controller_.restart();
  ASSERT_TRUE(update_after(1));
  EXPECT_EQ(board_.levels[3], 0);  // from its beginning: nothing is latched
}

TEST_F(ControllerTest, AMapGivesPinsToOtherNames) {
  const auto program =
      lowered(postfix_text("input bit start\noutput bit motor\n"
                           "output bit pin7\n",
                           "start =motor\nstart ! =pin7\n"));
  ASSERT_EQ(begin(program, Wiring(kSafePins, 3)), Refusal::None);
  EXPECT_EQ(board_.take_log(), "4:up 3=0 3:out 7=1 7:out ");
}

TEST_F(ControllerTest, APointWithoutPinIsRefusedAndNothingTouched) {
  for (const char* name :
       {"start", "pin", "pin128", "pin03", "pin1x", "pin1000", "Pin1", "A16",
        "A", "A00", "pi", "motorx", "moto"}) {
    const auto program = lowered(
        postfix_text("input bit pin1\noutput bit " + std::string(name) + "\n",
                     "pin1 =" + std::string(name) + "\n"));
    EXPECT_EQ(begin(program, Wiring(kSafePins + 2, 1)), Refusal::NoPin) << name;
    EXPECT_EQ(controller_.state(), State::Empty);
    EXPECT_EQ(board_.take_log(), "");
    EXPECT_FALSE(update_after(1));
    // The machine says which: the place of the name.
    const std::uint32_t at = controller_.machine().refused_at();
    EXPECT_EQ(std::string(program.begin() + at + 1,
                          program.begin() + at + 1 + program[at]),
              name);
  }
}

TEST_F(ControllerTest, AnOutputSharesItsPinWithNothing) {
  const Pin two_outputs[] = {{"a", 3, 0}, {"b", 3, 0}};
  const auto outputs = lowered(
      postfix_text("output bit a\noutput bit b\n", "true =a\ntrue =b\n"));
  EXPECT_EQ(begin(outputs, Wiring(two_outputs, 2)), Refusal::PinTaken);
  const auto mixed =
      lowered(postfix_text("input bit a\noutput bit b\n", "a =b\n"));
  EXPECT_EQ(begin(mixed, Wiring(two_outputs, 2)), Refusal::PinTaken);
  const auto inputs = lowered(postfix_text(
      "input bit a\ninput bit b\noutput bit pin5\n", "a b && =pin5\n"));
  EXPECT_EQ(begin(inputs, Wiring(two_outputs, 2)), Refusal::None);
}

TEST_F(ControllerTest, APointThatIsNotWiredIsTheSketchesBusiness) {
  const Pin map[] = {{"a", rungproof::kNotWired, 0},
                     {"b", rungproof::kNotWired, 0}};
  const auto program =
      lowered(postfix_text("input bit a\noutput bit b\n", "a =b\n"));
  ASSERT_EQ(begin(program, Wiring(map, 2)), Refusal::None);
  controller_.machine().set(0, 1);
  ASSERT_TRUE(update_after(1));
  EXPECT_EQ(board_.log, "");
  EXPECT_EQ(controller_.machine().value(1), 1);
}

TEST_F(ControllerTest, ABrokenProgramLeavesPinsAlone) {
  auto program = start_stop();
  program.back() ^= 1;
  EXPECT_EQ(begin(program), Refusal::BadChecksum);
  EXPECT_EQ(board_.log, "");
  EXPECT_EQ(controller_.state(), State::Empty);
  controller_.stop();
  controller_.restart();
  EXPECT_EQ(controller_.state(), State::Empty);
  EXPECT_FALSE(update_after(1));
  EXPECT_EQ(board_.alive_count, 1);
}

TEST_F(ControllerTest, BeforeBeginNothingHappens) {
  EXPECT_FALSE(controller_.update());
  EXPECT_EQ(replace(start_stop(), Outputs::Hold), Refusal::NoMemory);
  controller_.stop();
  controller_.restart();
  EXPECT_EQ(controller_.state(), State::Empty);
}

TEST_F(ControllerTest, MemoryForMachineAndPinsIsExact) {
  const auto program = start_stop();
  const std::uint32_t words =
      Controller::memory_words(program.data(), size(program));
  EXPECT_GT(words,
            rungproof::Machine::memory_words(program.data(), size(program)));
  EXPECT_EQ(begin(program, Wiring(), words - 1), Refusal::NoMemory);
  EXPECT_EQ(begin(program, Wiring(), words), Refusal::None);
  EXPECT_EQ(Controller::memory_words(program.data(), 47), 0U);
  EXPECT_EQ(Controller::memory_words(program.data(), 50), 0U);
}

/// Pin 6 follows pin 4, and pin 3 is high.
std::vector<std::uint8_t> successor() {
  return lowered(
      postfix_text("input bit pin4\noutput bit pin3\noutput bit pin6\n",
                   "true =pin3\npin4 =pin6\n"));
}

TEST_F(ControllerTest, ReplacingHoldsOutputsToTheNextScan) {
  ASSERT_EQ(begin(start_stop(), Wiring(), 32), Refusal::None);
  board_.levels[4] = 1;
  ASSERT_TRUE(update_after(1));
  board_.take_log();
  ASSERT_EQ(replace(successor(), Outputs::Hold), Refusal::None);
  EXPECT_EQ(board_.take_log(), "4:in 3:out 6=0 6:out ");
  EXPECT_EQ(board_.levels[3], 1);
  ASSERT_TRUE(update_after(1));
  EXPECT_EQ(board_.levels[6], 1);
}

TEST_F(ControllerTest, ReplacingClearsOutputsWhereAsked) {
  ASSERT_EQ(begin(start_stop(), Wiring(), 32), Refusal::None);
  board_.levels[4] = 1;
  ASSERT_TRUE(update_after(1));
  ASSERT_EQ(replace(successor(), Outputs::Clear), Refusal::None);
  EXPECT_EQ(board_.levels[3], 0);
}

TEST_F(ControllerTest, AnOutputThatTheNewProgramHasNotBecomesSafe) {
  ASSERT_EQ(begin(successor(), Wiring(), 32), Refusal::None);
  board_.levels[4] = 1;
  ASSERT_TRUE(update_after(1));
  EXPECT_EQ(board_.levels[6], 1);
  ASSERT_EQ(replace(start_stop(), Outputs::Hold), Refusal::None);
  EXPECT_EQ(board_.levels[6], 0);
  EXPECT_EQ(board_.levels[3], 1);
}

TEST_F(ControllerTest, ARefusedReplacementChangesNothing) {
  ASSERT_EQ(begin(timer_of(10), Wiring(), 32), Refusal::None);
  board_.levels[4] = 1;
  ASSERT_TRUE(update_after(1));
  ASSERT_TRUE(update_after(10));
  const std::vector<std::uint32_t> image = memory_;
  board_.take_log();

  auto broken = successor();
  broken[60] ^= 4;
  EXPECT_EQ(replace(broken, Outputs::Clear), Refusal::BadChecksum);
  const auto nowhere =
      lowered(postfix_text("output bit elsewhere\n", "true =elsewhere\n"));
  EXPECT_EQ(replace(nowhere, Outputs::Clear), Refusal::NoPin);
  std::string many;
  for (int i = 0; i < 200; ++i)
    many += "memory bit m" + std::to_string(i) + "\n";
  const auto large =
      lowered(postfix_text("output bit pin3\n" + many, "true =pin3\n"));
  EXPECT_EQ(replace(large, Outputs::Clear), Refusal::NoMemory);
  EXPECT_EQ(replace({}, Outputs::Clear), Refusal::TooShort);

  EXPECT_EQ(memory_, image);
  EXPECT_EQ(board_.log, "");
  EXPECT_EQ(controller_.state(), State::Running);
  ASSERT_TRUE(update_after(1));  // its timer has not forgotten
  EXPECT_EQ(board_.levels[3], 1);
}

TEST_F(ControllerTest, VerifyingTheNewProgramSparesTheOldOnesMemory) {
  const auto nested = lowered(postfix_text(
      "input bit pin4\noutput bit pin3\nelement T(0) timer-sim\n"
      "element T(1) timer-sim\n",
      "pin4 pin4 T(0,5ms) && pin4 T(1,5ms) || =pin3\n", "short-circuit"));
  ASSERT_EQ(begin(timer_of(10), Wiring(), 4), Refusal::None);
  // Room to run it, and none to verify it beside the old one.
  const std::vector<std::uint32_t> image = memory_;
  EXPECT_EQ(replace(nested, Outputs::Hold), Refusal::NoMemory);
  EXPECT_EQ(memory_, image);
  ASSERT_EQ(begin(timer_of(10), Wiring(), 16), Refusal::None);
  EXPECT_EQ(replace(nested, Outputs::Hold), Refusal::None);
}

TEST_F(ControllerTest, AnEmptyControllerTakesItsFirstProgramLater) {
  EXPECT_EQ(begin({}, Wiring(), 32), Refusal::TooShort);
  EXPECT_EQ(replace(start_stop(), Outputs::Hold), Refusal::None);
  board_.levels[4] = 1;
  ASSERT_TRUE(update_after(1));
  EXPECT_EQ(board_.levels[3], 1);
}

TEST_F(ControllerTest, AFaultedProgramIsReplaced) {
  ASSERT_EQ(begin(faulting(), Wiring(), 32), Refusal::None);
  board_.levels[rungproof::kAnalogPin] = 101;
  ASSERT_FALSE(update_after(1));
  ASSERT_EQ(controller_.state(), State::Faulted);
  ASSERT_EQ(replace(start_stop(), Outputs::Hold), Refusal::None);
  board_.levels[4] = 1;
  EXPECT_TRUE(update_after(1));
  EXPECT_EQ(board_.levels[3], 1);
}

TEST_F(ControllerTest, ASecondBeginMakesTheFirstProgramsOutputsSafe) {
  ASSERT_EQ(begin(successor(), Wiring(), 32), Refusal::None);
  board_.levels[4] = 1;
  ASSERT_TRUE(update_after(1));
  ASSERT_EQ(begin({}, Wiring(), 32), Refusal::TooShort);
  EXPECT_EQ(board_.levels[3], 0);
  EXPECT_EQ(board_.levels[6], 0);
}

}  // namespace
}  // namespace rung
