#include <gtest/gtest.h>

#include "lint.h"

namespace rung::testing {
namespace {

std::size_t count(const Linted& linted, std::string_view rule) {
  std::size_t found = 0;
  for (const Diagnostic& finding : linted.findings) {
    if (finding.rule == rule) ++found;
  }
  return found;
}

TEST(Allow, CoversItsLineAndTheNext) {
  Linted same;
  lint("Q0 = Q0 || I0; //@ allow set-without-reset: an alarm\n", same);
  EXPECT_TRUE(same.findings.empty()) << to_text(same);
  Linted above;
  lint("//@ allow RP106: an alarm\nQ0 = Q0 || I0;\n", above);
  EXPECT_TRUE(above.findings.empty()) << to_text(above);
}

TEST(Allow, CoversNothingFurtherDown) {
  Linted linted;
  lint("//@ allow RP106: an alarm\nQ1 = I1;\nQ0 = Q0 || I0;\n", linted);
  EXPECT_EQ(count(linted, "set-without-reset"), 1U);
  EXPECT_EQ(count(linted, "unused-allow"), 1U);
}

TEST(Allow, BehindARungCoversThatLineOnly) {
  Linted linted;
  lint("Q1 = I1; //@ allow RP106: an alarm\nQ0 = Q0 || I0;\n", linted);
  EXPECT_EQ(count(linted, "set-without-reset"), 1U);
  EXPECT_EQ(count(linted, "unused-allow"), 1U);
}

TEST(Allow, CoversTheWholeRungBelow) {
  Linted linted;
  lint(
      "//@ allow redundant-contact: it is meant so\n\n// the fan\n"
      "Q0 = I0 && I1\n  && I0;\nQ1 = I2 && I3 && I2;\n",
      linted);
  EXPECT_EQ(count(linted, "redundant-contact"), 1U) << to_text(linted);
  ASSERT_EQ(linted.waived.size(), 1U) << to_text(linted);
  EXPECT_EQ(linted.waived[0].waiver->reason, "it is meant so");
}

TEST(Allow, OfARuleThatIsOffIsNotUnused) {
  Linted linted;
  linted.rules.set(*find_rule("set-without-reset"), std::nullopt);
  lint("//@ allow set-without-reset: an alarm\nQ0 = Q0 || I0;\n", linted);
  EXPECT_TRUE(linted.findings.empty()) << to_text(linted);
}

TEST(RuleSelection, SetsSeveritiesAndSwitchesRulesOff) {
  constexpr std::string_view kText = "Q0 = I0;\nQ0 = I1;\n";
  Linted off;
  off.rules = RuleSelection(std::vector<Pack>{});
  EXPECT_TRUE(lint(kText, off).findings.empty()) << to_text(off);
  EXPECT_EQ(off.summary.asked, 0U);
  Linted error;
  error.rules.set(*find_rule("RP101"), Severity::Error);
  lint(kText, error);
  ASSERT_TRUE(has_finding(error, "double-coil"));
  for (const Diagnostic& finding : error.findings) {
    const bool set = finding.rule == "double-coil";
    EXPECT_EQ(finding.severity, set ? Severity::Error : Severity::Note);
  }
}

/// What the solver proves harmless stays a note, however severe the rule is.
TEST(RuleSelection, LeavesWhatIsProvedHarmless) {
  Linted linted;
  linted.rules.set(*find_rule("RP101"), Severity::Error);
  lint("Q0 = I0;\nQ0 = I0;\n", linted);
  ASSERT_TRUE(has_finding(linted, "double-coil")) << to_text(linted);
  for (const Diagnostic& finding : linted.findings) {
    EXPECT_EQ(finding.severity, Severity::Note) << to_text(linted);
  }
}

TEST(Allow, CoversOnlyTheRulesItNames) {
  Linted linted;
  lint("//@ allow double-coil: no\nQ0 = Q0 || I0;\n", linted);
  EXPECT_EQ(count(linted, "set-without-reset"), 1U);
  EXPECT_EQ(count(linted, "unused-allow"), 1U);
}

TEST(Allow, NamesSeveralRules) {
  Linted linted;
  lint(
      "//@ allow constant-operand, redundant-contact: bridged for a test\n"
      "Q0 = I0 && true;\n",
      linted);
  EXPECT_EQ(count(linted, "constant-operand"), 0U);
  // The second name covered nothing.
  EXPECT_EQ(count(linted, "unused-allow"), 1U) << to_text(linted);
}

TEST(Allow, WithoutAReasonCoversNothing) {
  for (const char* line :
       {"//@ allow set-without-reset",
        "//@ allow set-without-reset:", "//@ allow set-without-reset:  "}) {
    Linted linted;
    lint(std::string(line) + "\nQ0 = Q0 || I0;\n", linted);
    EXPECT_EQ(count(linted, "set-without-reset"), 1U) << line;
    EXPECT_EQ(count(linted, "allow-without-reason"), 1U) << line;
  }
}

TEST(Allow, AnUnknownNameIsToldOnce) {
  Linted linted;
  lint("//@ allow no-such-rule: why not\nQ0 = I0;\n", linted);
  EXPECT_EQ(count(linted, "unused-allow"), 1U) << to_text(linted);
}

TEST(RuleRun, WithoutAnOracleNothingIsClaimed) {
  constexpr std::string_view kText = "M0 = I0 && !I1;\nQ0 = M0 && I1;\n";
  Linted with;
  EXPECT_TRUE(has_finding(lint(kText, with), "coil-never-true"));
  Linted without;
  EXPECT_FALSE(
      has_finding(lint(kText, without, no_oracle()), "coil-never-true"));
  EXPECT_GT(without.summary.undecided, 0U);
}

TEST(RuleRun, SamplingSparesTheOracleWhatIsPlainlyFalse) {
  Linted linted;
  lint("Q0 = I0 && I1;\nQ1 = I2 || I3;\n", linted);
  EXPECT_GT(linted.summary.sampled, 0U);
  EXPECT_EQ(linted.summary.undecided, 0U);
  EXPECT_TRUE(linted.findings.empty()) << to_text(linted);
}

}  // namespace
}  // namespace rung::testing
