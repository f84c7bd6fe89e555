#include <gtest/gtest.h>

#include "frontend/script/reader.h"
#include "reports/ladder/layout.h"
#include "reports/ladder/text.h"

namespace rung {
namespace {

std::string ladder(const std::string& text) {
  SourceSet sources;
  DiagnosticList errors;
  const FileId file = sources.add("m.rung", text);
  const Program program =
      build_program(read_script(sources, file, "", errors), {}, errors);
  EXPECT_FALSE(errors.has_errors());
  return draw_ladder(sources, program, true);
}

TEST(Ladder, SeriesAndBranches) {
  EXPECT_EQ(ladder("Q0 = (I0 || Q0) && !I1;"), R"(  1 m.rung:1
    |   I0      I1     Q0
    +--| |---+-|/|----( )--+
    |   Q0   |
    +--| |---+

)");
}

TEST(Ladder, ThreeBranchesShareTheirRisers) {
  EXPECT_EQ(ladder("Q0 = I0 || I1 && I2 || I3;"), R"(  1 m.rung:1
    |   I0             Q0
    +--| |----------+-( )--+
    |   I1     I2   |
    +--| |----| |---+
    |   I3          |
    +--| |----------+

)");
}

TEST(Ladder, AnElementAtTheRailIsDrawnBehindItsInput) {
  EXPECT_EQ(ladder("Q0 = T(0, 5, I0 && I1);"), R"(  1 m.rung:1
    |  I0     I1                     Q0
    +-| |----| |----[T(0) 5.0 s]----( )--+

)");
}

// Drawn behind `I1` the timer would run only while `I1` is on.
TEST(Ladder, AnElementBehindAContactKeepsItsInputInItsBox) {
  EXPECT_EQ(ladder("Q0 = I1 && T(0, 5, I0);"), R"(  1 m.rung:1
    |  I1                         Q0
    +-| |----[T(0) 5.0 s, I0]----( )--+

)");
}

TEST(Ladder, AnInnerNegationIsABox) {
  EXPECT_EQ(ladder("Q0 = I1 && !(I0 || I2);"), R"(  1 m.rung:1
    |  I1                      Q0
    +-| |----[!(I0 || I2)]----( )--+

)");
}

TEST(Ladder, WordsAndComparisonsAreBoxes) {
  EXPECT_EQ(ladder("Q0 = IW0 < 20 && I0;\nQW0 = (IW0 + 1) * 2;"),
            R"(  1 m.rung:1
    |                I0     Q0
    +-[IW0 < 20]----| |----( )--+

  2 m.rung:2
    |                      QW0
    +-[(IW0 + 1) * 2]------( )--+

)");
}

TEST(Ladder, WhatIsTooDeepIsItsText) {
  std::string deep = "Q0 = ";
  for (int i = 0; i < 500; ++i) deep += "(I0 && ";
  deep += "I1" + std::string(500, ')') + ";";
  const std::string drawn = ladder(deep);
  EXPECT_NE(drawn.find("...]"), std::string::npos);
  EXPECT_LT(drawn.size(), 1000U);
}

TEST(Ladder, TheSvgHasEverySymbol) {
  SourceSet sources;
  DiagnosticList errors;
  const FileId file = sources.add("m.rung", "Q0 = (I0 || IW0 < 5) && !I1;");
  const Program program =
      build_program(read_script(sources, file, "", errors), {}, errors);
  const std::string svg = draw_ladder_svg(program);
  EXPECT_TRUE(svg.starts_with("<svg "));
  EXPECT_TRUE(svg.ends_with("</svg>\n"));
  EXPECT_NE(svg.find(">IW0 &lt; 5<"), std::string::npos);
  EXPECT_NE(svg.find("<circle"), std::string::npos);
}

}  // namespace
}  // namespace rung
