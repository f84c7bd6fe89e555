#include "smt/verify.h"

#include <gtest/gtest.h>

#include <map>

#include "frontend/script/reader.h"

namespace rung {
namespace {

struct Checked {
  VerifyReport report;
  std::map<std::string, ObligationResult> by_name;

  const ObligationResult& operator[](const std::string& name) const {
    return by_name.at(name);
  }
};

Checked check(const std::string& text, const VerifyOptions& options = {}) {
  SourceSet sources;
  const FileId file = sources.add("test.rung", text);
  DiagnosticList sink;
  const Ast ast = read_script(sources, file, "", sink);
  Program program = build_program(ast, {}, sink);
  const PropertySet properties = read_properties(program, {}, sources, sink);
  for (const Diagnostic& d : sink.items()) {
    EXPECT_NE(d.severity, Severity::Error) << d.message;
  }
  Checked checked;
  checked.report = verify(program, properties, options);
  for (const ObligationResult& result : checked.report.results) {
    checked.by_name.emplace(result.obligation.name, result);
  }
  return checked;
}

void expect(const Checked& checked, const std::string& name, Verdict verdict) {
  const auto found = checked.by_name.find(name);
  ASSERT_NE(found, checked.by_name.end()) << name;
  EXPECT_EQ(found->second.verdict, verdict)
      << name << ": " << to_string(found->second.verdict) << ", "
      << found->second.reason;
}

constexpr const char* kMotors =
    "//@ lock: interlock Q0, Q1\n"
    "//@ stop: always I2 -> !Q0\n"
    "//@ wrong: never Q0 && I1\n"
    "//@ run: reach Q0 && I1\n"
    "//@ nowhere: reach Q0 && Q1\n"
    "Q0 = (I0 || Q0) && !I2 && !Q1;\n"
    "Q1 = (I1 || Q1) && !I2 && !Q0;\n";

TEST(Verify, EveryVerdictIsChecked) {
  const Checked c = check(kMotors);
  EXPECT_TRUE(c.report.failures.empty());
  expect(c, "lock", Verdict::Proved);
  expect(c, "stop", Verdict::Proved);
  expect(c, "wrong", Verdict::Violated);
  expect(c, "run", Verdict::Proved);
  expect(c, "nowhere", Verdict::Violated);
  EXPECT_FALSE(c["lock"].certificate->checked_by.empty());
  EXPECT_FALSE(c["nowhere"].certificate->checked_by.empty());
  ASSERT_TRUE(c["wrong"].trace.has_value());
  EXPECT_EQ(c["wrong"].scans, 1U);
}

TEST(Verify, AnInjectedWrongInvariantIsRejected) {
  VerifyOptions options;
  options.inject_wrong_invariant = true;
  const Checked c = check(kMotors, options);
  expect(c, "lock", Verdict::Unknown);
  expect(c, "nowhere", Verdict::Unknown);
  EXPECT_FALSE(c.report.failures.empty());
  for (const ObligationResult& result : c.report.results) {
    EXPECT_FALSE(result.certificate.has_value()) << result.obligation.name;
  }
}

constexpr const char* kCells =
    "//@ lock0: interlock KA0, KB0\n"
    "//@ lock1: interlock KA1, KB1\n"
    "//@ lock2: interlock KA2, KB2\n"
    "//@ slow0: never KR0 && !KA0\n"
    "//@ slow1: never KR1 && !KA1\n"
    "//@ slow2: never KR2 && !KA2\n"
    "KA0 = (I0 || KA0) && !S0 && !KB0; KB0 = (J0 || KB0) && !S0 && !KA0;\n"
    "KA1 = (I1 || KA1) && !S1 && !KB1; KB1 = (J1 || KB1) && !S1 && !KA1;\n"
    "KA2 = (I2 || KA2) && !S2 && !KB2; KB2 = (J2 || KB2) && !S2 && !KA2;\n"
    "KR0 = T(0, 5, KA0); KR1 = T(1, 5, KA1); KR2 = T(2, 6, KA2);\n";

TEST(Verify, EqualPartsAreCheckedOnce) {
  const Checked c = check(kCells);
  for (const char* name : {"lock0", "lock1", "slow0", "slow1", "slow2"}) {
    expect(c, name, Verdict::Proved);
    ASSERT_TRUE(c[name].certificate.has_value());
    EXPECT_EQ(c[name].certificate->checked_by,
              c["lock0"].certificate->checked_by);
  }
  EXPECT_FALSE(c["slow0"].certificate->reused);
  EXPECT_TRUE(c["slow1"].certificate->reused);
  EXPECT_FALSE(c["slow2"].certificate->reused);  // another preset
}

TEST(Verify, WrongInvariantsOfEqualPartsAreAllRejected) {
  VerifyOptions options;
  options.inject_wrong_invariant = true;
  const Checked c = check(kCells, options);
  for (const char* name : {"lock0", "lock1", "slow0", "slow1", "slow2"}) {
    expect(c, name, Verdict::Unknown);
    EXPECT_NE(c[name].reason.find("certificate rejected"), std::string::npos);
  }
}

TEST(Verify, AnInjectedWrongTraceIsRejected) {
  VerifyOptions options;
  options.inject_wrong_trace = true;
  const Checked c = check(kMotors, options);
  expect(c, "wrong", Verdict::Unknown);
  expect(c, "run", Verdict::Unknown);
  EXPECT_FALSE(c.report.failures.empty());
  for (const ObligationResult& result : c.report.results) {
    EXPECT_FALSE(result.trace.has_value()) << result.obligation.name;
  }
}

TEST(Verify, ARunToALeftSideIsReplayed) {
  constexpr const char* kText =
      "//@ stop: always I1 -> !Q0\n"
      "//@ late: I0 for 10 s implies !I1 || !Q0\n"
      "Q0 = I0 && !I1;\n";
  VerifyOptions options;
  expect(check(kText, options), "stop", Verdict::Proved);
  expect(check(kText, options), "late", Verdict::Proved);
  options.inject_wrong_trace = true;
  const Checked c = check(kText, options);
  for (const char* name : {"stop", "late"}) {
    expect(c, name, Verdict::Unknown);
    EXPECT_NE(c[name].reason.find("left side"), std::string::npos);
  }
}

TEST(Verify, AnHourIsFoundAndItsTraceIsShort) {
  const Checked c = check(
      "//@ never Q0\n"
      "//@ early: never Q0 && !I0\n"
      "Q0 = T(0, 3600, I0);\n");
  const ObligationResult& late = c["never@1"];
  expect(c, "never@1", Verdict::Violated);
  expect(c, "early", Verdict::Proved);
  // The first call starts the timer, and 36,000 scans of 100 ms follow.
  EXPECT_EQ(late.scans, 36001U);
  EXPECT_LE(late.trace->steps.size(), 4U);
}

TEST(Verify, TheSameTimeTwiceNeedsALemma) {
  const Checked c = check(
      "//@ same: I0 for 100 s implies Q0\n"
      "Q0 = T(0, 100, I0);\n");
  expect(c, "same", Verdict::Proved);
}

TEST(Verify, AssumptionsRestrictEveryScan) {
  const Checked c = check(
      "//@ assume !(I0 && I1)\n"
      "//@ never Q0\n"
      "Q0 = I0 && I1;\n");
  expect(c, "never@2", Verdict::Proved);
  expect(c, "builtin.Q0.can-become-true", Verdict::Violated);
}

TEST(Verify, AssumptionsThatNothingMeetsMakeAllVacuous) {
  const Checked c = check(
      "//@ assume I0 && !I0\n"
      "//@ always Q0\n"
      "Q0 = I1 && I0;\n");
  expect(c, "always@2", Verdict::Vacuous);
}

TEST(Verify, ALeftSideThatIsNeverTrueIsVacuous) {
  const Checked c = check(
      "//@ dead: always Q0 && Q1 -> I1\n"
      "//@ live: always Q0 -> !I1\n"
      "Q0 = I0 && !I1;\n"
      "Q1 = !Q0;\n");
  expect(c, "dead", Verdict::Vacuous);
  expect(c, "live", Verdict::Proved);
}

TEST(Verify, ACounterIsCounted) {
  const Checked c = check(
      "//@ three: never Q0\n"
      "Q0 = C(0, 3, I0, false, I1);\n");
  expect(c, "three", Verdict::Violated);
  EXPECT_EQ(c["three"].scans, 5U);  // up, down, up, down, up
}

TEST(Verify, ACounterOfThousandsIsATurnTakenOften) {
  const Checked c = check(
      "//@ end: reach Q0\n"
      "Q0 = C(0, 5000, I0 && !Q0, false, false);\n");
  expect(c, "end", Verdict::Proved);
  EXPECT_GE(c["end"].scans, 9999U);  // 5,000 times up, and down in between
  EXPECT_LE(c["end"].scans, 10100U);
}

TEST(Verify, TimeBoundsAlongAChainAreExact) {
  const std::string chain =
      "//@ scan 1..50 ms\n"
      "Run = (I0 || Run) && !I1;\n"
      "D0 = T(0, 1, Run);\n"
      "D1 = T(1, 1, D0);\n"
      "Q0 = T(2, 1, D1);\n";
  VerifyOptions one;
  one.wanted = [](std::string_view name) { return name == "bound"; };
  // Two timers are 49 ms late; the last is 1 ms short of its time at 3,097.
  const Checked holds =
      check("//@ bound: Run for 3098 ms implies Q0\n" + chain, one);
  expect(holds, "bound", Verdict::Proved);
  EXPECT_EQ(holds.report.results.size(), 1U);
  const Checked fails =
      check("//@ bound: Run for 3097 ms implies Q0\n" + chain, one);
  expect(fails, "bound", Verdict::Violated);
}

TEST(Verify, TwinsWithTimersAreEqual) {
  const std::string twins =
      "//@ same: always M2 = N2\n"
      "M0 = (T(0, 1000, I0) && I0 || M0) && !I1;\n"
      "M1 = (T(1, 2000, M0) && I2 || M1) && !I1;\n"
      "M2 = (T(2, 3000, M1) && I3 || M2) && !I1;\n"
      "U0 = T(3, 1000, I0);\n"
      "N0 = !I1 && N0 || !I1 && I0 && U0;\n"
      "U1 = T(4, 2000, N0);\n"
      "N1 = !I1 && N1 || !I1 && I2 && U1;\n";
  const Checked equal = check(twins +
                              "U2 = T(5, 3000, N1);\n"
                              "N2 = !I1 && N2 || !I1 && I3 && U2;\n");
  expect(equal, "same", Verdict::Proved);
  EXPECT_EQ(equal["same"].engine, "correspondence");
  const Checked longer = check(twins +
                               "U2 = T(5, 3001, N1);\n"
                               "N2 = !I1 && N2 || !I1 && I3 && U2;\n");
  expect(longer, "same", Verdict::Violated);
}

TEST(Verify, OneEngineByItself) {
  VerifyOptions options;
  options.engine = "bmc";
  options.budget.max_depth = 6;
  const Checked c = check(
      "//@ never Q0 && Q1\n"
      "M0 = I0 || M0;\n"
      "Q0 = M0 && !I1;\n"
      "Q1 = T(0, 1, I1) && I1;\n",
      options);
  const Verdict verdict = c["never@1"].verdict;
  EXPECT_TRUE(verdict == Verdict::Bounded || verdict == Verdict::Proved);
}

TEST(Verify, EqualInputsGiveEqualReports) {
  const Checked a = check(kMotors);
  const Checked b = check(kMotors);
  ASSERT_EQ(a.report.results.size(), b.report.results.size());
  for (std::size_t i = 0; i < a.report.results.size(); ++i) {
    const ObligationResult& x = a.report.results[i];
    const ObligationResult& y = b.report.results[i];
    EXPECT_EQ(x.engine, y.engine);
    EXPECT_EQ(x.scans, y.scans);
    EXPECT_EQ(x.certificate.has_value(), y.certificate.has_value());
    if (!x.certificate.has_value()) continue;
    EXPECT_EQ(x.certificate->lemmas, y.certificate->lemmas);
  }
}

}  // namespace
}  // namespace rung
