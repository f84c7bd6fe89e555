// Reports that are broken or about something else are refused, and lemmas that
// say nothing; never is anything confirmed by them.

#include "check/result_file.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "check/lemma.h"
#include "confirm.h"
#include "random_run.h"

namespace rung {
namespace {

using check::ClaimedProperty;
using check::ClaimedResult;
using check::read_result;

constexpr std::string_view kGood = R"({
  "schema": "rungproof.result/1",
  "files": [{"language": "script", "dialect": "sim", "semantics": "sim",
             "scan_ms": [1, 100]}],
  "properties": [{"name": "a", "kind": "always", "text": "a: always I0 || !I0",
    "goal": "invariant", "verdict": "proved",
    "certificate": {"k": 0, "lemmas": ["Q0"]}}]})";

std::string changed(std::string_view from, std::string_view to) {
  std::string text(kGood);
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

TEST(ResultFile, IsRead) {
  const ClaimedResult result = read_result(kGood);
  EXPECT_EQ(result.error, "");
  EXPECT_EQ(result.scan_max_ms, 100);
  ASSERT_EQ(result.properties.size(), 1U);
  EXPECT_EQ(result.properties[0].lemmas, std::vector<std::string>{"Q0"});
}

TEST(ResultFile, IsRefusedWhenItIsNone) {
  const std::string deep(100'000, '[');
  const std::vector<std::string> texts = {
      "",
      "{",
      "null",
      "[]",
      "{}",
      deep,
      std::string(kGood.substr(0, kGood.size() - 1)),
      changed("rungproof.result/1", "rungproof.result/2"),
      changed("rungproof.result/1", "rungproof.equiv/1"),
      changed("\"files\": [{", "\"files\": [{}, {"),
      changed("\"language\": \"script\",", ""),
      changed("[1, 100]", "null"),
      changed("[1, 100]", "[1]"),
      changed("[1, 100]", "[1, \"x\"]"),
      changed("[1, 100]", "[1.5, 100]"),
      changed("\"name\": \"a\",", ""),
      changed("\"name\": \"a\"", "\"name\": 3"),
      changed("\"k\": 0", "\"k\": -1"),
      changed("\"k\": 0", "\"k\": 65"),
      changed("\"k\": 0", "\"k\": 0.5"),
      changed("\"k\": 0,", ""),
      changed("[\"Q0\"]", "\"Q0\""),
      changed("[\"Q0\"]", "[[]]"),
      changed("\"certificate\": {\"k\": 0, \"lemmas\": [\"Q0\"]}",
              "\"certificate\": 7"),
      changed("\"properties\": [{", "\"properties\": [3, {"),
  };
  for (const std::string& text : texts) {
    EXPECT_NE(read_result(text).error, "") << text.substr(0, 200);
  }
}

TEST(ResultFile, IsRefusedWhenANameIsThereTwice) {
  const std::string text(kGood);
  const std::size_t begin = text.find("{\"name\"");
  const std::size_t end = text.find("]})");
  const std::string property = text.substr(begin, text.rfind(']') - begin);
  const std::string twice =
      text.substr(0, begin) + property + ", " + text.substr(begin);
  EXPECT_EQ(read_result(twice).error, "two properties are called `a`");
  EXPECT_EQ(end, std::string::npos);
}

// --- lemmas ------------------------------------------------------------------

constexpr std::string_view kProgram = R"(//@ stop: always I1 -> !Q0
//@ low: I0 for 2 s implies Q0 || I1
//@ seen: always once(I0 || I1) || !Q0
Q0 = (I0 || Q0) && !I1;
M1 = T(0, 2, I0);
QW0 = IW0 + 1;
)";

class Lemmas : public testing::Test {
 protected:
  void SetUp() override {
    std::string error;
    read_ = read_program("sim", std::string(kProgram), error);
    ASSERT_TRUE(read_) << error;
    values_ = encode_program(read_->program, model_);
    goals_ =
        encode_properties(read_->program, read_->properties, values_, model_);
  }
  std::string error_of(const std::string& text) {
    return check::read_lemma(text, model_).error;
  }

  std::optional<ReadProgram> read_;
  check::Model model_;
  check::ProgramValues values_;
  std::vector<check::Goal> goals_;
};

TEST_F(Lemmas, AreRead) {
  for (const char* const text :
       {"Q0", "!Q0 || M1", "T(0).elapsed >= 2000", "(T(0).elapsed[3] || Q0)",
        "low.held <= 2000", "low.was == Q0", "once(I0 || I1)", "true",
        "QW0 + -3 < 7 * QW0", "QW0 / -2 != wrap16(QW0)", "(Q0 ? QW0 : 3) >= 1",
        "!(!Q0 && (M1 != T(0).started))"}) {
    EXPECT_EQ(error_of(text), "") << text;
  }
}

TEST_F(Lemmas, AreRefused) {
  const std::string deep(200'000, '(');
  for (const std::string& text :
       std::vector<std::string>{"",
                                "Q0 ||",
                                "|| Q0",
                                "Q00",
                                "Q",
                                "I0",
                                "IW0 > 3",
                                "dt > 1",
                                "QW0",
                                "3",
                                "!QW0",
                                "Q0 + Q0",
                                "QW0 && Q0",
                                "Q0 < QW0",
                                "QW0 == Q0",
                                "(Q0",
                                "Q0)",
                                "Q0 ? Q0",
                                "Q0 : Q0",
                                "Q0 ? QW0 : Q0",
                                "QW0[61]",
                                "QW0[",
                                "QW0 / QW0 > 1",
                                "QW0 / 0 > 1",
                                "99999999999999999999 > 1",
                                "wrap16(Q0) > 1",
                                "Q0 Q0",
                                "Q0 || ...",
                                "T(1).elapsed >= 1",
                                "T(0).elapsed.x >= 1",
                                "stop.seen",
                                "Q0; false",
                                "Q0 -> Q0",
                                deep,
                                deep + "Q0"}) {
    EXPECT_NE(error_of(text), "") << text.substr(0, 80);
  }
}

TEST_F(Lemmas, ThatAreCutOffAreSaidToBe) {
  EXPECT_TRUE(check::read_lemma("Q0 || M1 ...", model_).cut_off);
}

// --- claims ------------------------------------------------------------------

class Claims : public Lemmas {
 protected:
  static ClaimedProperty stop() {
    ClaimedProperty property;
    property.name = "stop";
    property.kind = "always";
    property.text = "stop: always I1 -> !Q0";
    property.goal = "invariant";
    property.verdict = "proved";
    property.has_certificate = true;
    return property;
  }
  std::string outcome_of(const ClaimedProperty& property) {
    ClaimedResult claimed;
    claimed.properties.push_back(property);
    Confirmation confirmation;
    confirmation.add(read_->program, read_->properties, claimed);
    return std::string(to_string(confirmation.ask().front().front().outcome));
  }
};

TEST_F(Claims, AreConfirmed) { EXPECT_EQ(outcome_of(stop()), "confirmed"); }

TEST_F(Claims, OfAnotherPropertyAreRejected) {
  ClaimedProperty property = stop();
  property.text = "stop: always I1 -> Q0";
  EXPECT_EQ(outcome_of(property), "rejected");
  property = stop();
  property.name = "stopp";
  EXPECT_EQ(outcome_of(property), "rejected");
  property = stop();
  property.kind = "never";
  EXPECT_EQ(outcome_of(property), "rejected");
  property = stop();
  property.goal = "reach";
  EXPECT_EQ(outcome_of(property), "rejected");
}

TEST_F(Claims, WithAWrongLemmaAreRejected) {
  for (const char* const lemma : {"false", "Q0", "!Q0", "nothing", "I1 || !Q0",
                                  "T(0).elapsed < 2000", "low.held < 2000"}) {
    ClaimedProperty property = stop();
    property.lemmas = {lemma};
    EXPECT_EQ(outcome_of(property), "rejected") << lemma;
  }
}

TEST_F(Claims, WithoutACertificateAreNotChecked) {
  ClaimedProperty property = stop();
  property.has_certificate = false;
  EXPECT_EQ(outcome_of(property), "not checked");
}

}  // namespace
}  // namespace rung
