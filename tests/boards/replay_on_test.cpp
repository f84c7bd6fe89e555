// `prove --replay-on`: what a board says of a run, and that nothing is taken
// for an answer that is none.

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <array>
#include <cstdio>
#include <fstream>
#include <iterator>

#include "analysis/simulator.h"
#include "boards/image.h"
#include "boards/replay.h"
#include "cases.h"

namespace rung::boards {
namespace {

using Outcome = Replayed::Outcome;

constexpr const char* kMotor = R"(//@ language script
//@ dialect yun
pin3 = (pin5 || pin3) && !pin4;
pin9 = pin3 || pin4;
)";

std::string firmware(const std::string& name) {
  return RUNG_FIRMWARE_DIR "/" + name + ".elf";
}

struct Played {
  Programs programs;
  Trace trace;
  const Program& program() const { return programs.items().front().program; }
};

/// A run of steps in which no input changes.
Played make_run(const std::string& text, std::size_t steps,
                std::uint64_t repeat = 1) {
  Played run;
  EXPECT_TRUE(run.programs.add("program", text));
  Stimulus stimulus;
  for (std::size_t i = 0; i < steps; ++i) {
    stimulus.steps.push_back({10, repeat, {}});
  }
  run.trace = simulate(run.program(), stimulus);
  return run;
}

Replayed replay_on(const std::string& board, const std::string& image,
                   const Played& run, double seconds = 60) {
  const Emulator emulator(*find_board(board), firmware(image + "-" + board));
  EXPECT_EQ(emulator.error(), "");
  return replay_on_board(emulator, run.program(), run.trace, seconds);
}

TEST(ReplayOn, ARunIsAlikeAndAChangedOneIsNot) {
  Played run;
  ASSERT_TRUE(run.programs.add("program", kMotor));
  Stimulus stimulus;
  stimulus.inputs = {find_cell(run.program(), "pin5"),
                     find_cell(run.program(), "pin4")};
  stimulus.steps = {{10, 1, {1, 0}}, {7, 300, {0, 0}}, {1, 1, {0, 1}}};
  run.trace = simulate(run.program(), stimulus);
  for (const char* const board : {"uno", "yun", "arm"}) {
    const Replayed alike = replay_on(board, "replay", run);
    EXPECT_EQ(alike.outcome, Outcome::Alike) << board << ": " << alike.what;
    const Replayed faulty = replay_on(board, "faulty", run);
    EXPECT_EQ(faulty.outcome, Outcome::Different) << board;
    EXPECT_EQ(faulty.what,
              "at scan 1 pin9 is 1 in the run and 0 on " + std::string(board));
  }
  const CellId output = find_cell(run.program(), "pin9");
  run.trace.steps[1].values[output.index()] = 0;
  const Replayed changed = replay_on("uno", "replay", run);
  EXPECT_EQ(changed.outcome, Outcome::Different);
  EXPECT_EQ(changed.what, "at scan 301 pin9 is 0 in the run and 1 on uno");
}

TEST(ReplayOn, AMachineThatHasToStopIsNoDisagreement) {
  const std::string program = R"(postfix 1
dialect none
evaluation strict
scan 1..100 ms
output word level in 0..10
rungs
level 3 + =level
)";
  for (const std::uint64_t repeat : {std::uint64_t{1}, std::uint64_t{5}}) {
    const Played run = make_run(program, 5, repeat);
    const Replayed replayed = replay_on("yun", "replay", run);
    EXPECT_EQ(replayed.outcome, Outcome::NotRun);
    EXPECT_EQ(replayed.what,
              "the machine stops in scan 4 with fault 2: a value leaves its "
              "range");
  }
}

TEST(ReplayOn, WhatDoesNotFitIsSaid) {
  const Played long_run = make_run(kMotor, 2000);
  const Replayed too_long = replay_on("uno", "replay", long_run);
  EXPECT_EQ(too_long.outcome, Outcome::NotRun);
  EXPECT_NE(too_long.what.find("bytes of flash"), std::string::npos)
      << too_long.what;
  EXPECT_EQ(replay_on("arm", "replay", long_run).outcome, Outcome::Alike);

  std::string words =
      "postfix 1\ndialect none\nevaluation strict\nscan 1..100 ms\n";
  for (int i = 0; i < 400; ++i) {
    words += "memory word w" + std::to_string(i) + " in 0..10\n";
  }
  const Played large = make_run(words + "rungs\n1 =w399\n", 1);
  const Replayed refused = replay_on("uno", "replay", large);
  EXPECT_EQ(refused.outcome, Outcome::NotRun);
  EXPECT_EQ(refused.what, "the program needs more memory than it has");
  EXPECT_EQ(replay_on("yun", "replay", large).outcome, Outcome::Alike);
}

TEST(ReplayOn, ATimeOutIsNoAnswer) {
  const Played run = make_run(kMotor, 1, 50'000'000);
  const Replayed replayed = replay_on("uno", "replay", run, 0.2);
  EXPECT_EQ(replayed.outcome, Outcome::NotRun);
  EXPECT_EQ(replayed.what, "time-out of `simavr`");
}

TEST(ReplayOn, TooManyScansAreNotBegun) {
  const Played run = make_run(kMotor, 2, 0x1'0000'0000);
  EXPECT_EQ(replay_on("uno", "replay", run).what,
            "the run has too many scans: 4294967296");
}

TEST(ReplayOn, AFileThatIsNoFirmwareIsRefused) {
  const Board& uno = *find_board("uno");
  EXPECT_NE(Emulator(uno, "/no/such.elf").error(), "");
  EXPECT_NE(Emulator(uno, firmware("replay-arm")).error(), "");
  EXPECT_NE(Emulator(*find_board("arm"), "/no/such.elf").error(), "");
  EXPECT_EQ(find_board("mega"), nullptr);
}

TEST(ReplayOn, ATapeHasOnePlace) {
  const std::string mark("rungproof tape 1\4\0\0\0", 20);
  const auto place = find_tape_place("ab" + mark + "1234xy");
  ASSERT_TRUE(place.has_value());
  EXPECT_EQ(place->at, 22U);
  EXPECT_EQ(place->size, 4U);
  EXPECT_FALSE(find_tape_place("").has_value());
  EXPECT_FALSE(find_tape_place(mark + "123").has_value()) << "too short";
  EXPECT_FALSE(find_tape_place(mark.substr(0, 18)).has_value());
  EXPECT_FALSE(find_tape_place(mark + "1234" + mark + "1234").has_value());
}

// Nothing but a whole report is one: each of its beginnings, and each byte of
// it replaced.
TEST(ReplayOn, ADamagedReportIsNone) {
  const Played run = make_run(kMotor, 2);
  DiagnosticList found;
  Stimulus stimulus;
  stimulus.steps = {{10, 1, {}}, {10, 1, {}}};
  const std::array<Job, 1> jobs = {*make_job(run.program(), stimulus, found)};
  const std::string report = "{p0000000000s0s3}";
  const std::string printed =
      "Loaded 3 .text\n\x1b[32m{p0000000.\x1b[0m\n\x1b[32m000s0s3}.\x1b[0m\n";
  for (const std::string& good : {report, printed}) {
    const Playback playback = read_report(good, jobs);
    EXPECT_EQ(playback.error, "") << good;
    ASSERT_EQ(playback.executions.size(), 1U);
    EXPECT_EQ(playback.executions[0].values.size(), 2U);
    EXPECT_EQ(playback.executions[0].values[1][0] +
                  playback.executions[0].values[1][1],
              2);
  }
  for (std::size_t size = 0; size < report.size(); ++size) {
    EXPECT_NE(read_report(report.substr(0, size), jobs).error, "") << size;
    std::string damaged = report;
    damaged[size] = 'x';
    EXPECT_NE(read_report(damaged, jobs).error, "") << damaged;
  }
  for (const char* const wrong :
       {"{p0000000000s0}", "{p0000000000s0s3s3}", "{p0000000000s0f00000000003}",
        "{p0000000000s0s3p0000000000s0s3}", "{p0500000000s0s3}", "{}"}) {
    EXPECT_NE(read_report(wrong, jobs).error, "") << wrong;
  }
  EXPECT_EQ(read_report("{p0500000000}", jobs).executions[0].refusal, 5U);
}

// --- the program -------------------------------------------------------------

struct Answer {
  int status = -1;
  std::string text;
};

Answer run_command(const std::string& command) {
  Answer answer;
  std::FILE* const pipe = ::popen((command + " 2>&1").c_str(), "r");
  if (pipe == nullptr) return answer;
  std::array<char, 4096> buffer{};
  for (std::size_t read = 1; read > 0;) {
    read = std::fread(buffer.data(), 1, buffer.size(), pipe);
    answer.text.append(buffer.data(), read);
  }
  const int status = ::pclose(pipe);
  if (WIFEXITED(status)) answer.status = WEXITSTATUS(status);
  return answer;
}

bool says(const Answer& answer, const std::string& text) {
  return answer.text.find(text) != std::string::npos;
}

const std::string kWrong = " prove " RUNG_SOURCE_DIR
                           "/corpus/sequence/traffic_light_wrong.rung "
                           "--property crash --replay-on ";

TEST(ReplayOnCommand, SaysWhatTheBoardShows) {
  for (const std::string board : {"uno", "yun", "arm"}) {
    const Answer text = run_command(RUNG_PROGRAM + kWrong + board);
    EXPECT_EQ(text.status, 1);
    EXPECT_TRUE(says(text, "  = replayed on " + board +
                               ": Q0 is true, Q1 is false, Q3 is false, Q4 is "
                               "true at scan 122\n"))
        << text.text;
  }
  const Answer json = run_command(RUNG_PROGRAM + kWrong + "uno --format json");
  EXPECT_EQ(json.status, 1);
  EXPECT_TRUE(says(json, R"("replay": {
        "board": "uno",
        "replayed": true,
        "scan": 122,
        "reason": null
      })"))
      << json.text;
}

TEST(ReplayOnCommand, WhatIsNotReplayedIsSaid) {
  const Answer answer = run_command(
      RUNG_PROGRAM " prove " RUNG_SOURCE_DIR
                   "/corpus/papers/plclib_motors.ino --replay-on uno");
  EXPECT_EQ(answer.status, 2);
  EXPECT_TRUE(says(answer, "= not replayed on uno: it cannot be lowered"))
      << answer.text;
  EXPECT_TRUE(says(answer, "3 violated")) << "no verdict is lost";
}

TEST(ReplayOnCommand, AMissingEmulatorIsSaidFirst) {
  const Answer answer =
      run_command("PATH=/nowhere " RUNG_PROGRAM + kWrong + "uno");
  EXPECT_EQ(answer.status, 2);
  EXPECT_TRUE(says(answer, "cannot run `simavr`")) << answer.text;
}

// A copy of the program beside a firmware with a fault.
TEST(ReplayOnCommand, ADisagreementIsAnInternalError) {
  std::string folder = testing::TempDir() + "replay-XXXXXX";
  ASSERT_NE(::mkdtemp(folder.data()), nullptr);
  const Answer answer = run_command(
      "cd " + folder + " && mkdir boards && cp " RUNG_PROGRAM " . && cp " +
      firmware("faulty-uno") + " boards/replay-uno.elf && ./rungproof" +
      kWrong + "uno; status=$?; rm -r " + folder + "; exit $status");
  EXPECT_EQ(answer.status, 4);
  EXPECT_TRUE(says(answer,
                   "self-check failed: crash: uno disagrees with the "
                   "simulator: at scan "))
      << answer.text;
  EXPECT_TRUE(says(answer, "1 violated"));
}

}  // namespace
}  // namespace rung::boards
