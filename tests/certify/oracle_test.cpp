#include "smt/oracle.h"

#include <gtest/gtest.h>

#include "programs.h"

namespace rung {
namespace {

using Answer = Oracle::Answer;

/// A program, its system and an oracle on it.
struct Asked {
  std::unique_ptr<Read> script;
  TransitionSystem ts;
  SolverOracle oracle;

  explicit Asked(const std::string& text, std::string_view dialect = "sim",
                 const OracleOptions& options = {})
      : script(read(text, dialect)),
        ts(build_transition_system(script->program)),
        oracle(script->program, ts, options) {}

  ExprId end(const char* cell) {
    return ts.cell_end[find_cell(script->program, cell).index()];
  }
  ExprId not_both(const char* a, const char* b) {
    return ts.exprs.negation(ts.exprs.conjunction(end(a), end(b)));
  }
};

constexpr const char* kMotors =
    "Q0 = (I0 || Q0) && !I1 && !Q1;\nQ1 = (I2 || Q1) && !I1 && !Q0;\n"
    "Q2 = T(0, 3600, I0);\n";

TEST(SolverOracle, SaysYesWithAProof) {
  Asked motors(kMotors);
  const Oracle::Evidence evidence =
      motors.oracle.always(motors.not_both("Q0", "Q1"));
  EXPECT_EQ(evidence.answer, Answer::Yes);
  EXPECT_NE(evidence.engine, "");
  EXPECT_FALSE(evidence.witness.has_value());
}

TEST(SolverOracle, SaysNoWithARun) {
  Asked motors(kMotors);
  const std::vector<Oracle::Evidence> answers = motors.oracle.always(
      {motors.not_both("Q0", "Q2"), motors.not_both("Q0", "Q1"),
       motors.ts.exprs.negation(motors.end("Q2")),
       motors.not_both("Q0", "Q2")});
  ASSERT_EQ(answers.size(), 4U);
  EXPECT_EQ(answers[1].answer, Answer::Yes);
  for (const std::size_t i : {0U, 2U, 3U}) {
    EXPECT_EQ(answers[i].answer, Answer::No) << i;
    ASSERT_TRUE(answers[i].witness.has_value());
    const CellId q2 = find_cell(motors.script->program, "Q2");
    // Behind an hour of scans, in a few steps.
    EXPECT_EQ(answers[i].witness->steps.back().values[q2.index()], 1);
    EXPECT_GE(answers[i].witness->steps.back().scan, 36000U);
    EXPECT_LT(answers[i].witness->steps.size(), 10U);
  }
}

TEST(SolverOracle, KnowsTheAssumptions) {
  Asked motors(kMotors);
  ExprArena& e = motors.ts.exprs;
  const ExprId off = e.negation(motors.end("Q0"));
  motors.ts.constraints = {e.negation(motors.end("I0"))};
  EXPECT_EQ(motors.oracle.always(off).answer, Answer::Yes);
}

TEST(SolverOracle, WithoutTimeIsUnknown) {
  Asked motors(kMotors, "sim", {.seconds = 0});
  EXPECT_EQ(motors.oracle.always(motors.not_both("Q0", "Q1")).answer,
            Answer::Unknown);
}

TEST(SolverOracle, AFaultInTheConeLeavesItOpen) {
  // QW0 grows without bound: past 32 bits the encoding is not the program.
  Asked words("QW0 = QW0 + IW0 + 1;\nQ0 = QW0 < 0;\nQ1 = I0 && !I0;\n");
  ExprArena& e = words.ts.exprs;
  ASSERT_FALSE(words.ts.faults.empty());
  EXPECT_NE(words.oracle.always(e.negation(words.end("Q0"))).answer,
            Answer::Yes);
  EXPECT_EQ(words.oracle.always(e.negation(words.end("Q1"))).answer,
            Answer::Yes);
}

}  // namespace
}  // namespace rung
