#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "analysis/build_program_number.h"
#include "dump.h"

namespace rung::test {
namespace {

using build::Fraction;

struct Row {
  std::string_view text;
  std::string_view expected;
};

// Numbers of the sim dialect are doubles: words are whole, and fractions are
// compared exactly or refused.
TEST(SimWords, FractionsAreComparedExactly) {
  const std::vector<Row> table = {
      {"Q0=IW0<20;", "Q0 = IW0 20 <"},
      {"Q0=IW0<20.5;", "Q0 = IW0 2 * 41 <"},
      {"Q0=20.5>IW0;", "Q0 = 41 IW0 2 * >"},
      {"Q0=IW0<0.1;", "Q0 = IW0 10 * 1 <"},
      {"Q0=IW0>=-0.1;", "Q0 = IW0 10 * -1 >="},
      {"Q0=IW0*0.5<3;", "Q0 = IW0 1 * 6 <"},
      {"Q0=IW0*0.5+0.25==IW1;", "Q0 = IW0 1 * 2 * 1 + IW1 4 * =="},
      {"Q0=IW0/3<2;", "Q0 = IW0 6 <"},
      {"Q0=IW0/-3<2;", "Q0 = IW0 neg 6 <"},
      {"Q0=IW0/2/2!=IW1/4;", "Q0 = IW0 IW1 !="},
      {"Q0=IW0/2.5>1;", "Q0 = IW0 2 * 5 >"},
      {"Q0=-(IW0/3)<IW1/7;", "Q0 = IW0 neg 7 * IW1 3 * <"},
      {"Q0=IW0/10==0.3;", "Q0 = IW0 3 =="},
      {"Q0=6/3<IW0;", "Q0 = 2 IW0 <"},
      {"Q0=I0/2<1;", "Q0 = I0 word 2 <"},
      {"Q0=IW0+I0*2>3;", "Q0 = IW0 I0 word 2 * + 3 >"},
      {"M0=IW0*2+1;", "M0 = IW0 2 * 1 +"},
      {"M0=6/3;", "M0 = 2"},
      {"M0=0.5+1.5;", "M0 = 2"},
      {"Q0=T(0,0.1+0.2,I0);", "Q0 = I0 T:T(0)/300"},
      {"Q0=T(0,1/3,I0);", "Q0 = I0 T:T(0)/334"},  // elapsed >= p: up
      {"Q0=T(0,1.001,I0);", "Q0 = I0 T:T(0)/1001"},
      {"Q0=T(0,1e-3,I0);", "Q0 = I0 T:T(0)/1"},
  };
  for (const Row& row : table) {
    Built out;
    build(row.text, "sim", out);
    EXPECT_EQ(codes(out.read.sources, out.diagnostics, true), "") << row.text;
    EXPECT_EQ(dump_rungs(out.program), row.expected) << row.text;
  }
}

TEST(SimWords, RefusesWhatIsNotExact) {
  const std::vector<Row> table = {
      {"M0=IW0*0.5;", "RP030[IW0*0.5]"},
      {"M0=IW0/2;", "RP030[IW0/2]"},
      {"QW0=0.5;", "RP030[0.5]"},
      {"QW0=IW0+0.5;", "RP030[IW0+0.5]"},
      {"Q0=IW0*0.1<3;", "RP030[0.1]"},
      {"Q0=IW0+0.1<3;", "RP030[0.1]"},
      {"Q0=IW0/3+1<3;", "RP030[IW0/3]"},
      {"Q0=IW0/3/3<3;", "RP030[IW0/3]"},
      {"Q0=IW0/0.1<3;", "RP030[0.1]"},
      {"Q0=IW0<0.1+0.2;", "RP030[0.1+0.2]"},
      {"Q0=IW0<1/3*3;", "RP030[1/3*3]"},
      {"Q0=IW0<0.123456789012345;", "RP030[IW0<0.123456789012345]"},
      {"Q0=IW0/1000000007<0.1234567;", "RP030[IW0/1000000007<0.1234567]"},
      {"Q0=IW0<1e400;", "RP031[1e400]"},
      {"Q0=IW0<1e-400;", "RP031[1e-400]"},
      {"Q0=IW0<12345678901234567890;", "RP031[12345678901234567890]"},
      {"Q0=IW0<1e18*1e18;", "RP031[1e18*1e18]"},
      {"Q0=IW0<9007199254740993;", "RP030[IW0<9007199254740993]"},
      {"Q0=IW0/IW1<3;", "RP032[IW1]"},
      {"Q0=3/IW1<3;", "RP032[IW1]"},
      {"Q0=IW0/0<3;", "RP032[IW0/0]"},
      {"Q0=IW0/(1-1)<3;", "RP032[IW0/(1-1)]"},
      {"Q0=IW0/false<3;", "RP032[IW0/false]"},
      {"M0=IW0;M1=M0*M0>1;", "RP038[M0*M0]"},
  };
  for (const Row& row : table) {
    Built out;
    build(row.text, "sim", out);
    EXPECT_EQ(codes(out.read.sources, out.diagnostics, true), row.expected)
        << row.text;
  }
}

// `a && b` is an operand in Javascript: a number would be passed on.
TEST(SimWords, RefusesNumbersAsBits) {
  const std::vector<Row> table = {
      {"Q0=IW0;", "RP029[IW0]"},
      {"Q0=2;", "RP029[2]"},
      {"Q0=I0+1;", "RP029[I0+1]"},
      {"Q0=IW0&&I0;", "RP029[IW0]"},
      {"Q0=I0||IW0;", "RP029[IW0]"},
      {"M0=I0||0.5;", "RP029[0.5]"},
      {"Q0=(I0||IW0)==true;", "RP029[IW0]"},
      {"Q0=(I0||IW0)>2;", "RP029[IW0]"},
  };
  for (const Row& row : table) {
    Built out;
    build(row.text, "sim", out);
    EXPECT_EQ(codes(out.read.sources, out.diagnostics, true), row.expected)
        << row.text;
  }
}

TEST(SimWords, NumbersServeAsTruthValues) {
  const std::vector<Row> table = {
      {"Q0=!IW0;", "Q0 = IW0 bit !"},
      {"Q0=!(I0||IW0&&I1);", "Q0 = I0 IW0 bit I1 && || !"},
      {"Q0=!(IW0/3);", "Q0 = IW0 bit !"},
      {"Q0=I0&&1;", "Q0 = I0 true &&"},
      {"Q0=1;", "Q0 = true"},
      {"Q0=T(0,1,0);", "Q0 = false T:T(0)/1000"},
      {"Q0=I0*I1;", "Q0 = I0 word I1 word * bit"},
      {"Q0=I0==1;", "Q0 = I0 word 1 =="},
      {"Q0=IW0==true;", "Q0 = IW0 1 =="},
  };
  for (const Row& row : table) {
    Built out;
    build(row.text, "sim", out);
    EXPECT_EQ(codes(out.read.sources, out.diagnostics, true), "") << row.text;
    EXPECT_EQ(dump_rungs(out.program), row.expected) << row.text;
  }
}

// `===` tells true from 1; bits and numbers are one here, where nothing else
// could tell.
TEST(SimWords, StrictEqualityNeedsOneTypeThroughout) {
  const std::vector<Row> table = {
      {"Q0=I0===I1;", ""},
      {"Q0=IW0!==3;", ""},
      {"Q0=I0===1;", "RP036[I0===1]"},
      {"Q0=IW0!==true;", "RP036[IW0!==true]"},
      {"Q0=M0===I0;M0=1;", "RP036[M0===I0]"},
      {"Q0=M0===I0;M0=I1&&1;", "RP036[M0===I0]"},
      {"Q0=M0===1;M0=IW0;M0=I0;", "RP036[M0===1]"},
      {"Q0=M0===I0;\n//Var\nM0=0", "RP036[M0===I0]"},
      {"Q0=M0===I0;\n//Var\nM0=false", ""},
      {"Q0=I0===I1;\n//Sim\nI0=1", "RP036[I0===I1]"},
      {"Q0=I0===I1;\n//Sim\nI0=x", "RP036[I0===I1]"},
      {"Q0=I0===I1;\n//Sim\nI0=x>1", ""},
      {"Q0=IW0===1;\n//Sim\nIW0=x>1", "RP036[IW0===1]"},
      {"Q0=IW0===1;\n//Sim\nIW0=x+1", ""},
  };
  for (const Row& row : table) {
    Built out;
    build(row.text, "sim", out);
    EXPECT_EQ(codes(out.read.sources, out.diagnostics, true), row.expected)
        << row.text;
  }
}

TEST(YunWords, RefusesWhatTheControllerCannotCompute) {
  const std::vector<Row> table = {
      {"y0=0.5;", "RP030[0.5]"},
      {"y0=A0<20.5;", "RP030[20.5]"},
      {"y0=A0*0.5;", "RP030[0.5]"},
      {"pin0=0.5;", "RP030[0.5]"},
      {"y0=A0<40000;", "RP031[40000]"},
      {"y0=A0<300*300;", "RP031[300*300]"},
      {"y0=A0<-32769;", "RP031[-32769]"},
      {"y0=A0-32768;", "RP031[32768]"},  // the literal, as in C
      {"y0=T(0,1000*60,y1);", "RP031[1000*60]"},
      {"y0=A0/A1;", "RP032[A1]"},
      {"y0=A0/0;", "RP032[A0/0]"},
      {"y0=A0/(2-2);", "RP032[A0/(2-2)]"},
  };
  for (const Row& row : table) {
    Built out;
    build(row.text, "yun", out);
    EXPECT_EQ(codes(out.read.sources, out.diagnostics, true), row.expected)
        << row.text;
  }
}

TEST(Fractions, ParsesNumbers) {
  struct Parsed {
    std::string_view text;
    std::int64_t numerator, denominator;
  };
  const std::vector<Parsed> table = {
      {"0", 0, 1},
      {"0e999999999999999999999", 0, 1},
      {"20", 20, 1},
      {"0.50", 1, 2},
      {".5", 1, 2},
      {"5.", 5, 1},
      {"1.05", 21, 20},
      {"2.5e1", 25, 1},
      {"100e-2", 1, 1},
      {"1000000000000000000000e-21", 1, 1},
      {"0.000000000000000000001e21", 1, 1},
      {"0x1F", 31, 1},
      {"0XfF", 255, 1},
  };
  for (const Parsed& row : table) {
    const auto value = build::parse_number(row.text);
    ASSERT_TRUE(value.has_value()) << row.text;
    EXPECT_EQ(value->numerator, row.numerator) << row.text;
    EXPECT_EQ(value->denominator, row.denominator) << row.text;
  }
  for (const std::string_view text :
       {"1e19", "1e-19", "1e99999999999999999999", "1234567890123456789012",
        "0x10000000000000000", "0.1234567890123456789", "1e-999999999999999"}) {
    EXPECT_FALSE(build::parse_number(text).has_value()) << text;
  }
}

TEST(Fractions, RoundBothWays) {
  EXPECT_EQ(build::floor_of(Fraction{7, 2}), 3);
  EXPECT_EQ(build::ceiling_of(Fraction{7, 2}), 4);
  EXPECT_EQ(build::floor_of(Fraction{-7, 2}), -4);
  EXPECT_EQ(build::ceiling_of(Fraction{-7, 2}), -3);
  EXPECT_EQ(build::floor_of(Fraction{6, 1}), 6);
  EXPECT_EQ(build::ceiling_of(Fraction{6, 1}), 6);
}

/// The value of a rung without calls, over integers, as the nodes say.
std::int64_t evaluate(const Program& program, const Rung& rung,
                      std::int64_t input) {
  std::vector<std::int64_t> value(program.nodes.size());
  for (std::uint32_t i = rung.begin; i < rung.end; ++i) {
    const Node& node = program.nodes[i];
    const std::int64_t a = value[node.a];
    const std::int64_t b = value[node.b];
    switch (node.op) {
      case NodeOp::Constant:
        value[i] = node.value;
        break;
      case NodeOp::Read:
        value[i] = input;
        break;
      case NodeOp::Less:
        value[i] = a < b ? 1 : 0;
        break;
      case NodeOp::LessEqual:
        value[i] = a <= b ? 1 : 0;
        break;
      case NodeOp::Equal:
        value[i] = a == b ? 1 : 0;
        break;
      case NodeOp::Add:
        value[i] = a + b;
        break;
      case NodeOp::Multiply:
        value[i] = a * b;
        break;
      case NodeOp::Negate:
        value[i] = -a;
        break;
      default:
        ADD_FAILURE() << "not expected here";
        return -1;
    }
  }
  return value[rung.root()];
}

// The rewriting over integers against doubles as a browser computes them.
TEST(SimWords, IntegersDecideAsDoublesDo) {
  const std::vector<double> divisors = {3, -7, 10, 0.5, 2.5, 1000};
  const std::vector<std::string> limits = {"0.3", "2",   "-0.7", "1.5",
                                           "0.1", "0.7", "33.3", "2.004"};
  for (const double divisor : divisors) {
    for (const std::string& limit : limits) {
      std::string by = std::to_string(divisor);
      by.erase(by.find_last_not_of('0') + 1);
      Built out;
      build("Q0=IW0/" + by + "<" + limit + ";Q1=IW0/" + by + "==" + limit +
                ";Q2=IW0*0.75+0.5<=" + limit + ";",
            "sim", out);
      ASSERT_EQ(codes(out.read.sources, out.diagnostics, true), "");
      const double bound = std::stod(limit);
      for (int input = -3000; input <= 3000; ++input) {
        const std::vector<bool> expected = {input / divisor < bound,
                                            input / divisor == bound,
                                            input * 0.75 + 0.5 <= bound};
        for (std::uint32_t i = 0; i < 3; ++i) {
          ASSERT_EQ(evaluate(out.program, out.program.rungs[RungId(i)], input),
                    expected[i] ? 1 : 0)
              << input << " / " << by << " against " << limit;
        }
      }
    }
  }
}

}  // namespace
}  // namespace rung::test
