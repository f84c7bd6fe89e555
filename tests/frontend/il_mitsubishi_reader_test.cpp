#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "analysis/program.h"
#include "analysis/simulator.h"
#include "declared_text.h"
#include "dump.h"
#include "frontend/il_mitsubishi/reader.h"
#include "frontend/recognise.h"

namespace rung::test {
namespace {

struct Text : DeclaredText {
  explicit Text(std::string text)
      : DeclaredText("il-mitsubishi", std::move(text)) {}
};

struct Row {
  std::string_view body;
  std::string_view expected;
};

TEST(IlMitsubishiReader, ReadsInstructions) {
  const std::vector<Row> table = {
      {"", ""},
      {"LD X0\nOUT Y0", "Y0=X0"},
      {"0 LD X000\n1 OUT Y001\n2 END\n", "Y001=X000"},
      {"ldi X1 ; a comment\n\tand M0 // another\nout Y0", "Y0=(&& (! X1) M0)"},
      {"LD X0\nANI X1\nORI M8000\nINV\nOUT M7",
       "M7=(! (|| (&& X0 (! X1)) (! true)))"},
      // X001 and X1 are one device, named as it is met first.
      {"LD X001\nAND X1\nOUT Y0", "Y0=(&& X001 X001)"},
      // Blocks.
      {"LD X0\nOR X1\nLD X2\nOR X3\nANB\nOUT Y0",
       "Y0=(&& (|| X0 X1) (|| X2 X3))"},
      {"LD X0\nAND X1\nLD X2\nAND X3\nORB\nANI X4\nOUT Y0",
       "Y0=(&& (|| (&& X0 X1) (&& X2 X3)) (! X4))"},
      {"LD X0\nLD X1\nLD X2\nORB\nANB\nOUT Y0", "Y0=(&& X0 (|| X1 X2))"},
      // Branches.
      {"LD X0\nMPS\nAND X1\nOUT Y0\nMRD\nAND X2\nOUT Y1\nMPP\nOUT Y2",
       "result.1=X0 | Y0=(&& result.1 X1) | Y1=(&& result.1 X2) | Y2=result.1"},
      {"LD X0\nMPS\nLD X1\nOR X2\nANB\nOUT Y0\nMPP\nOUT Y1",
       "result.1=X0 | Y0=(&& result.1 (|| X1 X2)) | Y1=result.1"},
      // What outlives an output is kept: Y0 may stand in it.
      {"LDI Y0\nOUT Y0\nOUT Y1", "result.1=(! Y0) | Y0=result.1 | Y1=result.1"},
      {"LD X0\nOUT Y0\nNOP\nAND Y0\nOUT Y1",
       "result.1=X0 | Y0=result.1 | Y1=(&& result.1 Y0)"},
      // Outputs.
      {"LD X0\nSET M0\nLD X1\nRST M0", "M0=(|| X0 M0) | M0=(&& (! X1) M0)"},
      {"LD X0\nPLS M0\nLD X0\nPLF M1", "M0=(RISE X0 0) | M1=(FALL X0 1)"},
      {"LDP X0\nORF X1\nOUT Y0",
       "edge.1=(RISE X0 0) | edge.2=(FALL X1 1) | Y0=(|| edge.1 edge.2)"},
      {"LD X0\nOUTI Y0\nLD X0\nXOR X1\nXORI X2\nOUT Y1",
       "Y0=(! X0) | Y1=(^ (^ X0 X1) (! X2))"},
      // Timers and counters.
      {"LD X0\nOUT T0 K50\nLD T0\nOUT Y0", "T0=(OUT.T X0 0 5000) | Y0=T0"},
      {"LD X0\nOUT T200 K50", "T200=(OUT.T X0 0 500)"},
      {"LD X0\nOUT T246 K50\nLD X1\nRST T246",
       "T246=(OUT.TR X0 0 50) | T246=(RST.TR X1 0)"},
      {"LD X0\nOUT T255 H10", "T255=(OUT.TR X0 0 1600)"},
      {"LD X0\nRST C0\nLD X1\nOUT C0 K0",
       "C0=(RST.C X0 0) | C0=(OUT.C X1 0 1)"},
      {"LD X0\nOUT C0 K5\nLD>= C0 K3\nAND< D4 K-7\nOUT Y0",
       "C0=(OUT.C X0 0 5) | Y0=(&& (>= (C.VALUE 0) 3) (< D4 -7))"},
      // Zones: outputs have no power where the master control has none.
      {"LD X0\nMC N0 M100\nLD X1\nOUT Y0\nLD X2\nSET Y1\nMCR N0\nLD X3\nOUT Y2",
       "zone.1=X0 | M100=zone.1 | Y0=(&& X1 zone.1) | "
       "Y1=(|| (&& X2 zone.1) Y1) | Y2=X3"},
      {"LD X0\nMC N0 M0\nLD X1\nMC N1 M1\nLDI X2\nOUT T0 K1\nMCR N1\nMCR N0",
       "zone.1=X0 | M0=zone.1 | zone.2=(&& X1 zone.1) | M1=zone.2 | "
       "T0=(OUT.T (&& (! X2) zone.2) 0 100)"},
      {"LD X0\nMC N0 M0\nLD X1\nOUTI Y0\nMCR N0",
       "zone.1=X0 | M0=zone.1 | Y0=(&& (! X1) zone.1)"},
      // Special relays.
      {"LD M8002\nORI M8003\nAND M8013\nANI M8001\nOUT Y0",
       "M8002=first.1 | first.1=false | "
       "Y0=(&& (&& (|| M8002 (! (! M8002))) M8013) (! false))"},
  };
  for (const Row& row : table) {
    const Text text{std::string(row.body)};
    EXPECT_EQ(text.problems(), "") << row.body;
    EXPECT_EQ(text.rungs(), row.expected) << row.body;
  }
}

TEST(IlMitsubishiReader, RefusesWithNameAndPlace) {
  const std::string deep = [] {
    std::string text = "LD X0\n";
    for (int i = 0; i < 12; ++i) text += "MPS\n";
    return text + "OUT Y0";
  }();
  const std::vector<Row> table = {
      {"LDN X0", "RP040 1:1 `LDN` is no instruction that is supported (did"},
      {"MOV K1 D0", "RP040 1:1 `MOV` is no instruction"},
      {"LD X0\nCJ P0", "RP040 2:1 `CJ`"},
      {"STL S20", "RP040 1:1 `STL`"},
      {"LD X0 X1", "RP047 1:1 `LD` has 1 operands, and here 2 are given"},
      {"LD", "RP047 1:1"},
      {"LD X0\nANB X1", "RP047 2:1"},
      {"LD X0\nOUT Y0 K1 K2 K3 K4 K5", "RP047 2:1"},
      {"LD X8", "RP044 1:4 `X8` is no device: there are X0 to X377"},
      {"LD Y19", "RP044 1:4"},
      {"LD X400", "RP044 1:4"},
      {"LD T256", "RP044 1:4"},
      {"LD C200", "RP044 1:4 `C200` is no device: there are C0 to C199"},
      {"LD M99999999999", "RP044 1:4"},
      {"LD X-1", "RP044 1:4"},
      {"LD X0.1", "RP044 1:4"},
      {"LD M8011", "RP044 1:4 `M8011` is not supported"},
      {"LD M7700", "RP044 1:4"},
      {"LD Q0", "RP041 1:4 `Q0` is no device that is supported"},
      {"LD X", "RP041 1:4"},
      {"LD D0", "RP049 1:4 `D0` is a register"},
      {"LD X0\nOUT X1", "RP044 2:5 `X1` is an input"},
      {"LD X0\nSET M8000", "RP044 2:5 `M8000` is an input or a special relay"},
      {"LD X0\nOUT M8013", "RP044 2:5"},
      {"LD X0\nRST D0", "RP044 2:5 `D0` is a register"},
      {"LD X0\nOUT Y0 K5", "RP047 2:8 `Y0` takes no preset"},
      {"LD X0\nOUT T0", "RP045 2:1 `T0` needs a preset"},
      {"LD X0\nOUT T0 D0", "RP045 2:8 the preset `D0` is not supported"},
      {"LD X0\nOUT T0 K-1", "RP045 2:8"},
      {"LD X0\nOUT T0 K32768", "RP045 2:8"},
      {"LD X0\nOUT T0 50", "RP045 2:8"},
      {"LD X0\nOUT C0 H", "RP045 2:8"},
      {"LD X0\nSET T0", "RP049 2:5 `SET` cannot write a timer or counter"},
      {"LD X0\nOUTI C0", "RP049 2:6"},
      {"LD= T0 K5", "RP049 1:5 `T0` cannot be compared"},
      {"LD= K5 X0", "RP049 1:8"},
      {"LD= K5 K99999", "RP041 1:8"},
      {"AND X0", "RP048 1:1 there is no result here"},
      {"OUT Y0", "RP048 1:1"},
      {"MPS", "RP048 1:1"},
      {"LD X0\nANB", "RP047 2:1 there is one block only"},
      {"LD X0\nORB", "RP047 2:1"},
      {"LD X0\nLD X1\nOUT Y0", "RP047 3:1 2 blocks stand here side by side"},
      {"LD X0\nMPP\nOUT Y0", "RP047 2:1 no `MPS` is open"},
      {"LD X0\nMPS\nMRD\nOUT Y0", "RP047 3:1 no output takes the result"},
      {"LD X0\nMPS\nOUT Y0\nLD X1\nOUT Y1", "RP047 2:1 this `MPS` has no"},
      {"LD X0\nMPS\nOUT Y0", "RP047 2:1 this `MPS` has no `MPP`"},
      {deep, "RP047 13:1 more than 11 `MPS` are open"},
      {"LD X0", "RP047 1:1 no output takes the result of this circuit"},
      {"LD X0\nEND", "RP047 1:1"},
      {"END\nLD X0", "RP047 2:1 an instruction stands below `END`"},
      {"MCR N0", "RP047 1:1 no `MC` is open"},
      {"LD X0\nMC N0 M0\nLD X1\nOUT Y0", "RP047 2:1 this `MC` has no `MCR`"},
      {"LD X0\nMC N8 M0", "RP047 2:4 `N8` is no level"},
      {"LD X0\nMC N1 M0\nLD X1\nMC N1 M1", "RP047 4:4 the levels of zones"},
      {"LD X0\nMC N0 M0\nLD X1\nMC N1 M1\nMCR N0", "RP047 5:1 the innermost"},
      {"LD X0\nMC N0 S0", "RP049 2:7 the relay of an `MC` is an M or a Y"},
      {"LD X0\nMC N0 M0\nLD X1\nOUT M0\nMCR N0", "RP047 4:5 `M0` is the relay"},
      {"LD X0\nOUT M0\nLD X0\nMC N0 M0\nMCR N0", "RP047 4:7 `M0` is the"},
      {"LD X0\nMC N0 M0\nAND X1\nOUT Y0", "RP048 3:1"},
      {"LD X0\nMC N0 M0\nLD X1\nMCR N0", "RP047 3:1 no output takes"},
      {"LD X0\x01", "RP001"},
  };
  for (const Row& row : table) {
    const Text text{std::string(row.body)};
    EXPECT_NE(text.problems().find(row.expected), std::string::npos)
        << row.body << "\n"
        << text.problems();
  }
}

TEST(IlMitsubishiReader, SaysAllErrorsInOneRun) {
  const Text text("LD X9\nOUT Y0\nFOO\nLD X0\nOUT X1\nLD X0\nOUT Y0\n");
  EXPECT_EQ(text.list.items().size(), 3U) << text.problems();
}

TEST(IlMitsubishiReader, Roles) {
  const Text text(
      ";@ language il-mitsubishi\n;@ never Y0 && Y1\n//@ never Y1\nLD X0\n"
      "AND M8013\nAND= D0 K1\nOUT Y0\nLD Y0\nOUT M0");
  ASSERT_EQ(text.problems(), "");
  ASSERT_EQ(text.ast.annotations.size(), 2U);
  EXPECT_EQ(text.ast.annotations[0].text, "never Y0 && Y1");
  EXPECT_EQ(dump_cells(text.program),
            "X0:in M8013:in D0:in[-32768..32767] Y0:out M0:memory");
}

/// The values of cells, scan by scan, for the samples of X0 in `inputs`.
std::string run(const Text& text, std::string_view inputs,
                const std::vector<std::string>& cells, std::int64_t dt) {
  Simulator simulator(text.program);
  std::string result;
  for (const char c : inputs) {
    simulator.set_input(find_cell(text.program, "X0"), c == '1' ? 1 : 0);
    simulator.scan(dt);
    if (!result.empty()) result += ' ';
    for (const std::string& name : cells) {
      result += std::to_string(simulator.value(find_cell(text.program, name)));
    }
  }
  return result;
}

TEST(IlMitsubishiReader, FirstScan) {
  const Text text("LD M8002\nOR X0\nOUT Y0\nLD M8003\nOUT Y1");
  ASSERT_EQ(text.problems(), "");
  EXPECT_EQ(run(text, "000", {"Y0", "Y1"}, 10), "10 01 01");
}

TEST(IlMitsubishiReader, TimersAndCounters) {
  // A contact above its coil is on one scan later; K0 is on in the next scan.
  const Text delay("LD T0\nOUT Y0\nLD X0\nOUT T0 K2\nLD X0\nOUT T1 K0");
  EXPECT_EQ(run(delay, "1111011", {"T0", "Y0", "T1"}, 100),
            "000 001 101 111 010 000 001");
  // A retentive timer keeps its time, and its contact.
  const Text keeps("LD X0\nOUT T250 K2");
  EXPECT_EQ(run(keeps, "1100110", {"T250"}, 100), "0 0 0 0 0 1 1");
  // RST holds a counter while it is driven.
  const Text held("LD X0\nRST C0\nLD X0\nOUT C0 K1");
  EXPECT_EQ(run(held, "0101", {"C0"}, 10), "0 0 0 0");
  const Text counts("LD X0\nOUT C0 K2");
  EXPECT_EQ(run(counts, "1101010", {"C0"}, 10), "0 0 0 1 1 1 1");
}

TEST(IlMitsubishiReader, ZonesClearTimersAndKeepCounters) {
  const Text text(
      "LD X0\nMC N0 M0\nLD M8000\nOUT T0 K1\nLD M8000\nOUT C0 K2\n"
      "LD M8000\nOUT T250 K2\nMCR N0");
  ASSERT_EQ(text.problems(), "");
  EXPECT_EQ(run(text, "1110111", {"T0", "C0", "T250"}, 100),
            "000 100 101 001 011 111 111");
}

TEST(IlMitsubishiReader, IsRecognised) {
  for (const std::string_view text :
       {"LD X0\nOUT Y0", "; a list\n0 LD X000\n1 OUT Y000\n2 END",
        "LDI M0\nOUT Y0", "ldp x0\nset m0", "LD X0\nAND X1",
        "LD= K1 C0\nOUT Y0"}) {
    EXPECT_EQ(recognise(text).name, "il-mitsubishi") << text;
  }
  for (const std::string_view text :
       {"LD X0\nST Y0", "LD X0\nANDN X1\nST Y0", "LD start\nOUT motor",
        "LD = X0;", "OUT Y0", "", "LD X0;\nS Q0"}) {
    EXPECT_NE(recognise(text).name, "il-mitsubishi") << text;
  }
}

}  // namespace
}  // namespace rung::test
