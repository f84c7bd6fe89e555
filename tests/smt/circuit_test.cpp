#include <gtest/gtest.h>
#include <rapidcheck.h>

#include "smt/bit_blast.h"
#include "smt/interpret.h"
#include "smt/lanes.h"

namespace rung {
namespace {

/// Random terms over a few inputs; every operator occurs.
struct RandomTerms {
  TransitionSystem ts;
  std::vector<ExprId> bits;
  std::vector<ExprId> words;
  std::vector<VarId> inputs;

  ExprId a_bit() {
    return bits[*rc::gen::inRange<std::size_t>(0, bits.size())];
  }
  ExprId a_word() {
    return words[*rc::gen::inRange<std::size_t>(0, words.size())];
  }

  RandomTerms() {
    const auto word_input = [&](std::int64_t low, std::int64_t high) {
      inputs.push_back(ts.add_input("w" + std::to_string(inputs.size()),
                                    VarRole::Input, Type::Word, low, high));
      words.push_back(ts.of(inputs.back()));
    };
    for (int i = 0; i < 3; ++i) {
      inputs.push_back(ts.add_input("b" + std::to_string(i), VarRole::Input,
                                    Type::Bit, 0, 1));
      bits.push_back(ts.of(inputs.back()));
    }
    word_input(0, 1023);
    word_input(-7, 12);
    word_input(-40000, 40000);
    word_input(-9, -3);
    words.push_back(ts.exprs.word(*rc::gen::inRange(-300, 300)));
    const int steps = *rc::gen::inRange(1, 40);
    for (int i = 0; i < steps; ++i) add_one();
  }

  bool small(ExprId id) const {
    const Expr& e = ts.exprs[id];
    return e.low > -(std::int64_t{1} << 28) && e.high < std::int64_t{1} << 28;
  }

  void add_one() {
    ExprArena& e = ts.exprs;
    const ExprId a = a_word();
    const ExprId b = a_word();
    switch (*rc::gen::inRange(0, 12)) {
      case 0:
        bits.push_back(e.negation(a_bit()));
        break;
      case 1:
        bits.push_back(e.conjunction(a_bit(), a_bit()));
        break;
      case 2:
        bits.push_back(e.exclusive_or(a_bit(), a_bit()));
        break;
      case 3:
        bits.push_back(e.equal(a, b));
        break;
      case 4:
        bits.push_back(e.less(a, b));
        break;
      case 5:
        words.push_back(e.wrap16(a));
        break;
      case 6:
        words.push_back(e.ite(a_bit(), a, b));
        break;
      case 7:
        bits.push_back(e.ite(a_bit(), a_bit(), a_bit()));
        break;
      case 8: {
        const std::int64_t by = *rc::gen::inRange(-20, 20);
        words.push_back(e.divide(a, by == 0 ? 7 : by));
        break;
      }
      case 9:
        words.push_back(e.minimum(a, b));
        break;
      case 10:
        if (small(a) && small(b)) words.push_back(e.multiply(a, b));
        break;
      default:
        if (small(a) && small(b)) words.push_back(e.add(a, b));
        break;
    }
  }
};

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
