#include "smt/equivalence.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "analysis/simulator.h"
#include "programs.h"
#include "smt/correspondence.h"

namespace rung {
namespace {

using Verdict = EquivalenceVerdict;

EquivalenceResult compare(const Program& a, const Program& b,
                          const EquivalenceOptions& options = {}) {
  EquivalenceResult result = check_equivalence(a, b, options);
  EXPECT_TRUE(result.failures.empty())
      << (result.failures.empty() ? "" : result.failures[0].what);
  return result;
}

struct Case {
  const char* name;
  const char* dialect;
  const char* a;
  const char* b;
  Verdict verdict;
  const char* engine = "";  // its first letters, where the case is about it
  std::vector<std::pair<std::string, std::string>> map = {};
};

class Equivalence : public testing::TestWithParam<Case> {};

TEST_P(Equivalence, IsDecided) {
  const Case& c = GetParam();
  const auto a = read(c.a, c.dialect);
  const auto b = read(c.b, c.dialect);
  EquivalenceOptions options;
  options.map = c.map;
  const EquivalenceResult result = compare(a->program, b->program, options);
  EXPECT_EQ(result.error, "");
  EXPECT_EQ(result.verdict, c.verdict) << result.reason;
  EXPECT_EQ(result.engine.substr(0, std::string(c.engine).size()), c.engine)
      << result.engine;
  EXPECT_EQ(result.certificate.has_value(), c.verdict == Verdict::Equivalent);
  if (c.verdict != Verdict::Different) return;
  ASSERT_TRUE(result.trace_a && result.trace_b && result.stimulus_a);
  ASSERT_FALSE(result.trace_a->steps.empty());
  // The output that is said to differ does, at the last scan of both.
  const CellId of_a = find_cell(a->program, result.differs);
  std::string other = result.differs;
  for (const auto& [first, second] : c.map) {
    if (first == result.differs) other = second;
  }
  const CellId of_b = find_cell(b->program, other);
  EXPECT_NE(result.trace_a->steps.back().values[of_a.index()],
            result.trace_b->steps.back().values[of_b.index()]);
  EXPECT_EQ(result.trace_a->steps.back().scan,
            result.trace_b->steps.back().scan);
}

constexpr const char* kDol = "Q0 = (I0 || Q0) && !I1;\n";

INSTANTIATE_TEST_SUITE_P(
    Equal, Equivalence,
    testing::Values(
        Case{"identical", "sim", kDol, kDol, Verdict::Equivalent, "structure"},
        Case{"operands_swapped", "sim", kDol, "Q0 = !I1 && (Q0 || I0);\n",
             Verdict::Equivalent, "structure"},
        Case{"other_expression", "sim", kDol, "Q0 = !I1 && Q0 || !I1 && I0;\n",
             Verdict::Equivalent, "register"},
        Case{"renamed",
             "sim",
             kDol,
             "Q5 = (I7 || Q5) && !I8;\n",
             Verdict::Equivalent,
             "structure",
             {{"Q0", "Q5"}, {"I0", "I7"}, {"I1", "I8"}}},
        Case{"memory_renamed", "sim", "M0 = (I0 || M0) && !I1;\nQ0 = M0;\n",
             "X = (I0 || X) && !I1;\nQ0 = X;\n", Verdict::Equivalent,
             "structure"},
        Case{"memory_left_out", "sim", "M0 = I0 && I1;\nQ0 = M0 || Q0;\n",
             "Q0 = I0 && I1 || Q0;\n", Verdict::Equivalent},
        Case{"negated_memory", "sim", "M0 = I0 && !M0;\nQ0 = M0;\n",
             "N = !I0 || !N && !N2; N2 = !N; Q0 = N2;\n", Verdict::Different},
        Case{"timer_elsewhere", "sim", "Q0 = T(0, 5, I0 && !I1);\n",
             "M0 = I0 && !I1;\nQ0 = T(3, 5, M0);\n", Verdict::Equivalent,
             "structure"},
        Case{"timer_in_other_units", "sim", "Q0 = T(0, 0.5, I0);\n",
             "Q0 = T(0, 5e-1, I0);\n", Verdict::Equivalent, "structure"},
        Case{"counter", "yun", "pin3 = C(0, 3, pin4 && !pin5);\n",
             "pin3 = C(0, 3, !(!pin4 || pin5));\n", Verdict::Equivalent},
        Case{"words", "sim", "Q0 = IW0 + IW1 > 20;\n", "Q0 = IW1 > 20 - IW0;\n",
             Verdict::Equivalent}),
    [](const auto& test) { return std::string(test.param.name); });

INSTANTIATE_TEST_SUITE_P(
    Different, Equivalence,
    testing::Values(Case{"operator", "sim", kDol, "Q0 = (I0 || Q0) || !I1;\n",
                         Verdict::Different},
                    Case{"dominance", "sim", kDol, "Q0 = I0 || Q0 && !I1;\n",
                         Verdict::Different},
                    Case{"initial_value", "sim", "Q0 = M0; M0 = M0 && I0;\n",
                         "Q0 = M0; M0 = M0 && I0;\n//Var\nM0 = 1;\n",
                         Verdict::Different},
                    Case{"preset_by_1_ms", "sim", "Q0 = T(0, 2, I0);\n",
                         "Q0 = T(0, 2.001, I0);\n", Verdict::Different},
                    Case{"behind_an_hour", "sim",
                         "M0 = T(0, 3600, I0); Q0 = M0 && I1;\n",
                         "M0 = T(0, 3600, I0); Q0 = M0 && (I1 || I2);\n",
                         Verdict::Different},
                    Case{"order_of_rungs", "sim", "M0 = I0; Q0 = M0;\n",
                         "Q0 = M0; M0 = I0;\n", Verdict::Different},
                    Case{"counter_preset", "yun", "pin3 = C(0, 3, pin4);\n",
                         "pin3 = C(0, 4, pin4);\n", Verdict::Different},
                    Case{"mapped",
                         "sim",
                         "Q0 = I0; Q1 = !I0;\n",
                         "Q0 = I0; Q1 = !I0;\n",
                         Verdict::Different,
                         "",
                         {{"Q0", "Q1"}, {"Q1", "Q0"}}}),
    [](const auto& test) { return std::string(test.param.name); });

TEST(EquivalenceOf, ADifferenceIsTheShortestAndReplays) {
  const auto a = read("Q0 = T(0, 3600, I0); Q1 = I1;", "sim");
  const auto b = read("Q0 = T(0, 3600, I0); Q1 = I1 && !Q0;", "sim");
  const EquivalenceResult result = compare(a->program, b->program);
  ASSERT_EQ(result.verdict, Verdict::Different) << result.reason;
  EXPECT_EQ(result.differs, "Q1");
  // An hour at 100 ms a scan is 36,000 of them, in a few steps.
  EXPECT_LT(result.trace_a->steps.size(), 8U);
  EXPECT_GE(result.trace_a->steps.back().scan, 36000U);
  EXPECT_LT(result.trace_a->steps.back().scan, 36010U);
}

TEST(EquivalenceOf, StrictAndShortCircuitEvaluationDiffer) {
  // With I0 off, a short circuit never executes the timer.
  const auto script = read("Q0 = I0 && T(0, 1, I1);", "sim");
  Program strict = script->program;
  strict.evaluation = Evaluation::Strict;
  for (Node& node : strict.nodes) {
    if (node.op != NodeOp::Branch) continue;
    // A marker that skips nothing.
    node.op = NodeOp::Constant;
    node.type = Type::Bit;
  }
  const EquivalenceResult result = compare(script->program, strict);
  EXPECT_EQ(result.verdict, Verdict::Different) << result.reason;
  EXPECT_EQ(compare(script->program, script->program).verdict,
            Verdict::Equivalent);
}

TEST(EquivalenceOf, AssumptionsRestrictTheInputs) {
  const auto a = read("Q0 = I0 || I1;", "sim");
  const auto c = read("Q0 = I0 && !I1 || !I0 && I1;", "sim");
  EXPECT_EQ(compare(a->program, c->program).verdict, Verdict::Different);
  EquivalenceOptions options;
  options.assumptions = {"!(I0 && I1)"};
  EXPECT_EQ(compare(a->program, c->program, options).verdict,
            Verdict::Equivalent);
  options.assumptions = {"I0", "!I0"};
  EXPECT_EQ(compare(a->program, c->program, options).verdict, Verdict::Unknown);
}

TEST(EquivalenceOf, AssumptionsOfBothRestrictTheInputs) {
  const auto a = read("Q0 = I0 || I1 || I2;", "sim");
  const auto b = read("Q0 = I7 && !I1 || !I7 && I1;", "sim");
  EquivalenceOptions options;
  options.map = {{"I0", "I7"}};
  options.assumptions = {"!I2"};
  EXPECT_EQ(compare(a->program, b->program, options).verdict,
            Verdict::Different);
  options.assumptions_b = {"!(I7 && I1)"};
  EXPECT_EQ(compare(a->program, b->program, options).verdict,
            Verdict::Equivalent);
  options.assumptions = {};
  EXPECT_EQ(compare(a->program, b->program, options).verdict,
            Verdict::Different);
  options.assumptions_b = {"!(I0 && I1)"};  // I0 is what the first calls it
  EXPECT_NE(compare(a->program, b->program, options).error, "");
}

TEST(EquivalenceOf, OutputsOfOneSideAreSaid) {
  const auto a = read("Q0 = I0; Q1 = I0;", "sim");
  const auto b = read("Q0 = I0; Q2 = I0;", "sim");
  const EquivalenceResult result = compare(a->program, b->program);
  EXPECT_EQ(result.verdict, Verdict::Equivalent);
  EXPECT_EQ(result.outputs, std::vector<std::string>{"Q0"});
  EXPECT_EQ(result.not_compared, (std::vector<std::string>{"a.Q1", "b.Q2"}));
}

// Below -32768 a counter is only known to be there: both sides have to choose
// alike whether it counts back above.
TEST(EquivalenceOf, ACounterBesideWhatIsNotEqualByStructure) {
  const auto a =
      read("Q0 = I0 && (I1 || I2);\nQ1 = C(0, 3, I2, I3, I4);\n", "sim");
  const auto b =
      read("Q0 = I0 && I1 || I0 && I2;\nQ1 = C(0, 3, I2, I3, I4);\n", "sim");
  const EquivalenceResult result = compare(a->program, b->program);
  ASSERT_EQ(result.verdict, Verdict::Equivalent) << result.reason;
  ASSERT_FALSE(result.certificate->checked_by.empty());
  EXPECT_EQ(result.certificate->checked_by.front(), "structure");
  EXPECT_GT(result.certificate->checked_by.size(), 1U);
}

TEST(EquivalenceOf, TimersComparedInPropertiesOfOneSideChangeNothing) {
  // A property raises the cap of the clock: the source has it, what was
  // lowered from it has not.
  const auto a = read("Q0 = T(0, 1, I0);", "sim");
  const auto b = read("Q0 = T(0, 1, I0);", "sim");
  Program raised = a->program;
  raised.instances[InstanceId(0)].clock_cap = 50000;
  const EquivalenceResult result = compare(raised, b->program);
  EXPECT_EQ(result.engine, "structure");
}

TEST(EquivalenceOf, LargeProgramsThatAreEqualNeedNoSolver) {
  std::string text;
  for (int i = 0; i < 2000; ++i) {
    const std::string n = std::to_string(i);
    text += "M" + n + " = (I0 || M" + n + ") && !I1 && T(" + n + ", 2, I2);\n";
  }
  text += "Q0 = M1999;\n";
  const auto a = read(text, "sim");
  const EquivalenceResult result = compare(a->program, a->program);
  EXPECT_EQ(result.verdict, Verdict::Equivalent);
  EXPECT_EQ(result.engine, "structure");
  EXPECT_EQ(result.certificate->checked_by,
            std::vector<std::string>{"structure"});
}

struct Refusal {
  const char* name;
  const char* a;
  const char* b;
  std::vector<std::pair<std::string, std::string>> map;
  const char* says;
};
class EquivalenceRefuses : public testing::TestWithParam<Refusal> {};

TEST_P(EquivalenceRefuses, WithAReason) {
  const auto a = read(GetParam().a, "sim");
  const auto b = read(GetParam().b, "sim");
  EquivalenceOptions options;
  options.map = GetParam().map;
  const EquivalenceResult result =
      check_equivalence(a->program, b->program, options);
  EXPECT_NE(result.error.find(GetParam().says), std::string::npos)
      << result.error;
  EXPECT_EQ(result.verdict, Verdict::Unknown);
}

INSTANTIATE_TEST_SUITE_P(
    Refused, EquivalenceRefuses,
    testing::Values(
        Refusal{"nothing_shared", "Q0 = I0;", "Q1 = I0;", {}, "no output"},
        Refusal{"unknown_first",
                "Q0 = I0;",
                "Q0 = I0;",
                {{"Q9", "Q0"}},
                "`Q9` is no signal of the first program"},
        Refusal{"unknown_second",
                "Q0 = I0;",
                "Q0 = I0;",
                {{"Q0", "Q9"}},
                "`Q9` is no signal of the second program"},
        Refusal{"twice_first",
                "Q0 = I0;",
                "Q0 = I0; Q1 = I1;",
                {{"Q0", "Q0"}, {"Q0", "Q1"}},
                "twice"},
        Refusal{"twice_second",
                "Q0 = I0; Q1 = I1;",
                "Q0 = I0;",
                {{"Q0", "Q0"}, {"Q1", "Q0"}},
                "twice"},
        Refusal{"input_to_output",
                "Q0 = I0; Q1 = Q0;",
                "Q0 = I0; Q1 = Q0;",
                {{"I0", "Q1"}},
                "is an input of the first program only"},
        Refusal{"output_to_input",
                "Q0 = I0; Q1 = Q0;",
                "Q0 = I0; Q1 = Q0;",
                {{"Q1", "I0"}},
                "is an input of the second program only"},
        Refusal{"types",
                "Q0 = I0; QW0 = IW0;",
                "Q0 = I0; QW0 = IW0;",
                {{"Q0", "QW0"}},
                "is a bit in the first program"}),
    [](const auto& test) { return std::string(test.param.name); });

TEST(EquivalenceRefuses, ScanIntervalsThatDiffer) {
  const auto a = read("Q0 = I0;", "sim");
  Program b = a->program;
  b.scan.max_ms += 1;
  const EquivalenceResult result = check_equivalence(a->program, b, {});
  EXPECT_NE(result.error.find("the scan takes"), std::string::npos);
}

TEST(EquivalenceRefuses, AssumptionsOverWhatIsNoInput) {
  const auto a = read("Q0 = I0;", "sim");
  for (const char* text : {"Q0", "I0 &&", "prev(I0)", "X"}) {
    EquivalenceOptions options;
    options.assumptions = {text};
    EXPECT_NE(check_equivalence(a->program, a->program, options).error, "")
        << text;
  }
}

// --- the structural check itself ---------------------------------------------

TEST(Correspondence, AWrongClaimIsRefuted) {
  const auto a = read("M0 = I0 && I1; Q0 = M0 || Q0;", "sim");
  const auto b = read("M0 = I0 || I1; Q0 = M0 || Q0;", "sim");
  const TransitionSystem ts_a = build_transition_system(a->program);
  const TransitionSystem ts_b = build_transition_system(b->program);
  const SharedSignals shared = share_signals(a->program, b->program, {});
  const auto pairs = states_by_name(a->program, b->program, ts_a, ts_b, shared);
  const TwoSystems same{ts_a, ts_a, shared};
  Correspondence right = correspond(same, pairs);
  EXPECT_TRUE(right.outputs_equal);
  EXPECT_EQ(check_correspondence(same, right), "");

  const TwoSystems systems{ts_a, ts_b, shared};
  const Correspondence found = correspond(systems, pairs);
  EXPECT_FALSE(found.outputs_equal);
  EXPECT_EQ(check_correspondence(systems, found), "");
  // Claims of more than there is: all of the other system's images.
  Correspondence wrong = right;
  wrong.image.resize(ts_b.exprs.size());
  EXPECT_NE(check_correspondence(systems, wrong), "");
  Correspondence hasty = found;
  hasty.outputs_equal = true;
  EXPECT_NE(check_correspondence(systems, hasty), "");
  Correspondence more = found;
  more.states = pairs;
  EXPECT_NE(check_correspondence(systems, more), "");
}

}  // namespace
}  // namespace rung
