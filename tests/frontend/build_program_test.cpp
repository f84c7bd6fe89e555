#include <gtest/gtest.h>

#include "dump.h"

namespace rung::test {
namespace {

// Program 1 of Sensors and Materials 32(12), 2020.
TEST(BuildProgram, StartStopOfTheYunPaper) {
  Built out;
  build(
      "//input Conf.\ny4 = pin4; y3 = pin5;\n//Rung\n"
      "y5 = (y5||y1)&&!y4;\n//Output\npin3 = y5;\n",
      "", out);
  ASSERT_TRUE(out.diagnostics.empty());
  EXPECT_EQ(out.program.dialect, "yun");
  EXPECT_EQ(out.program.evaluation, Evaluation::Strict);
  ASSERT_EQ(out.program.rungs.size(), 4U);
  EXPECT_EQ(dump(out.program, RungId(2)), "y5 y1 || y4 ! &&");
  EXPECT_EQ(out.program.cells[find_cell(out.program, "pin4")].role,
            CellRole::Input);
  EXPECT_EQ(out.program.cells[find_cell(out.program, "pin3")].role,
            CellRole::Output);
  EXPECT_EQ(out.program.cells[find_cell(out.program, "y5")].role,
            CellRole::Memory);
}

}  // namespace
}  // namespace rung::test
