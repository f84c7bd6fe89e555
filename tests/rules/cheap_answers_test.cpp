#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "analysis/program.h"
#include "analysis/rules/enumeration.h"
#include "analysis/rules/sampling.h"
#include "analysis/transition_system.h"
#include "explicit_oracle.h"
#include "frontend/script/reader.h"
#include "random_script.h"

namespace rung::testing {
namespace {

constexpr std::uint64_t kWork = 4'000'000;

TransitionSystem system_of(const std::string& script) {
  SourceSet sources;
  const FileId file = sources.add("test.rung", script);
  DiagnosticList sink;
  const Ast ast = read_script(sources, file, "sim", sink);
  BuildOptions options;
  options.scan = {100, 100};
  const Program program = build_program(ast, options, sink);
  EXPECT_FALSE(sink.has_errors()) << script;
  return build_transition_system(program);
}

/// Every bit of the system and its inverse.
std::vector<ExprId> all_bits(TransitionSystem& ts) {
  std::vector<ExprId> bits;
  const auto size = static_cast<std::uint32_t>(ts.exprs.size());
  for (std::uint32_t i = 0; i < size; ++i) {
    if (ts.exprs[ExprId(i)].type != Type::Bit) continue;
    bits.push_back(ExprId(i));
    bits.push_back(ts.exprs.negation(ExprId(i)));
  }
  return bits;
}

struct Counts {
  std::size_t enumerated = 0;
  std::size_t refuted = 0;
};

void compare(const std::string& script, Counts& counts) {
  TransitionSystem ts = system_of(script);
  const std::vector<ExprId> bits = all_bits(ts);
  const std::vector<bool> known = enumerate(ts, bits);
  const std::vector<bool> refuted = sample(ts, bits, kWork);
  const std::vector<Oracle::Evidence> truth = ExplicitOracle(ts).always(bits);
  for (std::size_t i = 0; i < bits.size(); ++i) {
    if (known[i]) ++counts.enumerated;
    if (refuted[i]) ++counts.refuted;
    EXPECT_FALSE(known[i] && truth[i].answer == Oracle::Answer::No)
        << script << to_string(ts, bits[i]) << " is not always true";
    EXPECT_FALSE(refuted[i] && truth[i].answer == Oracle::Answer::Yes)
        << script << to_string(ts, bits[i]) << " is always true";
  }
}

TEST(CheapAnswers, AgreeWithTheVisitOfEveryState) {
  Counts counts;
  for (unsigned seed = 0; seed < 40; ++seed) {
    compare(RandomScript(seed, seed % 2 == 0 ? "0.2" : "1.5").text(), counts);
  }
  // The comparison is worth something only when it compares.
  EXPECT_GT(counts.enumerated, 20U);
  EXPECT_GT(counts.refuted, 1000U);
}

/// Is the last rung true in a sampled run?
bool sampling_meets(const std::string& script) {
  TransitionSystem ts = system_of(script);
  return sample(ts, {ts.exprs.negation(ts.rung_value.back())}, kWork)[0];
}

TEST(Sampling, WaitsForLongTimers) {
  EXPECT_TRUE(sampling_meets("M0 = T(0, 3600, I0);\n"));
  const std::string both = "M0 = T(0, 3600, I0);\nM1 = T(1, 3601, I0);\n";
  EXPECT_TRUE(sampling_meets(both + "M2 = M0 && !M1;\n"));
  // The longer one is never the first: waiting must not jump over that.
  EXPECT_FALSE(sampling_meets(both + "M2 = M1 && !M0;\n"));
}

TEST(Enumeration, SeesWhatIsTrueOfEveryValue) {
  TransitionSystem ts = system_of("M0 = I0 && (I1 || I2);\nM1 = M0 && !I0;\n");
  const ExprId never = ts.exprs.negation(ts.rung_value[1]);
  const ExprId often = ts.exprs.negation(ts.rung_value[0]);
  EXPECT_FALSE(ts.exprs.is_true(never));
  EXPECT_EQ(enumerate(ts, {never, often}), (std::vector<bool>{true, false}));
}

TEST(Enumeration, SaysNothingOfMoreThanItCanTry) {
  std::string text = "M0 = I0";
  for (int i = 0; i < 30; ++i) text += " && a" + std::to_string(i);
  TransitionSystem ts = system_of(text + ";\nM1 = M0 && !I0;\n");
  const ExprId never = ts.exprs.negation(ts.rung_value.back());
  EXPECT_FALSE(ts.exprs.is_true(never));
  EXPECT_FALSE(enumerate(ts, {never})[0]);
}

}  // namespace
}  // namespace rung::testing
