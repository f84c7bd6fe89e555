#include <gtest/gtest.h>

#include "analysis/simulator.h"
#include "frontend/script/reader.h"
#include "reports/ladder/layout.h"
#include "reports/ladder/power.h"
#include "reports/ladder/svg.h"
#include "reports/ladder/text.h"
#include "tests/reports/page_check.h"

namespace rung {
namespace {

struct Example {
  explicit Example(const std::string& text, const std::string& path = "m.rung")
      : file(sources.add(path, text)),
        program(
            build_program(read_script(sources, file, "", errors), {}, errors)) {
    EXPECT_FALSE(errors.has_errors()) << text;
  }
  SourceSet sources;
  DiagnosticList errors;
  FileId file;
  Program program;
};

std::string ladder(const std::string& text) {
  const Example example(text);
  return draw_ladder(example.sources, example.program, true);
}

std::string picture(const std::string& text,
                    const std::string& path = "m.rung") {
  const Example example(text, path);
  const std::string svg = draw_ladder_svg(example.sources, example.program);
  EXPECT_EQ(test::problems_of(svg), "") << svg;
  return svg;
}

bool contains(const std::string& text, std::string_view part) {
  return text.find(part) != std::string::npos;
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

TEST(LadderSvg, NumbersRungsAndShowsTheirPlaceAndText) {
  const std::string svg =
      picture("// first\nQ0 = I0; Q1 = I0\n  && I1; // rest\n");
  EXPECT_TRUE(contains(svg, ">1  m.rung:2  Q0 = I0<")) << svg;
  EXPECT_TRUE(contains(svg, ">2  m.rung:2  Q1 = I0<")) << svg;
}

TEST(LadderSvg, EscapesWhatHasAMeaningInIt) {
  const std::string svg =
      picture("Q0 = IW0 < 5 && I0;", "</svg>&\xff\x01'\".r");
  EXPECT_TRUE(contains(svg, ">IW0 &lt; 5<")) << svg;
  EXPECT_TRUE(contains(svg,
                       "&lt;/svg&gt;&amp;\\xff\\x01&#39;&quot;.r:1  "
                       "Q0 = IW0 &lt; 5 &amp;&amp; I0<"))
      << svg;
  EXPECT_EQ(svg.find("</svg>"), svg.size() - 7);
}

TEST(LadderSvg, ALongTextIsCut) {
  const std::string svg =
      picture("Q0 = I0 ||" + std::string(5000, ' ') + "I1;");
  EXPECT_TRUE(contains(svg, "…"));
  EXPECT_LT(svg.size(), 2500U);
}

TEST(LadderSvg, AProgramWithoutRungsIsAnEmptyPicture) {
  const std::string svg = picture("// nothing\n");
  EXPECT_TRUE(svg.starts_with("<svg "));
  EXPECT_TRUE(svg.ends_with("</svg>\n"));
}

TEST(Ladder, CoilsStandInOneColumn) {
  const Example example("Q0 = I0;\nQ1 = I0 && I1 && I2;");
  const std::vector<LadderRung> rungs = lay_out_ladder(example.program);
  EXPECT_EQ(rungs[0].width, rungs[1].width);
  EXPECT_EQ(rungs[0].shapes.back().kind, LadderShape::Kind::Coil);
  EXPECT_EQ(rungs[0].shapes.back().x, rungs[1].shapes.back().x);
}

/// Four bits as I0 I1 I2 I3, and IW0 as their number.
void set_inputs(const Program& program, unsigned bits, Simulator& simulator) {
  for (const CellId id : ids_of(program.cells)) {
    const Cell& cell = program.cells[id];
    if (cell.role != CellRole::Input) continue;
    const auto bit = static_cast<unsigned>(cell.name.back() - '0');
    simulator.set_input(id, cell.type == Type::Word ? bits : bits >> bit & 1U);
  }
}

class LadderPower : public testing::TestWithParam<const char*> {};

TEST_P(LadderPower, AtTheCoilIsWhatTheRungGives) {
  const Example example(std::string("Q0 = ") + GetParam() + ";");
  const Rung& rung = example.program.rungs[RungId(0)];
  const LadderRung drawn = lay_out_rung(example.program, rung);
  Simulator simulator(example.program);
  unsigned seen = 0;
  for (unsigned i = 0; i < 512; ++i) {
    set_inputs(example.program, (i / 5 * 2654435761U) >> 28U, simulator);
    simulator.scan(400);
    const RungState state = state_of(example.program, rung, simulator);
    const auto net = static_cast<std::size_t>(drawn.shapes.back().from);
    const bool expected = simulator.node_value(rung.root()) != 0;
    EXPECT_EQ(powered_nets(drawn, state)[net], expected) << i;
    seen |= expected ? 1U : 2U;
  }
  EXPECT_EQ(seen, 3U) << "one outcome only: the example shows nothing";
}

INSTANTIATE_TEST_SUITE_P(
    Expressions, LadderPower,
    testing::Values("I0", "!I0", "I0 && I1 && !I2", "I0 || I1 || I2 && !I3",
                    "(I0 || Q0) && !I1", "(I0 || I1 && (I2 || I3)) && !Q0",
                    "!(I0 || I1)", "!(I0 && !(I1 || I2)) && I3",
                    "I0 && !(I1 || I2)", "I0 != I1", "IW0 < 6 && I0",
                    "T(0, 1, I0 && I1)", "I0 && T(0, 1, I1)",
                    "I3 || T(0, 1, I1 || I2)", "!T(0, 1, I1) || I2",
                    "C(0, 1, I0, I1, I2)", "TOF(0, 1, !(I0 || I1)) && I2"));

/// With a state, every symbol has its value; `-` where it was skipped.
TEST(LadderSvg, ShowsTheValuesOfAScan) {
  const Example example("Q0 = I0 && T(0, 1, I1) || !I2;");
  const Rung& rung = example.program.rungs[RungId(0)];
  Simulator simulator(example.program);
  set_inputs(example.program, 0, simulator);
  simulator.scan(100);
  const RungState state = state_of(example.program, rung, simulator);
  const std::string svg = draw_rung_svg(lay_out_rung(example.program, rung),
                                        &state, "the \"rung\"");
  EXPECT_TRUE(contains(svg, "aria-label=\"the &quot;rung&quot;\"")) << svg;
  std::string values;
  for (std::size_t at = svg.find("class=\"value\""); at != std::string::npos;
       at = svg.find("class=\"value\"", at + 1)) {
    values += svg[svg.find('>', at) + 1];
  }
  EXPECT_EQ(values, "0-01");
  EXPECT_TRUE(contains(svg, "<path data-net=\"0\" class=\"on\""));
}

std::size_t count(const std::string& text, std::string_view part) {
  std::size_t found = 0;
  for (std::size_t at = 0; (at = text.find(part, at)) != std::string::npos;
       ++at) {
    ++found;
  }
  return found;
}

/// What the script of a page goes by: a path a net, a group a symbol with its
/// name and a place for its value, the coil last.
TEST(LadderSvg, NamesNetsAndSymbolsForThePage) {
  const Example example("Q0 = (I0 || Q0) && !I1 && T(0, 5, I2);");
  const LadderRung drawn =
      lay_out_rung(example.program, example.program.rungs[RungId(0)]);
  const std::string svg = draw_rung_svg(drawn, nullptr, "a rung");
  EXPECT_EQ(test::problems_of(svg), "") << svg;
  EXPECT_EQ(count(svg, "<path data-net="), 5U) << svg;
  EXPECT_EQ(count(svg, "<g data-kind="), 5U) << svg;
  EXPECT_EQ(count(svg, " class=\"value\"></text>\n</g>"), 5U) << svg;
  EXPECT_EQ(count(svg, "data-kind=\"contact\""), 2U) << svg;
  EXPECT_EQ(count(svg, "data-kind=\"negated\""), 1U) << svg;
  EXPECT_EQ(count(svg, "data-kind=\"box\""), 1U) << svg;
  EXPECT_GT(svg.find("data-kind=\"coil\""), svg.rfind("data-kind=\"box\""));
  EXPECT_FALSE(contains(svg, "data-behind"));
}

TEST(LadderSvg, ABoxBehindItsInputSaysSo) {
  const Example example("Q0 = T(0, 5, I0);");
  const LadderRung drawn =
      lay_out_rung(example.program, example.program.rungs[RungId(0)]);
  EXPECT_TRUE(contains(draw_rung_svg(drawn, nullptr, ""),
                       "data-to=\"2\" data-behind=\"1\""));
}

}  // namespace
}  // namespace rung
