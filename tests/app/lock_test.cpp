// What a lock says of programs, and what of a change it lets through.

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "app/lock_file.h"
#include "tests/app/sandbox.h"

namespace rung::test {
namespace {

constexpr const char* kLines =
    "//@ stopped: never Q0 && I1\n//@ after I0 && !I1, Q0 within 2 scans\n";
constexpr const char* kRungs = "Q0 = (I0 || Q0) && !I1;\nQ1 = I2 && !Q0;\n";

Lock lock_of(const Sandbox& sandbox) {
  auto lock = read_lock(read_text(sandbox.path() / "rungproof.lock"));
  EXPECT_TRUE(std::holds_alternative<Lock>(lock));
  return std::get<Lock>(lock);
}

/// The status of `check --locked` for these rungs, where kRungs were locked.
struct Checked {
  explicit Checked(const std::string& text) {
    write_text(sandbox.path() / "a.rung", std::string(kLines) + kRungs);
    EXPECT_EQ(sandbox.run("rungproof lock a.rung"), 0) << sandbox.err();
    write_text(sandbox.path() / "a.rung", text);
    status = sandbox.run("rungproof check --fail-on error --locked a.rung");
    out = sandbox.out();
  }
  bool says(const std::string& text) const {
    return out.find(text) != std::string::npos;
  }

  Sandbox sandbox;
  int status = -1;
  std::string out;
};

TEST(Lock, SaysWhatIsProved) {
  const Sandbox sandbox;
  write_text(sandbox.path() / "below/a.rung", std::string(kLines) + kRungs);
  ASSERT_EQ(sandbox.run("rungproof lock below/a.rung"), 0) << sandbox.err();
  const Lock lock = lock_of(sandbox);
  ASSERT_EQ(lock.programs.count("below/a.rung"), 1U);
  const LockedProgram& program = lock.programs.at("below/a.rung");
  EXPECT_EQ(program.verdicts.at("stopped: never Q0 && I1"), "proved");
  ASSERT_EQ(program.groups.size(), 1U);
  EXPECT_EQ(program.groups[0].outputs, (std::vector<std::string>{"Q0", "Q1"}));
  EXPECT_EQ(program.groups[0].combinations,
            (std::vector<std::string>{"00", "01", "10"}));
  EXPECT_EQ(program.not_listed, "");
  ASSERT_EQ(program.responses.size(), 1U);
  EXPECT_EQ(program.responses[0].scans, 0);
  const std::string text = read_text(sandbox.path() / "rungproof.lock");
  EXPECT_EQ(text, write_lock(lock));
  EXPECT_EQ(sandbox.run("rungproof lock --update below/a.rung"), 0);
  EXPECT_EQ(sandbox.out(), "rungproof.lock: 1 program locked, as before\n");
  EXPECT_EQ(read_text(sandbox.path() / "rungproof.lock"), text);
  // From elsewhere it is the same program.
  EXPECT_EQ(sandbox.run("cd below && rungproof check -q a.rung "
                        "--fail-on error --locked=../rungproof.lock"),
            0)
      << sandbox.out();
}

TEST(Lock, WhatBehavesTheSameIsGreen) {
  const std::vector<std::string> same = {
      std::string(kLines) + kRungs,
      "// moved\n\n" + std::string(kLines) +
          "Q0 = !I1 && (Q0 || I0);\nQ1 = !(Q0 || !I2);\n",
      std::string(kLines) +
          "M0 = I0 || Q0;\nQ0 = M0 && !I1;\nQ1 = I2 && !Q0;\n"};
  for (const std::string& text : same) {
    const Checked checked(text);
    EXPECT_EQ(checked.status, 0) << checked.out;
  }
}

TEST(Lock, ANewCombinationIsShownByARun) {
  const Checked checked(std::string(kLines) +
                        "Q0 = (I0 || Q0) && !I1;\nQ1 = I2;\n");
  EXPECT_EQ(checked.status, 1);
  EXPECT_TRUE(checked.says("no other combination of Q0 Q1")) << checked.out;
  EXPECT_TRUE(checked.says("scan  time")) << checked.out;
}

TEST(Lock, ACombinationThatIsGoneIsADifference) {
  const Checked checked(std::string(kLines) +
                        "Q0 = (I0 || Q0) && !I1;\nQ1 = I2 && !I2;\n");
  EXPECT_EQ(checked.status, 1);
  EXPECT_TRUE(checked.says("as locked, `!Q0 && Q1` occurs")) << checked.out;
}

TEST(Lock, ASlowerResponseIsADifference) {
  const Checked checked(
      std::string(kLines) +
      "Q0 = (M0 && I0 || Q0) && !I1;\nM0 = I0;\nQ1 = I2 && !Q0;\n");
  EXPECT_EQ(checked.status, 1);
  EXPECT_TRUE(checked.says("within 0 scans")) << checked.out;
}

TEST(Lock, AChangedVerdictIsADifference) {
  const Checked checked(std::string(kLines) +
                        "Q0 = I0 || Q0 && !I1;\nQ1 = I2 && !Q0;\n");
  EXPECT_EQ(checked.status, 1);
  EXPECT_TRUE(checked.says("it was proved when locked and is violated now"))
      << checked.out;
}

TEST(Lock, WhatIsGoneIsADifferenceAndWhatIsNewIsSaid) {
  const Checked gone("//@ reach Q1\n" + std::string(kRungs));
  EXPECT_EQ(gone.status, 1);
  EXPECT_TRUE(gone.says("the program no longer")) << gone.out;
  EXPECT_TRUE(gone.says("not in the lock")) << gone.out;
  const Checked output(std::string(kLines) + kRungs + "Q2 = I3;\n");
  EXPECT_EQ(output.status, 1);
  EXPECT_TRUE(output.says("they were Q0 Q1 and are Q0 Q1 Q2")) << output.out;
  const Checked scan("//@ scan 5..9ms\n" + std::string(kLines) + kRungs);
  EXPECT_EQ(scan.status, 1);
  EXPECT_TRUE(scan.says("1..100 ms")) << scan.out;
  EXPECT_EQ(gone.sandbox.run("cp a.rung b.rung; rungproof check --locked "
                             "--fail-on error b.rung"),
            1);
  EXPECT_NE(gone.sandbox.out().find("`rungproof lock --update`"),
            std::string::npos);
}

TEST(Lock, EveryFormatHasTheDifference) {
  const Checked checked(std::string(kLines) +
                        "Q0 = I0 || Q0 && !I1;\nQ1 = I2;\n");
  for (const std::string format :
       {"json", "jsonl", "sarif", "junit", "github", "html"}) {
    SCOPED_TRACE(format);
    EXPECT_EQ(checked.sandbox.run("rungproof check --fail-on error --locked "
                                  "a.rung --explain --format " +
                                  format),
              1)
        << checked.sandbox.err();
    EXPECT_NE(checked.sandbox.out().find("locked.stopped"), std::string::npos);
  }
}

TEST(Lock, UpdateSaysWhatItChanges) {
  const Checked checked(std::string(kLines) +
                        "Q0 = (I0 || Q0) && !I1;\nQ1 = I2;\n");
  EXPECT_EQ(checked.sandbox.run("rungproof lock --update a.rung"), 0);
  EXPECT_NE(checked.sandbox.out().find("+             \"11\"\n"),
            std::string::npos)
      << checked.sandbox.out();
  EXPECT_EQ(checked.sandbox.out().find("\"10\""), std::string::npos);
  EXPECT_EQ(checked.sandbox.run("cp a.rung b.rung; "
                                "rungproof lock --update b.rung"),
            0);
  EXPECT_NE(checked.sandbox.out().find("- "), std::string::npos);
  EXPECT_EQ(lock_of(checked.sandbox).programs.count("a.rung"), 0U);
}

}  // namespace
}  // namespace rung::test
