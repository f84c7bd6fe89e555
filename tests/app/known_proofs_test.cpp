// Proofs of a former state of a program: what is taken over is what the slice
// of a property says, and never more than what proving it anew would say.

#include "app/known_proofs.h"

#include <gtest/gtest.h>

#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "app/certificate_names.h"
#include "app/load.h"
#include "app/packed_result.h"

namespace rung::test {
namespace {

/// A program in memory, with its properties.
struct Script {
  explicit Script(const std::string& text) {
    const FileId file = sources.add("a.rung", text);
    loaded = load({file, "a.rung", {}}, Options(), {}, sources);
    EXPECT_TRUE(loaded.program) << text;
  }
  const Program& program() const { return *loaded.program; }
  const PropertySet& properties() const { return loaded.report.properties; }

  SourceSet sources;
  Loaded loaded;
};

/// By what a property says: names may have lines in them.
using Answers = std::map<std::string, std::string>;
Answers answers_of(const VerifyReport& report) {
  Answers answers;
  for (const ObligationResult& result : report.results) {
    answers[result.obligation.text + "/" +
            std::to_string(result.obligation.part)] =
        std::string(to_string(result.verdict)) + " " + result.reason;
  }
  return answers;
}

KnownProofs prove(const Script& script, std::string& known,
                  const VerifyOptions& options = {}) {
  return verify_unknown(script.program(), script.properties(), options, known);
}

std::string known_of(const std::string& text) {
  const Script script(text);
  std::string known;
  EXPECT_EQ(prove(script, known).taken, 0U);
  return known;
}

/// How many of the answers of `before` are taken over in `after`, where all
/// answers have to be as if nothing were known.
std::size_t taken(const std::string& before, const std::string& after) {
  std::string known = known_of(before);
  const Script script(after);
  const KnownProofs proofs = prove(script, known);
  EXPECT_TRUE(proofs.report.failures.empty());
  const VerifyReport anew = verify(script.program(), script.properties(), {});
  EXPECT_EQ(answers_of(proofs.report), answers_of(anew)) << after;
  std::uint32_t last = 0;
  for (const ObligationResult& result : proofs.report.results) {
    EXPECT_LE(last, result.obligation.property) << "in their order";
    last = result.obligation.property;
    EXPECT_EQ(result.obligation.where,
              script.properties().properties[last].where);
  }
  return proofs.taken;
}

constexpr const char* kLines =
    "//@ stopped: never Q0 && I1\n"
    "//@ after I0, Q0 within 3 scans\n"
    "//@ never Q1 && !I2\n";
constexpr const char* kFirst = "Q0 = (I0 || Q0) && !I1;\n";
constexpr const char* kSecond = "Q1 = I2 && (Q1 || I3);\n";
// Four obligations are about the first rung (two of them built in), three about
// the second.
constexpr std::size_t kOfFirst = 4;
constexpr std::size_t kOfSecond = 3;

std::string plant(const std::string& first, const std::string& second,
                  const std::string& more = "") {
  return more + kLines + first + second;
}

TEST(KnownProofs, TakesAllOfAProgramThatOnlyMoved) {
  EXPECT_EQ(taken(plant(kFirst, kSecond),
                  plant(kFirst, kSecond, "// one\n\n// more\n")),
            kOfFirst + kOfSecond);
}

TEST(KnownProofs, TakesWhatDoesNotDependOnTheEdit) {
  const std::string before = plant(kFirst, kSecond);
  EXPECT_EQ(taken(before, plant(kFirst, "Q1 = I2 && (Q1 || I4);\n")), kOfFirst);
  EXPECT_EQ(taken(before, plant("Q0 = (I0 || I5 || Q0) && !I1;\n", kSecond)),
            kOfSecond);
  EXPECT_EQ(taken(before, plant(kFirst, std::string(kSecond) + "Q2 = I6;\n")),
            kOfFirst + kOfSecond);
  EXPECT_EQ(taken(before, plant(kSecond, kFirst)), kOfFirst + kOfSecond)
      << "no rung reads the other's coil";
}

TEST(KnownProofs, AnAssumptionIsBelowEverything) {
  EXPECT_EQ(taken(plant(kFirst, kSecond),
                  plant(kFirst, kSecond, "//@ assume !I3 || I2\n")),
            0U);
}

TEST(KnownProofs, TheScanIntervalIsBelowEverything) {
  EXPECT_EQ(taken(plant(kFirst, kSecond),
                  plant(kFirst, kSecond, "//@ scan 1..5ms\n")),
            0U);
}

TEST(KnownProofs, WhatAPropertySaysIsPartOfIt) {
  const std::string text = plant(kFirst, kSecond);
  std::string other = text;
  other.replace(other.find("within 3"), 8, "within 4");
  EXPECT_EQ(taken(text, other), kOfFirst + kOfSecond - 1);
}

// Every state of a small plant after every other: whatever is known, the
// answers are those of a run that knows nothing.
TEST(KnownProofs, IsNeverWrongAboutAnyChange) {
  const std::vector<std::string> rungs = {
      "Q0 = (I0 || Q0) && !I1;\nQ1 = Q0 && I2;\n",
      "Q0 = I0 || Q0 || !I1;\nQ1 = Q0 && I2;\n",
      "Q1 = Q0 && I2;\nQ0 = (I0 || Q0) && !I1;\n",
      "M0 = I0;\nQ0 = (M0 || Q0) && !I1;\nQ1 = Q0 && I2;\n",
      "Q0 = (M0 || Q0) && !I1;\nM0 = I0;\nQ1 = Q0 && I2;\n",
      "Q0 = T(1, 0.5, I0) && !I1;\nQ1 = I2;\n",
      "Q0 = T(1, 0.6, I0) && !I1;\nQ1 = I2;\n",
      "Q0 = T(1, 0.5, I2) && !I1;\nQ1 = I2;\n",
  };
  std::vector<std::string> plants;
  for (const std::string& text : rungs) {
    const std::string lines =
        "//@ never Q0 && I1\n//@ never Q1 && Q0 && !I2\n"
        "//@ always Q1 -> I2\n//@ reach Q0 && Q1\n//@ recoverable !Q0\n";
    plants.push_back(lines + text);
  }
  for (const std::string& before : plants) {
    for (const std::string& after : plants) taken(before, after);
  }
}

TEST(KnownProofs, ARunHasToGetThere) {
  std::string known = known_of(plant(kFirst, kSecond));
  Packed forged = from_bytes(known);
  std::size_t changed = 0;
  for (auto& entry : forged.at(1)) {
    Packed& trace = entry.at(0).at(6);
    if (trace.is_null()) continue;
    for (Packed& step : trace.at(0)) {
      for (Packed& value : step.at(3)) value = 0;
    }
    ++changed;
  }
  ASSERT_EQ(changed, 1U);
  known = to_bytes(forged);
  const Script script(plant(kFirst, kSecond));
  const KnownProofs proofs = prove(script, known);
  EXPECT_EQ(proofs.taken, kOfFirst + kOfSecond - 1);
  EXPECT_EQ(answers_of(proofs.report),
            answers_of(verify(script.program(), script.properties(), {})));
}

TEST(KnownProofs, OtherBytesAreNothingKnown) {
  const std::string text = plant(kFirst, kSecond);
  const std::string whole = known_of(text);
  const Script script(text);
  for (std::string known :
       {std::string("x"), std::string("\x80"), whole.substr(0, 40),
        whole.substr(1), to_bytes(Packed::array({1, 2})),
        to_bytes(Packed::array({Packed::array(), Packed::array({1})}))}) {
    EXPECT_EQ(prove(script, known).taken, 0U);
    EXPECT_EQ(known.size(), whole.size()) << "it is known again";
  }
}

TEST(KnownProofs, KeepsWhatWasNotAskedFor) {
  const std::string text = plant(kFirst, kSecond);
  std::string known = known_of(text);
  const std::string before = known;
  VerifyOptions one;
  one.wanted = [](std::string_view name) { return name == "stopped"; };
  const KnownProofs proofs = prove(Script(text), known, one);
  ASSERT_EQ(proofs.report.results.size(), 1U);
  EXPECT_EQ(proofs.report.results[0].obligation.name, "stopped");
  EXPECT_EQ(known, before);
}

TEST(KnownProofs, ACertificateHasToNameWhatItNamed) {
  const std::string text =
      "//@ never Q0 && Q1\nQ0 = (I0 || Q0) && !Q1 && !I2;\n"
      "Q1 = (I1 || Q1) && !Q0 && !I3;\nQ2 = Q0 && Q1;\n";
  std::string known = known_of(text);
  const Script script(text);
  const std::size_t all = prove(script, known).taken;
  Packed forged = from_bytes(known);
  std::size_t with_names = 0;
  for (auto& entry : forged.at(1)) {
    for (Packed& named : entry.at(1)) named.at(2) = std::string(64, '0');
    with_names += entry.at(1).empty() ? 0 : 1;
  }
  EXPECT_GT(with_names, 0U);
  known = to_bytes(forged);
  EXPECT_EQ(prove(script, known).taken, all - with_names);
}

TEST(CertificateNames, FindsNamesAndNotWordsWithinOthers) {
  TransitionSystem ts;
  const auto state = [&](const std::string& name) {
    ts.add_state(name, Type::Bit, 0, 1, 0);
  };
  for (const char* const name : {"Q1", "Q10", "T(1).elapsed", "a@3.age", "x"}) {
    state(name);
  }
  const CertificateNames names(ts);
  Certificate certificate;
  certificate.lemmas = {"!Q1 || T(1).elapsed >= 5"};
  certificate.ways = {"(a@3.age)"};
  const std::vector<VarId> found = names.in(certificate);
  std::set<std::string> printed;
  for (const VarId var : found) printed.insert(ts.vars[var].name);
  EXPECT_EQ(printed, (std::set<std::string>{"Q1", "T(1).elapsed", "a@3.age"}));
  rename(certificate, {{"a@3.age", "a@4.age"}, {"Q1", "Q2"}});
  EXPECT_EQ(certificate.lemmas[0], "!Q2 || T(1).elapsed >= 5");
  EXPECT_EQ(certificate.ways[0], "(a@4.age)");
  certificate.lemmas = {"Q10 && Q11 && Q1x"};
  rename(certificate, {{"Q1", "Q2"}, {"Q10", "Q20"}});
  EXPECT_EQ(certificate.lemmas[0], "Q20 && Q11 && Q1x");
}

}  // namespace
}  // namespace rung::test
