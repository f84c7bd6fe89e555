#include <gtest/gtest.h>

#include "dump.h"

namespace rung::test {
namespace {

TEST(ScriptReader, Precedence) {
  Read out;
  read("Q0 = !I0 || I1 && IW0 < 2 + 3 * -4 == true;", "sim", out);
  ASSERT_TRUE(out.diagnostics.empty());
  ASSERT_EQ(out.ast.rungs.size(), 1U);
  EXPECT_EQ(dump(out.ast, out.ast.rungs[0].value),
            "(|| (! I0) (&& I1 (== (< IW0 (+ 2 (* 3 (- 4)))) true)))");
}

}  // namespace
}  // namespace rung::test
