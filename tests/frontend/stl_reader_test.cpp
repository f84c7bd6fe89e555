#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "analysis/program.h"
#include "analysis/simulator.h"
#include "declared_text.h"
#include "frontend/recognise.h"
#include "frontend/stl/literals.h"
#include "frontend/stl/reader.h"

namespace rung::test {
namespace {

struct Text : DeclaredText {
  explicit Text(std::string text) : DeclaredText("stl", std::move(text)) {}
};

struct Row {
  std::string_view body;
  std::string_view expected;
};

TEST(StlReader, ReadsBitLogic) {
  const std::vector<Row> table = {
      {"NOP 0", ""},
      {"U E 0.0\n= A 0.0", "A0.0=E0.0"},
      {"A I0.0; AN I 0.1; =Q0.0;", "Q0.0=(&& I0.0 (! I0.1))"},
      {"u e 0.0 // one\n\n= a 0.0", "A0.0=E0.0"},
      // /FC: a query behind an assignment begins a new result.
      {"U E 0.0\nU E 0.1\n= A 0.0\nO E 0.2\nON E 0.3\n= A 0.1",
       "A0.0=(&& E0.0 E0.1) | A0.1=(|| E0.2 (! E0.3))"},
      {"U E 0.0\nX E 0.1\nXN E 0.2\n= A 0.0",
       "A0.0=(^ (^ E0.0 E0.1) (! E0.2))"},
      // AND before OR.
      {"U E 0.0\nU E 0.1\nO\nU E 0.2\nUN E 0.3\n= A 0.0",
       "A0.0=(|| (&& E0.0 E0.1) (&& E0.2 (! E0.3)))"},
      {"U E 0.0\nO\nU E 0.1\nO\nU E 0.2\n= A 0.0",
       "A0.0=(|| (|| E0.0 E0.1) E0.2)"},
      // `O` alone behind an assignment has nothing to join.
      {"U E 0.0\n= A 0.0\nO\nU E 0.1\n= A 0.1",
       "result.1=E0.0 | A0.0=result.1"
       " | A0.1=E0.1"},
      // Parentheses.
      {"U(\nO E 0.0\nO E 0.1\n)\nU E 0.2\n= A 0.0",
       "A0.0=(&& (|| E0.0 E0.1) E0.2)"},
      {"U E 0.0\nUN(\nU E 0.1\nU E 0.2\n)\n= A 0.0",
       "result.1=E0.0 | A0.0=(&& result.1 (! (&& E0.1 E0.2)))"},
      {"U E 0.0\nO\nU(\nO E 0.1\nO E 0.2\n)\n= A 0.0",
       "result.1=E0.0 | A0.0=(|| result.1 (|| E0.1 E0.2))"},
      // What an assignment changes is kept where it is looked at again.
      {"UN M 0.0\n= M 0.0\n= M 0.1",
       "result.1=(! M0.0) | M0.0=result.1 | "
       "M0.1=result.1"},
      {"U E 0.0\nS A 0.0\nU E 0.1\nR A 0.0",
       "A0.0=(|| E0.0 A0.0) | A0.0=(&& (! E0.1) A0.0)"},
      {"SET\n= A 0.0\nCLR\n= A 0.1\nNOT\n= A 0.2",
       "A0.0=true | A0.1=false | A0.2=(! false)"},
      {"U E 0.0\nFP M 0.0\n= A 0.0",
       "result.1=E0.0 | edge.2=M0.0 | M0.0=result.1 | "
       "A0.0=(&& result.1 (! edge.2))"},
      {"U E 0.0\nFN M 0.0\n= A 0.0",
       "result.1=E0.0 | edge.2=M0.0 | M0.0=result.1 | "
       "A0.0=(&& (! result.1) edge.2)"},
      {"U E 0.0\nSAVE\nU E 0.1\nU BIE\n= A 0.0",
       "result.1=E0.0 | A0.0=(&& (&& result.1 E0.1) result.1)"},
      {"U E 0.0\n= L 0.0\nU L 0.0\nBLD 102\nUN E 0.1\n= A 0.0",
       "L0.0=E0.0 | A0.0=(&& L0.0 (! E0.1))"},
      // Master control: `=` writes 0, S and R do nothing.
      {"MCRA\nU E 0.0\nMCR(\nU E 0.1\n= A 0.0\nU E 0.2\nS A 0.1\n)MCR\nMCRD",
       "result.1=E0.0 | A0.0=(&& E0.1 result.1) | "
       "result.2=E0.2 | A0.1=(|| (&& result.2 result.1) A0.1)"},
      // Words.
      {"L MW 2\nL 9\n>=I\n= A 0.0", "accu.1=MW2 | A0.0=(>= accu.1 9)"},
      {"L MW 2\nL 1\n+I\nT MW 2",
       "accu.1=MW2 | accu.2=(wrap16 (+ accu.1 1)) | MW2=accu.2"},
      {"L 5\nL 3\nTAK\n-I\nT MB 0",
       "accu.1=(wrap16 (- 3 5)) | value.2=accu.1 "
       "| bits.3=(+ value.2 (* (to_word (< value.2 0)) 65536)) | "
       "MB0=(- bits.3 (* (/ bits.3 256) 256))"},
      // Overlapping: the cells are bits.
      {"L B#16#81\nT MB 0\nU M 0.7\n= A 0.0",
       "M0.0=true | M0.1=false | M0.2=false | M0.3=false | M0.4=false | "
       "M0.5=false | M0.6=false | M0.7=true | A0.0=M0.7"},
      {"L W#16#1234\nT MW 0\nL MB 1\nT MB 5",
       "MB0=18 | MB1=52 | accu.1=MB1 | value.2=accu.1 | "
       "bits.3=(+ value.2 (* (to_word (< value.2 0)) 65536)) | "
       "MB5=(- bits.3 (* (/ bits.3 256) 256))"},
      // Timers and counters.
      {"U E 0.0\nL S5T#2S\nSE T 1\nU T 1\n= A 0.0",
       "step.1=(SE E0.0 0 2000) | status.2=(SE.Q 0 2000) | A0.0=status.2"},
      {"A I 0.0\nL S5T#2S\nSE T 1", "step.1=(SV I0.0 0 2000)"},
      {"U E 0.0\nL C#10\nS Z 1\nZV Z 1\nU Z 1\n= A 0.0",
       "step.1=(Z.S E0.0 10 0) | step.2=(Z.UP E0.0 0) | status.3=(Z.Q 0) | "
       "A0.0=status.3"},
      // Jumps.
      {"U E 0.0\nSPB on\nU E 0.1\n= A 0.0\non: U E 0.2\n= A 0.1",
       "result.1=E0.0 | run.2=(! result.1) | result.3=E0.1 | "
       "A0.0=(|| (&& run.2 result.3) (&& (! run.2) A0.0)) | A0.1=E0.2"},
      {"U E 0.0\nBEB\nU E 0.1\n= A 0.0",
       "result.1=E0.0 | run.2=(! result.1) | "
       "A0.0=(|| (&& run.2 E0.1) (&& (! run.2) A0.0))"},
  };
  for (const Row& row : table) {
    const Text text{std::string(row.body)};
    EXPECT_EQ(text.problems(), "") << row.body;
    EXPECT_EQ(text.rungs(), row.expected) << row.body;
  }
}

TEST(StlReader, RefusesWithNameAndPlace) {
  const std::vector<Row> table = {
      {"LD E 0.0", "RP040 1:1 `LD` is no instruction"},
      {"U E 0.0\nRLD 3", "RP040 2:1 `RLD`"},
      {"SPL x", "RP040"},
      {"L S5T#1S\nSE T 1", "RP040 2:1 `SE` is an on-delay in German"},
      {"CC FC 1", "RP040"},
      {"U", "RP047 1:1 `U` has 1 operands"},
      {"U E 0.0, E 0.1", "RP047"},
      {"U E 0.8", "RP044 1:3 `E0.8` is no bit"},
      {"U EB 0", "RP044"},
      {"U DBX 0.0", "RP044"},
      {"U \"motor\"", "RP041 1:3 `\"MOTOR\"` is a symbol"},
      {"U #in", "RP041"},
      {"U E 70000.0", "RP044"},
      {"U T 1", "RP041 1:3 `T1` is started nowhere"},
      {"SET\n= E 0.0", "RP044 2:3 `E0.0` is an input"},
      {"SET\nS EB 0", "RP044"},
      {"L 1\nT EB 0", "RP044"},
      {"L 1\nT M 0.0", "RP044"},
      {"L MW 0\nT STW", "RP043"},
      {"U L 0.0\n= A 0.0", "RP044 1:3 local data is read before"},
      {"U E 0.0\nSPB x\n= L 0.0\nx: U L 0.0\n= A 0.0", "RP044 4:6 local data"},
      {"L 40000", "RP043 1:3 `40000` cannot be loaded"},
      {"L 1.5", "RP043"},
      {"L P#M0.0", "RP043"},
      {"L C#1000", "RP043"},
      {"L S5T#1", "RP043"},
      {"L S5T#12345MS", "RP043"},
      {"L S5T#3H", "RP043"},
      {"L 2#2", "RP043"},
      {"L T 1", "RP041"},
      {"T MW 0", "RP048 1:1 an accumulator has no value"},
      {"L 1\n==I", "RP048"},
      {"L MD 0\nL MD 4\n+I", "RP043"},
      {"U E 0.0\nL MW 0\nSV T 1", "RP045"},
      {"U E 0.0\nL S5T#1S\nSV T 1\nL S5T#2S\nSV T 1", "RP045 5:1 this timer"},
      {"U E 0.0\nL S5T#1S\nSV T 1\nSI T 1", "RP045"},
      {"U E 0.0\nL W#16#9999\nS Z 1", "RP045"},
      {"U E 0.0\nFR T 1", "RP04"},
      {"U(\nU E 0.0", "RP047 1:1 this parenthesis is not closed"},
      {")", "RP047 1:1 this parenthesis closes nothing"},
      {"U(\nU(\nU(\nU(\nU(\nU(\nU(\nU(\n", "RP047 8:1 more than 7"},
      {"U E 0.0\nO\nNOT\n= A 0.0", "RP047"},
      {"SPA x", "RP046 1:5 there is no label `X`"},
      {"x: SET\nSPA x", "RP046 2:5 a jump back"},
      {"x: SET\nx: CLR", "RP046 2:1 the label `X` stands here a second"},
      {"U(\nU E 0.0\nSPB x\n)\nx: SET", "RP046"},
      {"U(\nU E 0.0\nBEB\n)", "RP046"},
      {"U E 0.0\nSPB a\nU E 0.1\nSPA x\na: SET\nx: = A 0.0", "RP048 6:1"},
      {"MCR(\nU E 0.0\n= A 0.0", "RP047"},
      {")MCR", "RP047"},
      {"MCRA\nSET\nMCR(\nL 1\nT MW 0\n)MCR", "RP040"},
      {"CALL FC 1", "RP041 1:6 a call of `FC1` is not supported"},
      {"CALL SFC 47 (", "RP041"},
      {"CALL FB 1, DB 1", "RP047"},
      {"SPO x\nx: SET", "RP040"},
      {"__SLEEP 100", "RP040"},
      {"L 1\nL 2\n+I\n__ASSERT== __STW OV, 0", "RP044"},
      {"__ASSERT== __STW XX, 0", "RP044"},
      {"__ASSERT== __AR 1, 0", "RP044"},
      {"FUNCTION_BLOCK FB 1\nBEGIN\nEND_FUNCTION_BLOCK", "RP041 1:1"},
      {"DATA_BLOCK DB 1\nBEGIN\nEND_DATA_BLOCK", "RP041"},
      {"ORGANIZATION_BLOCK OB 35\nBEGIN\nEND_ORGANIZATION_BLOCK", "RP04"},
      {"ORGANIZATION_BLOCK OB 1\nBEGIN\n", "RP042 1:1 this block has no end"},
      {"ORGANIZATION_BLOCK OB 1\nBEGIN\nEND_ORGANIZATION_BLOCK\nSET",
       "RP042 1:1 instructions stand below"},
      {"ORGANIZATION_BLOCK OB 1\nSET\nBEGIN\nEND_ORGANIZATION_BLOCK",
       "RP042 2:1 `SET` above `BEGIN`"},
      {"FUNCTION FC 1 : VOID\nBEGIN\nEND_FUNCTION",
       "RP041 1:1 `FC1` is called"},
      {"FUNCTION FC 1 : INT\nBEGIN\nEND_FUNCTION", "RP041 1:1 a function with"},
      {"<?xml version=\"1.0\"?>", "RP041 1:1 this is XML"},
      {"SET\x01", "RP001"},
  };
  for (const Row& row : table) {
    const Text text{std::string(row.body)};
    EXPECT_NE(text.problems().find(row.expected), std::string::npos)
        << row.body << "\n"
        << text.problems();
  }
}

std::string function(std::string_view number, std::string_view body) {
  return "FUNCTION FC " + std::string(number) +
         " : VOID\nVAR_TEMP\n x : INT;\n"
         "END_VAR\nBEGIN\nNETWORK\nTITLE = one; two\n" +
         std::string(body) + "\nEND_FUNCTION\n";
}
std::string cycle(std::string_view body) {
  return "ORGANIZATION_BLOCK OB 1\nVERSION : 0.1\nBEGIN\n" + std::string(body) +
         "\nEND_ORGANIZATION_BLOCK\n";
}

TEST(StlReader, PutsCallsInTheirPlace) {
  const Text text(function("1", "U E 0.0\nSPBN m\nBEA\nm: = A 0.0") +
                  function("2", "CALL FC 1\nU E 0.1\n= A 0.1") +
                  cycle("UC FC 2\nCALL FC 2"));
  EXPECT_EQ(text.problems(), "");
  const std::string once =
      "result.1=E0.0 | run.2=(! (! result.1)) | run.3=(&& (! true) run.2) | "
      "run.4=(|| run.3 (! run.2)) | A0.0=";
  EXPECT_EQ(text.rungs().substr(0, once.size()), once) << text.rungs();
  EXPECT_NE(Text(function("1", "CALL FC 1") + cycle("CALL FC 1"))
                .problems()
                .find("calls in a circle"),
            std::string::npos);
}

/// Calls that double eight times are short; a text cannot make them long.
TEST(StlReader, BoundsCalls) {
  std::string text;
  for (int i = 1; i < 9; ++i) {
    std::string body;
    for (int k = 0; k < 9; ++k)
      body += "CALL FC " + std::to_string(i + 1) + "\n";
    text += function(std::to_string(i), body);
  }
  text += function("9", "SET\n= A 0.0") + cycle("CALL FC 1");
  EXPECT_NE(Text(text).problems().find("RP04"), std::string::npos);
}

/// Cells of the program after each scan of 100 ms, in which E0.0 and E0.1 are
/// as the pairs say.
std::string run(const Text& text, const std::vector<std::string>& inputs,
                const std::vector<std::string>& cells) {
  Simulator simulator(text.program);
  std::string result;
  for (const std::string& values : inputs) {
    for (std::size_t i = 0; i < values.size(); ++i) {
      const CellId cell = find_cell(text.program, "E0." + std::to_string(i));
      if (cell.has_value()) simulator.set_input(cell, values[i] - '0');
    }
    simulator.scan(100);
    if (!result.empty()) result += ' ';
    for (const std::string& name : cells) {
      const CellId cell = find_cell(text.program, name);
      EXPECT_TRUE(cell.has_value()) << name;
      result += std::to_string(simulator.value(cell));
    }
  }
  return result;
}

TEST(StlReader, TimersRunAsTheirDiagramsShow) {
  const auto timer = [](std::string_view name, const std::string& scans) {
    const Text text("U E 0.0\nL S5T#200MS\n" + std::string(name) +
                    " T 1\nU E 0.1\nR T 1\nU T 1\n= A 0.0\nU E 7.0\n= A 7.0");
    EXPECT_EQ(text.problems(), "");
    std::vector<std::string> inputs;
    for (const char c : scans) {
      inputs.push_back(c == 'R' ? "11" : std::string{c, '0'});
    }
    std::string seen = run(text, inputs, {"A0.0"});
    std::erase(seen, ' ');
    return seen;
  };
  EXPECT_EQ(timer("SI", "0111101011R1"), "011000101100");
  EXPECT_EQ(timer("SV", "010001010001R"), "0110011110010");
  EXPECT_EQ(timer("SE", "01110111110"), "00010001110");
  EXPECT_EQ(timer("SS", "0100010100011R1"), "000111111111100");
  EXPECT_EQ(timer("SA", "0110001010000"), "0111101111100");
}

TEST(StlReader, CountersSaturate) {
  const Text text(
      "U E 0.0\nZV Z 1\nU E 0.1\nZR Z 1\nU Z 1\n= A 0.0\nL Z 1\nT MW 2");
  EXPECT_EQ(text.problems(), "");
  EXPECT_EQ(run(text, {"01", "00", "10", "10", "00", "10", "01", "00", "01"},
                {"A0.0", "MW2"}),
            "00 00 11 11 11 12 11 11 00");
}

TEST(StlReader, StopEndsAllScans) {
  const Text text("U E 0.0\nSPBN on\nCALL SFC 46\non: L MW 0\nL 1\n+I\nT MW 0");
  EXPECT_EQ(text.problems(), "");
  EXPECT_EQ(run(text, {"00", "00", "10", "00"}, {"MW0"}), "1 2 2 2");
}

TEST(StlReader, StartupRunsOnce) {
  const Text text(
      "ORGANIZATION_BLOCK OB 100\nBEGIN\nSET\n= M 0.0\n"
      "END_ORGANIZATION_BLOCK\n" +
      cycle("U M 0.0\n= A 0.0\nU E 0.0\nR M 0.0"));
  EXPECT_EQ(text.problems(), "");
  EXPECT_EQ(run(text, {"10", "00", "00"}, {"A0.0"}), "1 0 0");
}

/// The result of the path that was taken, also where a label is between.
TEST(StlReader, PathsMeetWithTheirResults) {
  const Text text(
      "U E 0.0\nSPB one\nSET\nSPA two\none: CLR\ntwo: = A 0.0\nU E 0.1\n"
      "= A 0.1");
  EXPECT_EQ(text.problems(), "");
  EXPECT_EQ(run(text, {"00", "10", "01", "11"}, {"A0.0", "A0.1"}),
            "10 00 11 01");
}

TEST(StlReader, WordsAndTheirBitsAreOne) {
  const Text text(
      "L MW 0\nL 1\n+I\nT MW 0\nU M 1.0\n= A 0.0\nU M 1.1\n= A 0.1\n"
      "L MB 1\nT AB 4\nL MD 0\nT MD 4\nL MD 4\nL MD 0\n==D\n= A 0.2");
  EXPECT_EQ(text.problems(), "");
  EXPECT_EQ(run(text, {"0", "0", "0", "0"}, {"A0.0", "A0.1", "A0.2", "AB4"}),
            "1011 0112 1113 0014");
}

TEST(StlReader, Literals) {
  EXPECT_EQ(stl::literal_of("-1"), 0xffffU);
  EXPECT_EQ(stl::literal_of("L#-1"), 0xffff'ffffU);
  EXPECT_EQ(stl::literal_of("C#123"), 0x123U);
  EXPECT_EQ(stl::literal_of("S5T#200MS"), 0x020U);
  EXPECT_EQ(stl::literal_of("S5T#1M40S"), 0x2100U);
  EXPECT_EQ(stl::literal_of("S5TIME#2H"), 0x3720U);
  EXPECT_EQ(stl::literal_of("S5T#1S1M"), std::nullopt);
  EXPECT_EQ(stl::literal_of(""), std::nullopt);
  EXPECT_EQ(stl::s5time_of(0x3720), 7'200'000);
  EXPECT_EQ(stl::s5time_of(0x00a0), std::nullopt);
  EXPECT_EQ(stl::count_of(0x999), 999);
  EXPECT_EQ(stl::count_of(0x1000), std::nullopt);
}

TEST(StlReader, IsRecognised) {
  for (const std::string_view text :
       {"U E 0.0\n= A 0.0", "// a list\n\tL 5\n\tU M 0.0",
        "ORGANIZATION_BLOCK OB 1\nBEGIN\nEND_ORGANIZATION_BLOCK",
        "FUNCTION FC 1 : VOID\nBEGIN\nEND_FUNCTION", "A I 0.0\n= Q 0.0",
        "U(\nU E 0.0\n)", "n: U E 0.0"}) {
    EXPECT_EQ(recognise(text).name, "stl") << text;
  }
  for (const std::string_view text :
       {"U = I0;", "A = I0 && I1;", "LD X0\nOUT Y0", "LD a\nST b",
        "FUNCTION f : INT\nVAR END_VAR\nEND_FUNCTION", "L = 3;", "", "SET",
        "Q0 = I0;"}) {
    EXPECT_NE(recognise(text).name, "stl") << text;
  }
}

}  // namespace
}  // namespace rung::test
