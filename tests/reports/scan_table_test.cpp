#include "reports/scan_table.h"

#include <gtest/gtest.h>

#include "base/file_stem.h"
#include "reports/waves.h"

namespace rung {
namespace {

Program make_program(int cells) {
  Program program;
  for (int i = 0; i < cells; ++i) {
    Cell cell;
    cell.name = "signal" + std::to_string(i);
    cell.role = i == 0 ? CellRole::Input : CellRole::Output;
    program.cells.add(cell);
  }
  return program;
}

TEST(Duration, IsShortAndExact) {
  EXPECT_EQ(duration(0), "0 ms");
  EXPECT_EQ(duration(999), "999 ms");
  EXPECT_EQ(duration(1000), "1.0 s");
  EXPECT_EQ(duration(60000), "60.0 s");
  EXPECT_EQ(duration(1250), "1.25 s");
  EXPECT_EQ(duration(1001), "1.001 s");
  EXPECT_EQ(duration(600000), "10 min 0 s");
  EXPECT_EQ(duration(3661001), "1 h 01 min 1.001 s");
}

TEST(ScanTable, MarksWhatChangedAndFoldsRepeats) {
  const Program program = make_program(2);
  Trace trace;
  trace.steps = {{1, 100, 1, {1, 1}}, {3601, 10, 3600, {1, 0}}};
  EXPECT_EQ(draw_scan_table({program, trace, {CellId(0), CellId(1)}, " "},
                            Painter(false)),
            "   scan    time |  signal0  signal1\n"
            "  start         |        -        0\n"
            "      1  100 ms |       1*       1*\n"
            " 2-3601  36.1 s |        1       0*   x 3600 scans, 36.0 s\n");
}

TEST(ScanTable, WideTablesContinueBelow) {
  const Program program = make_program(12);
  Trace trace;
  trace.steps = {{1, 1, 1, std::vector<std::int64_t>(12, 0)}};
  std::vector<CellId> all;
  for (const CellId id : ids_of(program.cells)) all.push_back(id);
  const std::string table =
      draw_scan_table({program, trace, all, ""}, Painter(false));
  EXPECT_NE(table.find("signal0"), std::string::npos);
  EXPECT_NE(table.find("signal11"), std::string::npos);
  EXPECT_NE(table.find("\n\n"), std::string::npos);
}

TEST(RelevantSignals, ManySignalsShowWhatMovesAndWhatIsNamed) {
  const Program program = make_program(40);
  Trace trace;
  trace.steps = {{1, 1, 1, std::vector<std::int64_t>(40, 0)}};
  trace.steps[0].values[7] = 1;
  std::vector<CellId> cone;
  for (const CellId id : ids_of(program.cells)) cone.push_back(id);
  const std::vector<CellId> expected = {CellId(7), CellId(30)};
  EXPECT_EQ(relevant_signals(program, trace, cone, {CellId(30)}), expected);
}

TEST(WaveJson, HasACharacterALine) {
  const Program program = make_program(2);
  Trace trace;
  trace.steps = {
      {1, 100, 1, {1, 1}}, {3601, 10, 3600, {1, 0}}, {3602, 10, 1, {0, 0}}};
  const std::string wave =
      write_wavejson(program, trace, {CellId(0), CellId(1)}, "stop");
  for (const char* part :
       {"\"wave\": \"===\"", "\"100 ms\"", "\"36.1 s\"", "\"signal0\"",
        "\"wave\": \"1|0\"", "\"wave\": \"10.\"", "\"text\": \"stop\""}) {
    EXPECT_NE(wave.find(part), std::string::npos) << part << wave;
  }
}

TEST(StimulusTable, HasTheInputsOfTheTrace) {
  Program program = make_program(2);
  Trace trace;
  trace.steps = {{1, 100, 1, {1, 1}}, {3601, 10, 3600, {0, 0}}};
  EXPECT_EQ(write_stimulus(program, trace).value_or("none"),
            "dt,repeat,\"signal0\"\n100,1,1\n10,3600,0\n");
  for (const char* name : {"a,b", "a\nb", "a\rb", "dt", "repeat"}) {
    program.cells[CellId(0)].name = name;
    EXPECT_FALSE(write_stimulus(program, trace)) << name;
  }
}

TEST(FileStem, LeavesNoFolder) {
  EXPECT_EQ(file_stem("stop.holds-1_2"), "stop.holds-1_2");
  EXPECT_EQ(file_stem("../a/b c"), "_._a_b_c");
  EXPECT_EQ(file_stem(".profile"), "_profile");
  EXPECT_EQ(file_stem(""), "unnamed");
  EXPECT_EQ(file_stem("\xff\n"), "__");
  EXPECT_EQ(file_stem(std::string(500, 'a')).size(), 200U);
}

}  // namespace
}  // namespace rung
