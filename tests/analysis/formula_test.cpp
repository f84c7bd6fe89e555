#include "analysis/formula.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace rung {
namespace {

/// Postfix text of a formula, to compare shapes.
std::string postfix(std::string_view text) {
  const Formula formula = parse_formula(text);
  if (!formula.has_value()) return "error: " + formula.error;
  std::string out;
  for (const FormulaNode& node : formula.nodes) {
    if (!out.empty()) out += ' ';
    if (node.op == FormulaOp::Name) {
      out += node.text;
    } else if (node.op == FormulaOp::Number || node.op == FormulaOp::Bool) {
      out += std::to_string(node.number);
    } else {
      static const char* const kSigns[] = {
          "",  "",   "",   "!", "~",  "&", "|",  "^", "->", "<->",
          "?", "==", "!=", "<", "<=", ">", ">=", "+", "-",  "*"};
      out += node.op == FormulaOp::Call ? std::string(node.text) + "()"
                                        : kSigns[static_cast<int>(node.op)];
    }
  }
  return out;
}

struct Case {
  std::string_view text;
  std::string_view expected;
};

TEST(Formula, OperatorsBindAsDocumented) {
  const std::vector<Case> cases = {
      {"a", "a"},
      {"a || b && c", "a b c & |"},
      {"!a && b", "a ! b &"},
      {"NOT a AND b", "a ! b &"},
      {"a OR b XOR c AND d", "a b c d & ^ |"},
      {"a -> b -> c", "a b c -> ->"},
      {"a <-> b -> c", "a b c -> <->"},
      {"a < 3 == b", "a 3 < b =="},
      {"x + 1 >= y - 2 * 3", "x 1 + y 2 3 * - >="},
      {"x - 1 - 2", "x 1 - 2 -"},
      {"-x < -3", "x ~ 3 ~ <"},
      {"a<-1", "a 1 ~ <"},
      {"a ? b : c ? d : e", "a b c d e ? ?"},
      {"a ? b ? c : d : e", "a b c d ? e ?"},
      {"a || b ? 0 : x + 1", "a b | 0 x 1 + ?"},
      {"prev(prev(a)) && once(b)", "a prev() prev() b once() &"},
      {"T(0).q -> T(12).elapsed > 500 ms", "T(0).q T(12).elapsed 500 > ->"},
      {"x > 1.5 s", "x 1500 >"},
      {"value' == p", "value' p =="},
      {"f(a, b + 1)", "a b 1 + f()"},
  };
  for (const Case& item : cases) {
    EXPECT_EQ(postfix(item.text), item.expected) << item.text;
  }
}

TEST(Formula, RefusesWhatIsNoFormula) {
  const std::vector<Case> cases = {
      {"", "error: a formula is missing"},
      {"a b", "error: an operator is missing before `b`"},
      {"a &&", "error: the formula ends too early"},
      {"&& a", "error: a name or a number is missing before `&&`"},
      {"(a", "error: `(` without `)`"},
      {"a)", "error: `)` without `(`"},
      {"a ? b", "error: `?` without `:`"},
      {"(a ? b)", "error: `)` without `(`"},
      {"a : b", "error: `:` without `?`"},
      {"a, b", "error: `,` outside of a call"},
      {"f()", "error: a name or a number is missing before `)`"},
      {"a # b", "error: an operator is missing before `#`"},
      {"# a", "error: `#` is not understood"},
      {"x > 1.5", "error: `1.5` is not understood"},
      {"x > 1.0005 s", "error: `1.0005 s` is not understood"},
      {"x > 12abc", "error: `12` is not understood"},
      {"x > 1234567890123456", "error: `1234567890123456` is not understood"},
  };
  for (const Case& item : cases) {
    EXPECT_EQ(postfix(item.text), item.expected) << item.text;
  }
}

TEST(Formula, DepthCostsNoStack) {
  constexpr std::size_t kDepth = 300'000;
  const std::string deep =
      std::string(kDepth, '(') + "a" + std::string(kDepth, ')');
  EXPECT_EQ(parse_formula(deep).nodes.size(), 1U);
  EXPECT_EQ(parse_formula(std::string(kDepth, '!') + "a").nodes.size(),
            kDepth + 1);
}

}  // namespace
}  // namespace rung
