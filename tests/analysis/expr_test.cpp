#include "analysis/expr.h"

#include <gtest/gtest.h>

namespace rung {
namespace {

class ExprTest : public testing::Test {
 protected:
  ExprId bit(std::uint32_t index) {
    return exprs.variable(VarId(index), Type::Bit, 0, 1);
  }
  ExprId word(std::uint32_t index, std::int64_t low, std::int64_t high) {
    return exprs.variable(VarId(100 + index), Type::Word, low, high);
  }
  ExprArena exprs;
};

TEST_F(ExprTest, EqualTermsHaveEqualIds) {
  const ExprId a = bit(0);
  const ExprId b = bit(1);
  EXPECT_EQ(exprs.conjunction(a, b), exprs.conjunction(b, a));
  EXPECT_EQ(
      exprs.disjunction(a, b),
      exprs.negation(exprs.conjunction(exprs.negation(b), exprs.negation(a))));
  EXPECT_EQ(exprs.exclusive_or(exprs.negation(a), b),
            exprs.negation(exprs.exclusive_or(a, b)));
  EXPECT_EQ(exprs.ite(exprs.negation(a), bit(2), b), exprs.ite(a, b, bit(2)));
  EXPECT_NE(exprs.conjunction(a, b), exprs.disjunction(a, b));
}

TEST_F(ExprTest, ConstantsFold) {
  const ExprId a = bit(0);
  EXPECT_TRUE(exprs.is_false(exprs.conjunction(a, exprs.negation(a))));
  EXPECT_TRUE(exprs.is_true(exprs.disjunction(a, exprs.negation(a))));
  EXPECT_TRUE(exprs.is_true(exprs.less(exprs.word(1), exprs.word(2))));
  EXPECT_EQ(exprs.divide(exprs.word(-7), 2), exprs.word(-3));
  EXPECT_EQ(exprs.wrap16(exprs.word(32768)), exprs.word(-32768));
  EXPECT_EQ(exprs.to_bit(exprs.to_word(a)), a);
  EXPECT_EQ(exprs.negate(exprs.negate(word(0, 0, 5))), word(0, 0, 5));
}

TEST_F(ExprTest, BoundsDecideComparisons) {
  const ExprId x = word(0, 0, 10);
  const ExprId y = word(1, 10, 20);
  EXPECT_TRUE(exprs.is_true(exprs.less_equal(x, y)));
  EXPECT_FALSE(exprs.is_constant(exprs.less(x, y)));
  EXPECT_TRUE(exprs.is_false(exprs.equal(exprs.add(x, y), exprs.word(31))));
  const Expr& product = exprs[exprs.multiply(x, exprs.negate(y))];
  EXPECT_EQ(product.low, -200);
  EXPECT_EQ(product.high, 0);
}

TEST_F(ExprTest, ASaturatingSumStaysBelowItsCap) {
  const ExprId grown =
      exprs.minimum(exprs.add(word(0, 0, 50), word(1, 1, 100)), exprs.word(50));
  EXPECT_EQ(exprs[grown].low, 1);
  EXPECT_EQ(exprs[grown].high, 50);
}

TEST_F(ExprTest, BoundsBeyondWidthSaturate) {
  const ExprId large = exprs.word(std::int64_t{1} << 60);
  EXPECT_EQ(exprs[exprs.add(large, word(0, 0, std::int64_t{1} << 60))].high,
            ExprArena::kUnbounded);
}

}  // namespace
}  // namespace rung
