#include "reports/proof_words.h"

#include <gtest/gtest.h>

namespace rung {
namespace {

TEST(ProofWords, LemmasAreSentences) {
  EXPECT_EQ(in_words("!Q0"), "`Q0` is never true");
  EXPECT_EQ(in_words("Q0"), "`Q0` is always true");
  EXPECT_EQ(in_words("!Q0 || !Q1"), "`Q0` and `Q1` are never both true");
  EXPECT_EQ(in_words("!Q0 || !Q1 || !Q2"),
            "`Q0`, `Q1` and `Q2` are never all true");
  EXPECT_EQ(in_words("Q0 || I1"), "`Q0` or `I1` is true");
  EXPECT_EQ(in_words("!Q0 || (T(0).elapsed < 500)"),
            "while `Q0`: `T(0).elapsed < 500`");
  EXPECT_EQ(in_words("Q0 || !Q1 || Q2 || !Q3"),
            "while `Q1` and `Q3`: `Q0` or `Q2`");
  EXPECT_EQ(in_words("(Run == T(0).started)"),
            "`Run == T(0).started` is always true");
}

TEST(ProofWords, ParenthesesHoldTogether) {
  EXPECT_EQ(in_words("!(a || b) || c"), "while `a || b`: `c`");
  EXPECT_EQ(in_words("!(x >= 1) || (y >= 2)"), "while `x >= 1`: `y >= 2`");
  EXPECT_EQ(in_words("(a) && (b)"), "`(a) && (b)` is always true");
}

TEST(ProofWords, OddTextsAreQuoted) {
  EXPECT_EQ(in_words(""), "`` is always true");
  EXPECT_EQ(in_words(")("), "`)(` is always true");
  EXPECT_EQ(in_words("!"), "`` is never true");
}

}  // namespace
}  // namespace rung
