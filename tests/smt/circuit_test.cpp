#include <gtest/gtest.h>
#include <rapidcheck.h>

#include "smt/bit_blast.h"
#include "smt/interpret.h"
#include "smt/lanes.h"
#include "tests/smt/random_terms.h"

namespace rung {
namespace {

using test::RandomTerms;

TEST(Circuit, AgreesWithTheTermsItEncodes) {
  const bool ok = rc::check([] {
    RandomTerms random;
    std::vector<ExprId> roots = random.words;
    roots.insert(roots.end(), random.bits.begin(), random.bits.end());
    StepCircuit circuit(random.ts);
    for (ExprId root : roots) circuit.word(root);
    Lanes lanes(circuit.aig());
    Interpreter terms(random.ts, roots);
    std::vector<std::vector<std::int64_t>> values(Lanes::kCount);
    for (std::uint32_t lane = 0; lane < Lanes::kCount; ++lane) {
      for (VarId input : random.inputs) {
        const Variable& var = random.ts.vars[input];
        const auto value = *rc::gen::inRange(var.low, var.high + 1);
        values[lane].push_back(value);
        lanes.set(circuit.leaves(input), lane, value);
      }
    }
    lanes.evaluate();
    for (std::uint32_t lane = 0; lane < Lanes::kCount; ++lane) {
      for (std::size_t i = 0; i < random.inputs.size(); ++i) {
        terms.set_input(random.inputs[i], values[lane][i]);
      }
      terms.scan();
      for (ExprId root : roots) {
        const Word& word = circuit.word(root);
        const std::int64_t got =
            random.ts.exprs[root].type == Type::Bit
                ? static_cast<std::int64_t>(lanes.value(word[0]) >> lane & 1U)
                : lanes.value(word, lane);
        RC_ASSERT(got == terms.value(root));
      }
      for (VarId input : random.inputs) {
        const AigLit in = circuit.in_range(input);
        (void)in;
      }
    }
    RC_ASSERT(!circuit.overflow());
  });
  EXPECT_TRUE(ok);
}

TEST(Words, WidthHoldsBothEnds) {
  EXPECT_EQ(word_width(0, 0), 1U);
  EXPECT_EQ(word_width(0, 1), 2U);
  EXPECT_EQ(word_width(0, 255), 9U);
  EXPECT_EQ(word_width(0, 256), 10U);
  EXPECT_EQ(word_width(-1, 0), 1U);
  EXPECT_EQ(word_width(-128, 127), 8U);
  EXPECT_EQ(word_width(-129, 127), 9U);
}

TEST(Circuit, SaysSoWhenNoWidthIsEnough) {
  TransitionSystem ts;
  const VarId x = ts.add_input("x", VarRole::Input, Type::Word,
                               -(std::int64_t{1} << 40), std::int64_t{1} << 40);
  StepCircuit circuit(ts);
  circuit.word(ts.of(x));
  EXPECT_FALSE(circuit.overflow());
  circuit.word(ts.exprs.multiply(ts.of(x), ts.of(x)));
  EXPECT_TRUE(circuit.overflow());
}

/// What two-level rewriting sees and plain hashing does not.
TEST(Aig, RewritesTwoLevels) {
  Aig aig;
  const AigLit a = aig.input();
  const AigLit b = aig.input();
  const AigLit c = aig.input();
  const AigLit ab = aig.conjunction(a, b);
  EXPECT_EQ(aig.conjunction(ab, aig_not(a)), kAigFalse);
  EXPECT_EQ(aig.conjunction(ab, b), ab);
  EXPECT_EQ(aig.conjunction(aig_not(ab), aig_not(b)), aig_not(b));
  EXPECT_EQ(aig.conjunction(aig_not(ab), a), aig.conjunction(a, aig_not(b)));
  EXPECT_EQ(aig.conjunction(ab, aig.conjunction(aig_not(b), c)), kAigFalse);
  EXPECT_EQ(
      aig.conjunction(aig_not(ab), aig_not(aig.conjunction(a, aig_not(b)))),
      aig_not(a));
}

}  // namespace
}  // namespace rung
