// The `//Sim` section: Javascript's numbers, run after the rungs.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>

#include "analysis/simulator.h"
#include "frontend/script/reader.h"

namespace rung {
namespace {

class PlantTest : public testing::Test {
 protected:
  void read(std::string text) {
    DiagnosticList diagnostics;
    const FileId file = sources_.add("plant.txt", std::move(text));
    const Ast ast = read_script(sources_, file, "sim", diagnostics);
    program_ = build_program(ast, {}, diagnostics);
    ASSERT_FALSE(diagnostics.has_errors())
        << diagnostics.items().front().message;
  }

  CellId cell(std::string_view name) const {
    const CellId id = find_cell(program_, name);
    EXPECT_TRUE(id.has_value()) << name;
    return id;
  }

  /// Value of `name` at the end of scan `scans`.
  std::int64_t after(std::uint64_t scans, std::string_view name) const {
    Stimulus stimulus;
    stimulus.steps = {{10, scans, {}}};
    return simulate(program_, stimulus).steps.back().values[cell(name).index()];
  }

  /// What `IW0` is after the plant has run once with this value.
  std::int64_t input_of(const std::string& value) {
    read("Q0 = IW0 > 1;\n//Var\nh = 7;\n//Sim\nIW0 = " + value + ";\n");
    return after(2, "IW0");
  }

  SourceSet sources_;
  Program program_;
};

TEST_F(PlantTest, InputsGetTheWholePart) {
  EXPECT_EQ(input_of("h / 2"), 3);
  EXPECT_EQ(input_of("-h / 2"), -3);
  EXPECT_EQ(input_of("h * 0.5 * 2"), 7);
  EXPECT_EQ(input_of("1e30"), std::int64_t{1} << 62);
  EXPECT_EQ(input_of("0 / 0"), 0);
  EXPECT_EQ(input_of("0x1F"), 31);
}

TEST_F(PlantTest, Operators) {
  EXPECT_EQ(input_of("h > 6 && h < 8"), 1);
  EXPECT_EQ(input_of("h >= 8 || h <= 6"), 0);
  EXPECT_EQ(input_of("h && 5"), 5) << "the value, not its truth";
  EXPECT_EQ(input_of("0 || h"), 7);
  EXPECT_EQ(input_of("!h + 2"), 2);
  EXPECT_EQ(input_of("(h == 7) + (h != 7) + 10"), 11);
  EXPECT_EQ(input_of("true - 3"), -2);
}

TEST_F(PlantTest, TheFirstScanSeesTheInitialInputs) {
  read("Q0 = IW0 > 1;\n//Sim\nIW0 = 20;\n");
  EXPECT_EQ(after(1, "IW0"), 0);
  EXPECT_EQ(after(2, "IW0"), 20);
}

TEST_F(PlantTest, ThePlantGoesOnWithItsOwnNumber) {
  read("Q0 = IW0 > 1;\n//Sim\nIW0 = IW0 + 0.25;\n");
  EXPECT_EQ(after(4, "IW0"), 0);
  EXPECT_EQ(after(5, "IW0"), 1);
  EXPECT_EQ(after(41, "IW0"), 10);
}

TEST_F(PlantTest, VariablesAreZeroBeforeTheyAreAssigned) {
  read("Q0 = IW0 > 1;\n//Sim\nh = h + 1;\nIW0 = h;\n");
  EXPECT_EQ(after(4, "IW0"), 3);
}

TEST_F(PlantTest, BranchesOfIf) {
  read(
      "Q0 = IW0 > 1;\n//Sim\n"
      "n = n + 1;\n"
      "if (n > 2) { if (n > 4) IW0 = 30; else IW0 = 20; } else { IW0 = 10; }\n"
      "if (n == 6) IW0 = 60;\n");
  EXPECT_EQ(after(2, "IW0"), 10);
  EXPECT_EQ(after(3, "IW0"), 10);
  EXPECT_EQ(after(4, "IW0"), 20);
  EXPECT_EQ(after(6, "IW0"), 30);
  EXPECT_EQ(after(7, "IW0"), 60);
}

TEST_F(PlantTest, OutputsDriveTheTank) {
  // From the paper, with one pump: on below 20, off above 50.
  read(
      "Q0 = ((IW0 < 20) || Q0) && !(IW0 > 50);\n//Sim\n"
      "q = 2 * Q0;\nIW0 = h;\nqo = h * 0.03;\nh = h + (q - qo);\n");
  double h = 0;
  std::int64_t level = 0;
  bool pump = false;
  for (std::uint64_t scan = 1; scan <= 300; ++scan) {
    pump = (level < 20 || pump) && level <= 50;
    ASSERT_EQ(after(scan, "Q0"), pump ? 1 : 0) << scan;
    level = static_cast<std::int64_t>(h);
    h = h + ((pump ? 2 : 0) - h * 0.03);
  }
}

TEST_F(PlantTest, AStimulusForItsInputStandsInForThePlant) {
  read("Q0 = IW0 > 1;\n//Sim\nIW0 = 20;\n");
  Stimulus stimulus;
  stimulus.inputs = {cell("IW0")};
  stimulus.steps = {{10, 3, {0}}};
  EXPECT_EQ(simulate(program_, stimulus).steps[0].values[cell("Q0").index()],
            0);
}

TEST_F(PlantTest, OtherInputsComeFromTheStimulus) {
  read("Q0 = IW0 > 1 && I0;\n//Sim\nIW0 = 20;\n");
  Stimulus stimulus;
  stimulus.inputs = {cell("I0")};
  stimulus.steps = {{10, 3, {1}}, {10, 1, {0}}};
  const Trace trace = simulate(program_, stimulus);
  EXPECT_EQ(trace.steps[0].values[cell("Q0").index()], 1);
  EXPECT_EQ(trace.steps[1].values[cell("Q0").index()], 0);
}

TEST_F(PlantTest, ResetStartsThePlantAnew) {
  read("Q0 = IW0 > 1;\n//Var\nh = 5;\n//Sim\nh = h + 1;\nIW0 = h;\n");
  Simulator simulator(program_);
  simulator.run_plant();
  simulator.run_plant();
  EXPECT_EQ(simulator.value(cell("IW0")), 7);
  simulator.reset();
  EXPECT_EQ(simulator.value(cell("IW0")), 0);
  simulator.run_plant();
  EXPECT_EQ(simulator.value(cell("IW0")), 6);
}

}  // namespace
}  // namespace rung
