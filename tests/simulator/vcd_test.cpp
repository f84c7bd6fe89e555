#include "reports/vcd.h"

#include <gtest/gtest.h>

#include "program_maker.h"

namespace rung {
namespace {

TEST(Vcd, IsAsRecorded) {
  ProgramMaker maker;
  const CellId start = maker.input("start it");
  const CellId lamp = maker.output("lamp");
  const CellId level = maker.word("level", CellRole::Memory);
  maker.read(start);
  maker.rung(lamp);
  const std::uint32_t old = maker.read(level);
  const std::uint32_t one = maker.constant(-1, Type::Word);
  maker.node(NodeOp::Add, old, one, Type::Word);
  maker.rung(level);
  Stimulus stimulus;
  stimulus.inputs = {start};
  stimulus.steps = {{10, 1, {1}}, {5, 2, {0}}};
  const Recording recording = record(maker.program(), stimulus);
  const std::string ones(62, '1');
  EXPECT_EQ(write_vcd(maker.program(), recording),
            "$version rungproof $end\n"
            "$timescale 1 ms $end\n"
            "$scope module program $end\n"
            "$scope module inputs $end\n"
            "$var wire 1 ! start_it $end\n"
            "$upscope $end\n"
            "$scope module outputs $end\n"
            "$var wire 1 \" lamp $end\n"
            "$upscope $end\n"
            "$scope module memory $end\n"
            "$var integer 64 # level $end\n"
            "$upscope $end\n"
            "$upscope $end\n"
            "$enddefinitions $end\n"
            "#0\n$dumpvars\n0!\n0\"\nb0 #\n$end\n"
            "#10\n1!\n1\"\nb" +
                ones +
                "11 #\n"
                "#15\n0!\n0\"\nb" +
                ones +
                "10 #\n"
                "#20\nb" +
                ones + "01 #\n");
}

TEST(Vcd, EndsWhereTheRunEnds) {
  ProgramMaker maker;
  const CellId start = maker.input("start");
  maker.read(start);
  maker.rung(maker.output("lamp"));
  Stimulus stimulus;
  stimulus.inputs = {start};
  stimulus.steps = {{10, 1'000'000, {0}}};
  const Recording recording = record(maker.program(), stimulus);
  EXPECT_TRUE(recording.samples.empty());
  const std::string text = write_vcd(maker.program(), recording);
  EXPECT_TRUE(text.ends_with("$end\n#10000000\n")) << text;
}

TEST(Vcd, NamesOfManySignalsDiffer) {
  ProgramMaker maker;
  for (int i = 0; i < 200; ++i) maker.input("i" + std::to_string(i));
  const std::string text =
      write_vcd(maker.program(), record(maker.program(), {}));
  EXPECT_NE(text.find("$var wire 1 ~ i93 $end"), std::string::npos);
  EXPECT_NE(text.find("$var wire 1 !! i94 $end"), std::string::npos);
  EXPECT_NE(text.find("$var wire 1 \"! i95 $end"), std::string::npos);
}

}  // namespace
}  // namespace rung
