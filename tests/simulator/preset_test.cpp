// Presets in seconds, from the text to the scan in which the timer fires: the
// listings compare `t > d*1000` (yun) and `t >= d*1000` (sim) for whole t.

#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <string_view>

#include "analysis/simulator.h"
#include "frontend/script/reader.h"

namespace rung {
namespace {

/// The time in ms from the start of the timer to its first true result.
std::int64_t delay_of(std::string_view dialect, const std::string& seconds) {
  const std::string input = dialect == "yun" ? "pin0" : "I0";
  const std::string output = dialect == "yun" ? "pin1" : "Q0";
  SourceSet sources;
  DiagnosticList diagnostics;
  const FileId file = sources.add(
      "timer.txt", output + " = T(0, " + seconds + ", " + input + ");\n");
  const Ast ast = read_script(sources, file, dialect, diagnostics);
  const Program program = build_program(ast, {}, diagnostics);
  EXPECT_FALSE(diagnostics.has_errors());
  Simulator simulator(program);
  simulator.set_input(find_cell(program, input), 1);
  for (std::int64_t t = 0; t < 100; ++t) {
    simulator.scan(1);
    if (simulator.value(find_cell(program, output)) != 0) return t;
  }
  return -1;
}

TEST(Presets, YunWaitsForMoreThanTheTime) {
  EXPECT_EQ(delay_of("yun", "0"), 1);
  EXPECT_EQ(delay_of("yun", "0.015"), 16);
  EXPECT_EQ(delay_of("yun", "0.0155"), 16);
  EXPECT_EQ(delay_of("yun", "0.016"), 17);
}

TEST(Presets, SimWaitsForTheTime) {
  EXPECT_EQ(delay_of("sim", "0"), 0);
  EXPECT_EQ(delay_of("sim", "0.015"), 15);
  EXPECT_EQ(delay_of("sim", "0.0155"), 16);
  EXPECT_EQ(delay_of("sim", "0.016"), 16);
}

}  // namespace
}  // namespace rung
