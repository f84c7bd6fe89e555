// The same question has the same answer: in any run, with any number of
// threads; its verdict also with other random runs.

#include <gtest/gtest.h>

#include <memory>
#include <random>
#include <string>
#include <vector>

#include "smt/verify.h"
#include "source.h"
#include "tests/setting.h"

namespace rung {
namespace {

/// Parts that share no state, each of its own kind.
constexpr const char* kParts =
    "//@ dialect sim\n"
    "//@ lock: interlock A0, A1\n"
    "A0 = (I0 || A0) && !I1 && !A1; A1 = (I2 || A1) && !I1 && !A0;\n"
    "//@ wrong: never B0 && I3\n"
    "B0 = (I3 || B0) && !I5;\n"
    "//@ late: never D0 && !C0\n"
    "//@ slow: after I6 && !I7, C0 within 0 scans\n"
    "C0 = (I6 || C0) && !I7; D0 = T(0, 700, C0);\n"
    "//@ chain: always F0 -> E0\n"
    "E0 = (I8 || E0) && !I9; E1 = T(1, 300, E0); F0 = T(2, 200, E1) && E1;\n"
    "//@ count: never H0 && !G0\n"
    "G0 = C(0, 20, I10, 0, I11); H0 = G0 && I12;\n"
    "//@ back: recoverable !J0\n"
    "//@ stuck: recoverable K0 && !I14\n"
    "J0 = (I13 || J0) && !I15;\n"
    "K0 = (I14 || K0) && !K1; K1 = K0 || K1;\n"
    "//@ twins: always L0 <-> L1\n"
    "L0 = T(3, 5000, I16); L1 = T(4, 5000, I16);\n"
    "//@ deep: reach M0\n"
    "M0 = T(5, 90000, M1); M1 = (I17 || M1) && !I18;\n";

std::string text_of(const Trace& trace) {
  std::string text;
  for (const Trace::Step& step : trace.steps) {
    text += std::to_string(step.scan) + "+" + std::to_string(step.dt_ms) + ":";
    for (const std::int64_t value : step.values) {
      text += " " + std::to_string(value);
    }
    text += "\n";
  }
  return text;
}

/// All of the report that does not depend on the clock.
std::vector<std::string> answers(const VerifyReport& report) {
  std::vector<std::string> result;
  for (const ObligationResult& one : report.results) {
    std::string text =
        one.obligation.name + " " + std::string(to_string(one.verdict)) + " " +
        one.engine + " " + std::to_string(one.scans) + " " + one.reason + "\n";
    if (one.certificate.has_value()) {
      for (const auto& lines : {one.certificate->lemmas, one.certificate->ways,
                                one.certificate->checked_by}) {
        for (const std::string& line : lines) text += line + "\n";
      }
    }
    if (one.trace.has_value()) text += text_of(*one.trace);
    result.push_back(std::move(text));
  }
  return result;
}

std::vector<std::string> verdicts(const VerifyReport& report) {
  std::vector<std::string> result;
  for (const ObligationResult& one : report.results) {
    result.push_back(one.obligation.name + " " +
                     std::string(to_string(one.verdict)));
  }
  return result;
}

TEST(SameAnswers, InAHundredRunsOfAnyNumberOfThreads) {
  const Source loaded(kParts);
  const std::vector<std::string> first =
      answers(verify(loaded.program, loaded.properties, {}));
  ASSERT_GT(first.size(), 20U);
  std::mt19937 random(7);
  std::vector<std::unique_ptr<char[]>> clutter;  // for other addresses
  const std::uint64_t runs = setting("RUNG_SAME_ANSWERS", 100);
  for (std::uint64_t run = 0; run < runs; ++run) {
    clutter.push_back(std::make_unique<char[]>(random() % 5000));
    VerifyOptions options;
    options.jobs = 1 + static_cast<std::uint32_t>(random() % 8);
    const VerifyReport report =
        verify(loaded.program, loaded.properties, options);
    EXPECT_TRUE(report.failures.empty());
    ASSERT_EQ(answers(report), first) << options.jobs << " threads";
  }
}

TEST(SameAnswers, WithOtherRandomRuns) {
  const Source loaded(kParts);
  const std::vector<std::string> first =
      verdicts(verify(loaded.program, loaded.properties, {}));
  for (std::uint64_t seed = 1; seed <= 25; ++seed) {
    VerifyOptions options;
    options.seed = seed * 0x9e37'79b9'7f4a'7c15U;
    const VerifyReport report =
        verify(loaded.program, loaded.properties, options);
    EXPECT_TRUE(report.failures.empty());
    ASSERT_EQ(verdicts(report), first) << "seed " << seed;
  }
}

TEST(SameAnswers, APartIsDecidedAsIfItWereAlone) {
  const std::string alone =
      "//@ dialect sim\n"
      "//@ lock: interlock A0, A1\n"
      "A0 = (I0 || A0) && !I1 && !A1; A1 = (I2 || A1) && !I1 && !A0;\n";
  const Source one(alone);
  const Source all(kParts);
  VerifyOptions lock;
  lock.wanted = [](std::string_view name) { return name == "lock"; };
  EXPECT_EQ(answers(verify(one.program, one.properties, lock)),
            answers(verify(all.program, all.properties, lock)));
}

}  // namespace
}  // namespace rung
