#include "analysis/stimulus.h"

#include <gtest/gtest.h>

#include <string>
#include <utility>

#include "program_maker.h"

namespace rung {
namespace {

class StimulusTest : public testing::Test {
 protected:
  StimulusTest() {
    start_ = maker_.input("start");
    level_ = maker_.word("level", CellRole::Input);
    maker_.program().cells[level_].initial = 7;
    maker_.read(start_);
    maker_.rung(maker_.output("lamp"));
  }

  Stimulus read(std::string text) {
    file_ = sources_.add("run.csv", std::move(text));
    diagnostics_ = {};
    return read_stimulus(maker_.program(), sources_, file_, 25, diagnostics_);
  }

  /// "2:7 the message", of the only thing that is wrong.
  std::string refusal(std::string text) {
    read(std::move(text));
    if (diagnostics_.items().size() != 1) {
      return std::to_string(diagnostics_.items().size()) + " errors";
    }
    const Diagnostic& diagnostic = diagnostics_.items().front();
    EXPECT_EQ(diagnostic.severity, Severity::Error);
    const LineColumn at = sources_[file_].position(diagnostic.where.begin);
    return std::to_string(at.line) + ":" + std::to_string(at.column) + " " +
           diagnostic.message;
  }

  ProgramMaker maker_;
  CellId start_;
  CellId level_;
  SourceSet sources_;
  FileId file_;
  DiagnosticList diagnostics_;
};

TEST_F(StimulusTest, ReadsEveryColumn) {
  const Stimulus stimulus = read("dt,repeat,start,level\n10,,1,512\n,100,0,\n");
  ASSERT_FALSE(diagnostics_.has_errors());
  EXPECT_EQ(stimulus.inputs, (std::vector<CellId>{start_, level_}));
  ASSERT_EQ(stimulus.steps.size(), 2U);
  EXPECT_EQ(stimulus.steps[0].dt_ms, 10);
  EXPECT_EQ(stimulus.steps[0].repeat, 1U);
  EXPECT_EQ(stimulus.steps[0].inputs, (std::vector<std::int64_t>{1, 512}));
  EXPECT_EQ(stimulus.steps[1].dt_ms, 10);
  EXPECT_EQ(stimulus.steps[1].repeat, 100U);
  EXPECT_EQ(stimulus.steps[1].inputs, (std::vector<std::int64_t>{0, 512}));
}

TEST_F(StimulusTest, EmptyCellsOfTheFirstRowAreTheInitialValues) {
  const Stimulus stimulus = read("level,start\n,1\n");
  ASSERT_EQ(stimulus.steps.size(), 1U);
  EXPECT_EQ(stimulus.steps[0].dt_ms, 25);
  EXPECT_EQ(stimulus.steps[0].inputs, (std::vector<std::int64_t>{7, 1}));
}

TEST_F(StimulusTest, SpreadsheetsAndCommentsAreFine) {
  const Stimulus stimulus = read(
      "\xEF\xBB\xBF\"start\" , \"level\"\r\n# warm up\r\n\r\n true, -3 \r\n");
  ASSERT_FALSE(diagnostics_.has_errors())
      << diagnostics_.items().front().message;
  ASSERT_EQ(stimulus.steps.size(), 1U);
  EXPECT_EQ(stimulus.steps[0].inputs, (std::vector<std::int64_t>{1, -3}));
}

TEST_F(StimulusTest, RefusesWhatIsNoTable) {
  EXPECT_EQ(refusal(""),
            "1:1 the stimulus is empty: its first line names the columns");
  EXPECT_EQ(refusal("\n \n# nothing\n"),
            "1:1 the stimulus is empty: its first line names the columns");
  EXPECT_EQ(refusal("start,level\n1\n"),
            "2:1 this row has 1 cells, and 2 columns are named");
  EXPECT_EQ(refusal("start\n1,2\n"),
            "2:1 this row has 2 cells, and 1 columns are named");
}

TEST_F(StimulusTest, RefusesColumnsThatAreNoInputs) {
  EXPECT_EQ(refusal("strat\n1\n"),
            "1:1 the program has no input `strat` (did you mean `start`?)");
  EXPECT_EQ(refusal("start,lamp\n1,1\n"),
            "1:7 `lamp` is no input: the program writes it");
  EXPECT_EQ(refusal("start,start\n1,1\n"), "1:7 a second column `start`");
  EXPECT_EQ(refusal("start,\n1,1\n"), "1:7 the program has no input ``");
  EXPECT_EQ(refusal("st\x01\xFFrt\n"),
            "1:1 the program has no input `st??rt` (did you mean `start`?)");
}

TEST_F(StimulusTest, RefusesValuesOutOfRange) {
  EXPECT_EQ(refusal("start\n2\n"),
            "2:1 `2` is outside of 0..1, the range of `start`");
  EXPECT_EQ(refusal("level\n32768\n"),
            "2:1 `32768` is outside of -32768..32767, the range of `level`");
  EXPECT_EQ(refusal("level\n99999999999999999999\n"),
            "2:1 `99999999999999999999` is outside of -32768..32767, the range "
            "of `level`");
  EXPECT_EQ(refusal("dt\n0\n"),
            "2:1 `0` is outside of 1..1000000000, the range of `dt`");
  EXPECT_EQ(refusal("repeat\n-1\n"),
            "2:1 `-1` is outside of 1..1000000000000, the range of `repeat`");
}

TEST_F(StimulusTest, RefusesWhatIsNoNumber) {
  EXPECT_EQ(refusal("start\nyes\n"),
            "2:1 `yes` is no whole number, which `start` needs");
  EXPECT_EQ(refusal("level\ntrue\n"),
            "2:1 `true` is no whole number, which `level` needs");
  EXPECT_EQ(refusal("dt\n1.5\n"),
            "2:1 `1.5` is no whole number, which `dt` needs");
  EXPECT_EQ(refusal("dt\n1e3\n"),
            "2:1 `1e3` is no whole number, which `dt` needs");
}

TEST_F(StimulusTest, ReportsAllErrorsInOneRun) {
  read("start,levle\nx,1\n2,1\n1\n");
  EXPECT_EQ(diagnostics_.items().size(), 4U);
}

}  // namespace
}  // namespace rung
