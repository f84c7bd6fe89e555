#include "mutant_runs.h"

#include <cstdlib>
#include <iostream>
#include <optional>
#include <string_view>
#include <utility>

#include "analysis/build_declared.h"
#include "block_programs.h"
#include "frontend/postfix/reader.h"
#include "frontend/stl/reader.h"
#include "program_generator.h"

namespace rung {
namespace {

constexpr std::uint64_t kScans = 50;
constexpr std::size_t kTapeLength = 600;

ReadProgram read_script_text(std::string_view dialect,
                             const std::string& text) {
  std::string error;
  std::optional<ReadProgram> read = read_program(dialect, text, error);
  if (!read) std::cerr << error << "\n" << text, std::abort();
  return std::move(*read);
}

ReadProgram read_postfix_text(const std::string& text) {
  ReadProgram result;
  DiagnosticList diagnostics;
  const FileId file =
      add_postfix(result.sources, "directed", text, diagnostics);
  result.program = build_declared(
      read_postfix(result.sources, file, diagnostics), diagnostics);
  if (diagnostics.has_errors()) std::abort();
  return result;
}

/// Scans of 10 ms; each letter of a row is an input's level in a scan.
Stimulus levels(const Program& program, const std::vector<std::string>& rows) {
  Stimulus stimulus;
  for (const CellId id : ids_of(program.cells)) {
    if (program.cells[id].role == CellRole::Input)
      stimulus.inputs.push_back(id);
  }
  for (std::size_t scan = 0; scan < rows.front().size(); ++scan) {
    StimulusStep step;
    step.dt_ms = 10;
    for (std::size_t i = 0; i < stimulus.inputs.size(); ++i) {
      step.inputs.push_back(rows[i][scan] == '1' ? 1 : 0);
    }
    stimulus.steps.push_back(std::move(step));
  }
  return stimulus;
}

std::string repeated(std::string_view text, std::size_t count) {
  std::string result;
  for (std::size_t i = 0; i < count; ++i) result += text;
  return result;
}

std::optional<ProgramRun> random_program(std::uint64_t seed) {
  const std::vector<std::uint32_t> numbers = random_tape(seed, kTapeLength);
  Tape tape(numbers);
  const GeneratedProgram generated = generate_program(tape, {});
  std::string error;
  std::optional<ReadProgram> read =
      read_program(generated.dialect, generated.text, error);
  if (!read) return std::nullopt;
  ProgramRun run{"seed " + std::to_string(seed), std::move(*read), {}};
  run.stimulus = random_stimulus(run.read.program, tape, kScans);
  return run;
}

/// The same on a clock of 32 bits; no value without a timer on such a clock.
std::optional<ProgramRun> random_rollover(std::uint64_t seed) {
  std::optional<ProgramRun> run = random_program(seed);
  if (!run) return run;
  const std::vector<std::uint32_t> numbers = random_tape(seed + 1, kTapeLength);
  Tape tape(numbers);
  auto stimulus = rollover_stimulus(run->read.program, tape, kScans);
  if (!stimulus) return std::nullopt;
  run->name += ", clock of 32 bits";
  run->stimulus = std::move(*stimulus);
  return run;
}

ProgramRun edges(std::string_view operation) {
  ProgramRun run{
      "edge program",
      read_postfix_text("postfix 1\ndialect none\nevaluation strict\n"
                        "scan 1..100 ms\ninput bit v\noutput bit q\n"
                        "element E(0) edge\nrungs\nv " +
                        std::string(operation) + "(0) =q\n"),
      {}};
  run.stimulus = levels(run.read.program, {"01100110"});
  return run;
}

/// A count to its largest value and over it.
ProgramRun counts_up() {
  ProgramRun run{"counter past 50 times its count",
                 read_script_text("sim", "Q0 = C(0, 1, I0, I1, I2);\n"),
                 {}};
  const std::string pulses = repeated("10", 53);
  const std::string none(pulses.size(), '0');
  run.stimulus = levels(run.read.program, {pulses, none, none});
  return run;
}

/// Down to one above the encoding's lowest value, up, down to one below it, and
/// up again.
ProgramRun counts_down() {
  ProgramRun run{"counter at its floor",
                 read_script_text("sim", "Q0 = C(0, 1, I0, I1, I2);\n"),
                 {}};
  const std::string down = repeated("10", 32767);
  const std::string none(down.size(), '0');
  run.stimulus = levels(run.read.program, {none + "1000000" + "101010",
                                           down + "0010101" + "000000",
                                           none + "0000000" + "000000"});
  return run;
}

/// Past the 16 bits of a controller's word.
ProgramRun wraps() {
  ProgramRun run{
      "word that wraps", read_script_text("yun", "y10 = y10 + 10923;\n"), {}};
  run.stimulus = levels(run.read.program, {std::string(20, '0')});
  return run;
}

ProgramRun random_blocks(std::uint64_t seed) {
  const std::vector<std::uint32_t> numbers = random_tape(seed, kTapeLength);
  Tape tape(numbers);
  ProgramRun run{"blocks, seed " + std::to_string(seed), {}, {}};
  run.read.program = random_block_program(tape);
  run.stimulus = random_stimulus(run.read.program, tape, kScans);
  return run;
}

/// To the largest value of a CTU, and one edge more.
ProgramRun counts_to_the_limit() {
  ProgramRun run{"CTU at its limit", {}, {}};
  run.read.program = single_block("ctu");
  const std::string up = repeated("10", 32768);
  const std::string none(up.size(), '0');
  run.stimulus = levels(run.read.program, {up, none, none});
  return run;
}

/// CU CD R LD of a CTUD, and its PV.
ProgramRun counts_both_ways(std::string name,
                            const std::vector<std::string>& inputs,
                            std::int64_t preset) {
  ProgramRun run{std::move(name), {}, {}};
  run.read.program = single_block("ctud");
  run.stimulus = levels(run.read.program, inputs);
  for (StimulusStep& step : run.stimulus.steps) {
    step.inputs.back() = preset;
  }
  return run;
}

/// A counter of S7 at its ends: set to 998, up three times, and down while FR
/// lets an edge be counted anew.
ProgramRun counts_to_999() {
  ProgramRun run{"counter of S7 at its ends", {}, {}};
  DiagnosticList diagnostics;
  const FileId file = run.read.sources.add(
      "directed",
      "U E 0.0\nL C#998\nS Z 1\nU E 0.1\nZV Z 1\nU E 0.2\nZR Z 1\n"
      "U E 0.3\nFR Z 1\nL Z 1\nT MW 0\n");
  run.read.program = build_declared(
      read_stl(run.read.sources, file, diagnostics), diagnostics);
  if (diagnostics.has_errors()) std::abort();
  run.stimulus = levels(run.read.program, {"100000000000", "010101000000",
                                           "000000111110", "000000010100"});
  return run;
}

}  // namespace

std::vector<ProgramRun> mutant_runs(std::uint64_t count) {
  std::vector<ProgramRun> runs;
  runs.push_back(edges("RISE"));
  runs.push_back(edges("FALL"));
  runs.push_back(counts_up());
  runs.push_back(wraps());
  for (std::uint64_t seed = 1; seed <= count; ++seed) {
    std::optional<ProgramRun> run = random_program(seed);
    if (run) runs.push_back(std::move(*run));
    run = random_rollover(seed);
    if (run) runs.push_back(std::move(*run));
    // There are many dialects, and each has its share of them.
    constexpr std::uint64_t kDialects = 8;
    for (std::uint64_t i = 0; i < kDialects; ++i) {
      runs.push_back(random_blocks(i * count + seed));
    }
  }
  // Up from the smallest value and down to it again; up to the largest one.
  runs.push_back(counts_both_ways("CTUD at its floor",
                                  {"01000", "00101", "00000", "10000", "00000"},
                                  -32768));
  runs.push_back(counts_both_ways(
      "CTUD at its ceiling", {"0101", "0000", "0000", "1000", "0000"}, 32766));
  runs.push_back(counts_to_the_limit());
  runs.push_back(counts_down());
  runs.push_back(counts_to_999());
  return runs;
}

}  // namespace rung
