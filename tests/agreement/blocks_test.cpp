// The function blocks of IEC 61131-3: the simulator's and the tables' agree on
// random programs, and both do what the standard's diagrams show.

#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <vector>

#include "analysis/simulator.h"
#include "block_programs.h"
#include "comparison.h"
#include "random_run.h"
#include "tests/setting.h"

namespace rung {
namespace {

TEST(Blocks, RandomProgramsMeanTheSameToBoth) {
  const std::uint64_t count = setting("RUNG_AGREEMENT_PROGRAMS", 2000);
  for (std::uint64_t seed = 1; seed <= count; ++seed) {
    const std::vector<std::uint32_t> numbers = random_tape(seed, 600);
    Tape tape(numbers);
    const Program program = random_block_program(tape);
    const Stimulus stimulus = random_stimulus(program, tape, 50);
    ASSERT_EQ(
        compare_encoding(program, {program, build_transition_system(program)},
                         stimulus),
        "")
        << "seed " << seed;
  }
}

/// `settles` lets time stand still behind the first scan, for good.
TEST(Blocks, ScansOfNoTimeMeanTheSameToBoth) {
  const std::uint64_t count = setting("RUNG_AGREEMENT_PROGRAMS", 2000) / 4;
  for (std::uint64_t seed = 1; seed <= count; ++seed) {
    const std::vector<std::uint32_t> numbers = random_tape(seed, 600);
    Tape tape(numbers);
    const Program program = random_block_program(tape);
    Stimulus stimulus = random_stimulus(program, tape, 30);
    const std::size_t last = 1 + tape.pick(8);
    for (std::size_t i = last; i < stimulus.steps.size(); ++i) {
      stimulus.steps[i].dt_ms = 0;
    }
    Program stoppable = program;
    stoppable.scan.min_ms = 0;
    ASSERT_EQ(
        compare_encoding(program, {program, build_transition_system(stoppable)},
                         stimulus),
        "")
        << "seed " << seed;
  }
}

struct Diagram {
  std::string_view kind;
  std::vector<std::string> inputs;  // levels, a letter a scan of 10 ms
  std::string expected;             // of the block's first output
  std::vector<std::int64_t> words;  // of PV, in every scan: nothing else is
};

// PT is 30 ms; the scan of the edge is the first.
const std::vector<Diagram> kDiagrams = {
    {"ton", {"0111110110"}, "0000110000", {}},
    {"tof", {"0010000001"}, "0011110001", {}},
    {"tof", {"1001000000"}, "1111111000", {}},
    {"tp", {"0100000111111001"}, "0111000111000001", {}},
    {"ctu", {"01010100", "00000010"}, "00011100", {2}},
    {"ctu", {"1000", "0000"}, "1111", {-1}},
    {"ctd", {"001010100", "010000000"}, "100011111", {2}},
    {"r-trig", {"11001"}, "10001", {}},
    {"f-trig", {"00110"}, "10001", {}},
    {"f-trig", {"1100"}, "0010", {}},
    {"sr", {"010010", "001010"}, "010011", {}},
    {"rs", {"010010", "001010"}, "010000", {}},
    // matiec: what it shows at these times is the same.
    {"ton-matiec", {"0111110110"}, "0000110000", {}},
    {"tof-matiec", {"0010000001"}, "0011110001", {}},
    {"tof-matiec", {"0000"}, "0000", {}},
    {"tp-matiec", {"0100000111111001"}, "0111000111000001", {}},
    {"ctu-matiec", {"01010100", "00000010"}, "00011100", {2}},
    {"ctd-matiec", {"001010100", "010000000"}, "100011111", {2}},
    // ESBMC counts the first scan, and knows no pulse.
    {"ton-esbmc", {"0111110110"}, "0001110000", {}},
    {"tof-esbmc", {"0010000001"}, "0011100001", {}},
    {"tp-esbmc", {"0111110110"}, "0001110000", {}},
    {"f-trig-esbmc", {"00110"}, "00001", {}},
};

class BlockDiagram : public testing::TestWithParam<Diagram> {};

TEST_P(BlockDiagram, IsDrawnSo) {
  const Diagram& diagram = GetParam();
  const Program program = single_block(diagram.kind);
  Simulator simulator(program);
  std::string seen;
  for (std::size_t scan = 0; scan < diagram.expected.size(); ++scan) {
    std::size_t row = 0;
    for (const CellId id : ids_of(program.cells)) {
      if (program.cells[id].role != CellRole::Input) continue;
      if (program.cells[id].type == Type::Word) {
        simulator.set_input(id, diagram.words[0]);
      } else {
        simulator.set_input(id, diagram.inputs[row++][scan] == '1' ? 1 : 0);
      }
    }
    simulator.scan(10);
    seen += simulator.value(find_cell(program, "Q")) != 0 ? '1' : '0';
  }
  EXPECT_EQ(seen, diagram.expected);
}

INSTANTIATE_TEST_SUITE_P(Standard, BlockDiagram, testing::ValuesIn(kDiagrams),
                         [](const auto& row) {
                           std::string name(row.param.kind);
                           for (char& c : name) c = c == '-' ? '_' : c;
                           return name + std::to_string(row.index);
                         });

TEST(Blocks, UpDownCounterLoadsResetsAndIgnoresDoubleEdges) {
  const Program program = single_block("ctud");
  Simulator simulator(program);
  // CU CD R LD, and CV after it; PV is 2.
  const std::vector<std::pair<std::string, int>> scans = {
      {"0001", 2}, {"1000", 3}, {"1001", 2}, {"0000", 2},
      {"1100", 2}, {"0000", 2}, {"0100", 1}, {"1000", 2},
      {"1011", 0}, {"0000", 0}, {"0100", -1}};
  for (const auto& [levels, value] : scans) {
    std::size_t row = 0;
    for (const CellId id : ids_of(program.cells)) {
      if (program.cells[id].role != CellRole::Input) continue;
      const bool word = program.cells[id].type == Type::Word;
      simulator.set_input(id, word ? 2 : (levels[row++] == '1' ? 1 : 0));
    }
    simulator.scan(10);
    EXPECT_EQ(simulator.value(find_cell(program, "CTUD.CV")), value) << levels;
    EXPECT_EQ(simulator.value(find_cell(program, "CTUD.QD")), value <= 0);
    EXPECT_EQ(simulator.value(find_cell(program, "Q")), value >= 2);
  }
}

// lib/counter.txt: at PV and at 0 there is no further.
TEST(Blocks, CountersOfMatiecStopAtTheirEnds) {
  const Program program = single_block("ctud-matiec");
  Simulator simulator(program);
  // CU CD R LD, and CV after it; PV is 2.
  const std::vector<std::pair<std::string, int>> scans = {
      {"1000", 1}, {"0000", 1}, {"1000", 2}, {"0000", 2}, {"1000", 2},
      {"0010", 0}, {"0100", 0}, {"0001", 2}, {"1100", 2}};
  for (const auto& [levels, value] : scans) {
    std::size_t row = 0;
    for (const CellId id : ids_of(program.cells)) {
      if (program.cells[id].role != CellRole::Input) continue;
      const bool word = program.cells[id].type == Type::Word;
      simulator.set_input(id, word ? 2 : (levels[row++] == '1' ? 1 : 0));
    }
    simulator.scan(10);
    EXPECT_EQ(simulator.value(find_cell(program, "CTUD.CV")), value) << levels;
  }
}

TEST(Blocks, ElapsedTimeStopsAtThePreset) {
  const Program program = single_block("ton");
  Simulator simulator(program);
  simulator.set_input(find_cell(program, "IN"), 1);
  for (const int expected : {0, 20, 30, 30}) {
    simulator.scan(20);
    EXPECT_EQ(simulator.value(find_cell(program, "TON.ET")), expected);
  }
  simulator.set_input(find_cell(program, "IN"), 0);
  simulator.scan(20);
  EXPECT_EQ(simulator.value(find_cell(program, "TON.ET")), 0);
}

}  // namespace
}  // namespace rung
