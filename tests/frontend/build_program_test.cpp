#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "dump.h"

namespace rung::test {
namespace {

// Program 1 of Sensors and Materials 32(12), 2020.
TEST(BuildProgram, StartStopOfTheYunPaper) {
  Built out;
  build(
      "//input Conf.\ny4 = pin4; y3 = pin5;\n//Rung\n"
      "y5 = (y5||y1)&&!y4;\n//Output\npin3 = y5;\n",
      "", out);
  EXPECT_TRUE(out.diagnostics.empty());
  EXPECT_EQ(out.program.dialect, "yun");
  EXPECT_EQ(out.program.language, "script");
  EXPECT_EQ(out.program.evaluation, Evaluation::Strict);
  EXPECT_EQ(dump_rungs(out.program),
            "y4 = pin4 | y3 = pin5 | y5 = y5 y1 || y4 ! && | pin3 = y5");
  EXPECT_EQ(dump_cells(out.program),
            "y4:memory pin4:in y3:memory pin5:in y5:memory y1:memory pin3:out");
}

// Section 3.2 of the paper on the simulator.
TEST(BuildProgram, TimersOfTheSimPaper) {
  Built out;
  build(
      "//Skrip utama\nQ1=(Q1||I1)&&!I0;\nQ2=T(0,5,Q1);\nQ3=TOF(3,10,Q2);\n"
      "Q4=TOF(4,1,Q3);\n",
      "", out);
  EXPECT_TRUE(out.diagnostics.empty());
  EXPECT_EQ(out.program.evaluation, Evaluation::ShortCircuit);
  EXPECT_EQ(dump_rungs(out.program),
            "Q1 = Q1 I1 || I0 ! && | Q2 = Q1 T:T(0)/5000 | "
            "Q3 = Q2 TOF:TOF(3)/10000 | Q4 = Q3 TOF:TOF(4)/1000");
}

// Section 3.3: two pumps and a tank. Two lines lack their semicolon.
TEST(BuildProgram, TankOfTheSimPaper) {
  Built out;
  build(
      "// Skrip utama padanan ladder\nQ0=((IW0<20)||Q0||I0)&&!(IW0>50);\n"
      "M1=C(0,2,Q0,false,M0);\nQ1=(M1||Q1)&&!M2\nM2=C(1,3,Q0&&Q1,false,M0);\n"
      "M3=(M2||M3)&&!M0\nM0=T(0,10,M3);\n//Sim\n"
      "//bila nilai counter tercapai, pompa berganti\nq=2*Q0;\nIW0=h\n"
      "//Simulasi plant\nqo=h*0.03;\nh=h+(q-qo);\n",
      "", out);
  EXPECT_TRUE(out.diagnostics.empty());
  EXPECT_EQ(dump_rungs(out.program),
            "Q0 = IW0 20 < Q0 || I0 || IW0 50 > ! && | "
            "M1 = Q0 false M0 C:C(0)/2 | Q1 = M1 Q1 || M2 ! && | "
            "M2 = Q0 Q1 && false M0 C:C(1)/3 | M3 = M2 M3 || M0 ! && | "
            "M0 = M3 T:T(0)/10000");
  EXPECT_EQ(dump_cells(out.program),
            "Q0:out IW0:in[-32768..32767]* I0:in M1:memory M0:memory Q1:out "
            "M2:memory M3:memory");
  ASSERT_EQ(out.program.plant.statements.size(), 4U);
  EXPECT_EQ(out.program.plant.statements[1].target, "IW0");
}

struct Row {
  std::string_view text;
  std::string_view expected;
};

void expect_rungs(const std::vector<Row>& table, std::string_view dialect) {
  for (const Row& row : table) {
    Built out;
    build(row.text, dialect, out);
    EXPECT_EQ(codes(out.read.sources, out.diagnostics, true), "") << row.text;
    EXPECT_EQ(dump_rungs(out.program), row.expected) << row.text;
  }
}

void expect_cells(const std::vector<Row>& table, std::string_view dialect) {
  for (const Row& row : table) {
    Built out;
    build(row.text, dialect, out);
    EXPECT_EQ(codes(out.read.sources, out.diagnostics, true), "") << row.text;
    EXPECT_EQ(dump_cells(out.program), row.expected) << row.text;
  }
}

void expect_codes(const std::vector<Row>& table, std::string_view dialect) {
  for (const Row& row : table) {
    Built out;
    build(row.text, dialect, out);
    EXPECT_EQ(codes(out.read.sources, out.diagnostics, true), row.expected)
        << row.text;
  }
}

TEST(BuildProgram, DirectionsAndTypesOfYunNames) {
  expect_cells(
      {
          {"pin0=pin13;", "pin0:out pin13:in"},
          {"pin0=pin1;pin1=pin0;", "pin0:out pin1:out"},
          {"y15=y0;", "y15:memory y0:memory"},
          {"y0=A0>A5;", "y0:memory A0:in[0..1023] A5:in[0..1023]"},
          {"y0=A0;", "y0:memory[-32768..32767] A0:in[0..1023]"},
          {"y0=1;y1=0;", "y0:memory y1:memory"},
          {"y0=2;", "y0:memory[-32768..32767]"},
          {"y0=-1;", "y0:memory[-32768..32767]"},
          {"y0=pin1+pin2;", "y0:memory[-32768..32767] pin1:in pin2:in"},
          // A copy passes the type on, also upwards and round a ring.
          {"y2=y1;y1=y0;y0=7;",
           "y2:memory[-32768..32767] y1:memory[-32768..32767] "
           "y0:memory[-32768..32767]"},
          {"y0=y1;y1=y0;", "y0:memory y1:memory"},
          {"y0=y1;y1=y0;y1=A0;",
           "y0:memory[-32768..32767] y1:memory[-32768..32767] A0:in[0..1023]"},
      },
      "yun");
}

TEST(BuildProgram, DirectionsAndTypesOfSimNames) {
  expect_cells(
      {
          {"Q8=I8;", "Q8:out I8:in"},
          {"Q0=Q1;", "Q0:out Q1:out"},
          {"Q0=M0;", "Q0:out M0:memory"},
          {"QW1=IW1;",
           "QW1:out[-2147483648..2147483647] "
           "IW1:in[-32768..32767]"},
          {"Q0=M0>3;", "Q0:out M0:memory"},
          {"M0=IW0;",
           "M0:memory[-2147483648..2147483647] "
           "IW0:in[-32768..32767]"},
          // Initial values.
          {"Q0=M0;\n//Var\nM0=true;", "Q0:out M0:memory=1"},
          {"Q0=M0;\n//Var\nM0=1;M0=0;M0=1", "Q0:out M0:memory=1"},
          {"Q0=M0>1;\n//Var\nM0=-2*3;",
           "Q0:out M0:memory[-2147483648..2147483647]=-6"},
          {"Q0=I0;\n//Var\nI0=true;Q0=true;unused=0.5", "Q0:out=1 I0:in=1"},
          {"Q0=IW0>1;\n//Var\nIW0=7;", "Q0:out IW0:in[-32768..32767]=7"},
          // What the plant writes is an input.
          {"Q0=M0;\n//Sim\nM0=Q0;", "Q0:out M0:in*"},
          {"Q0=M0;\n//Sim\nx=M0;", "Q0:out M0:memory"},
          {"Q0=I0;\n//Sim\nI0=true;", "Q0:out I0:in*"},
          {"Q0=Q1;\n//Sim\nQ1=true;", "Q0:out Q1:in*"},
          {"Q0=h>1;\n//Sim\nh=h+1;", "Q0:out h:in[-2147483648..2147483647]*"},
          {"Q0=h>1;\n//Sim\nh=x;x=2;", "Q0:out h:in[-2147483648..2147483647]*"},
          {"Q0=I0;\n//Sim\nI1=I2;x=1", "Q0:out I0:in"},
      },
      "sim");
}

TEST(BuildProgram, LowersYunExpressions) {
  expect_rungs(
      {
          {"y0=ORN(y0,y1,y2);", "y0 = y0 y1 || y2 ! &&"},
          {"y0=ORN(y1&&y2,!y3,ORN(y4,y5,y6));",
           "y0 = y1 y2 && y3 ! || y4 y5 || y6 ! && ! &&"},
          {"y0=ORN(1,A0,0);", "y0 = true A0 bit || false ! &&"},
          {"y0=Cmp(A0,\"<\",5);", "y0 = A0 5 <"},
          {"y0=Cmp(A0,\">\",A1+1);", "y0 = A0 A1 1 + >"},
          {"y0=Cmp(A0,\"=\",pin1);", "y0 = A0 pin1 word =="},
          {"y0=T(3,0.5,y1);", "y0 = y1 T:T(3)/500"},
          {"y0=T(3,0.0015,y1);", "y0 = y1 T:T(3)/1"},  // elapsed > p: down
          {"y0=TR(3,y1);", "y0 = y1 TR:T(3)/0"},
          {"y0=C(3,4,y1);", "y0 = y1 C:C(3)/4"},
          {"y0=Cnt(3,4,A0);", "y0 = A0 bit Cnt:C(3)/4"},
          {"y0=CR(3,1);", "y0 = true CR:C(3)/0"},
          // Strict: no branches.
          {"y0=y1&&T(0,1,y2)||y3;", "y0 = y1 y2 T:T(0)/1000 && y3 ||"},
          // 16-bit words wrap where they can overflow.
          {"y0=A0+1;", "y0 = A0 1 +"},
          {"y0=A0*32;", "y0 = A0 32 *"},
          {"y0=A0*33;", "y0 = A0 33 * wrap"},
          {"y0=y0+1;", "y0 = y0 1 + wrap"},
          {"y0=0-y0;y0=2;", "y0 = 0 y0 - wrap | y0 = 2"},
          {"y0=-y0;", "y0 = y0 neg wrap"},
          {"y0=-A0;", "y0 = A0 neg"},
          {"y0=A0/3;", "y0 = A0 3 /"},
          {"y0=y0/-1;", "y0 = y0 -1 / wrap"},
          // Constants fold; whole numbers divide as in C.
          {"y0=A0>7/2+1;", "y0 = A0 4 >"},
          {"y0=A0>-7/2;", "y0 = A0 -3 >"},
          {"y0=A0>-32768;", "y0 = A0 -32768 >"},
          {"y0=A0>0xFF;", "y0 = A0 255 >"},
          {"y0=T(0,60*2,y1);", "y0 = y1 T:T(0)/120000"},
          {"y0=T(0,0.25*2,y1);", "y0 = y1 T:T(0)/500"},
          // Bits and words.
          {"pin0=A0;", "pin0 = A0 bit"},
          {"pin0=2;", "pin0 = true"},
          {"pin0=A0||!A1;", "pin0 = A0 bit A1 bit ! ||"},
          {"y0=pin1+true;", "y0 = pin1 word 1 +"},
          {"y0=pin1==pin2;", "y0 = pin1 pin2 ^ !"},
          {"y0=pin1!=pin2;", "y0 = pin1 pin2 ^"},
          {"y0=pin1===pin2;", "y0 = pin1 pin2 ^ !"},
          {"y0=pin1==A0;", "y0 = pin1 word A0 =="},
          {"y0=pin1<pin2;", "y0 = pin1 word pin2 word <"},
          {"y0=A0;y0=pin1;", "y0 = A0 | y0 = pin1 word"},
      },
      "yun");
}

TEST(BuildProgram, LowersShortCircuits) {
  expect_rungs(
      {
          {"Q0=I0&&I1;", "Q0 = I0 I1 &&"},
          {"Q0=T(0,1,I0)&&I1;", "Q0 = I0 T:T(0)/1000 I1 &&"},
          {"Q0=I1&&T(0,1,I0);", "Q0 = I1 ?false+3 I0 T:T(0)/1000 &&"},
          {"Q0=I1||T(0,1,I0);", "Q0 = I1 ?true+3 I0 T:T(0)/1000 ||"},
          {"Q0=I1&&(I2||T(0,1,I0));",
           "Q0 = I1 ?false+6 I2 ?true+3 I0 T:T(0)/1000 || &&"},
          {"Q0=I1&&(I2||!C(0,1,I0,0,0)==I3);",
           "Q0 = I1 ?false+12 I2 ?true+9 I0 false false C:C(0)/1 ! I3 ^ ! || "
           "&&"},
          {"Q0=!IW0&&T(0,1,I0);", "Q0 = IW0 bit ! ?false+3 I0 T:T(0)/1000 &&"},
          {"Q0=!(IW0&&T(0,1,I0));",
           "Q0 = IW0 bit ?false+3 I0 T:T(0)/1000 && !"},
          {"Q0=false&&T(0,1,I0);", "Q0 = false ?false+3 I0 T:T(0)/1000 &&"},
          {"Q0=T(0,1,I1&&TOF(1,0,I0));",
           "Q0 = I1 ?false+3 I0 TOF:TOF(1)/0 && T:T(0)/1000"},
      },
      "sim");
}

TEST(BuildProgram, InstancesAreSharedByKindAndIndex) {
  Built out;
  build("Q0=T(1,2,I0);Q1=T(1,3.5,I1);Q2=TOF(1,1,I1);Q3=C(1,7,I0,I1,I2);", "",
        out);
  ASSERT_EQ(out.program.instances.size(), 3U);
  const Instance& timer = out.program.instances[InstanceId(0)];
  EXPECT_EQ(timer.name, "T(1)");
  EXPECT_EQ(timer.largest_parameter, 3500);
  EXPECT_EQ(timer.clock_cap, 3501);
  EXPECT_EQ(out.read.sources.text(timer.where), "T(1,2,I0)");
  EXPECT_EQ(out.program.instances[InstanceId(1)].name, "TOF(1)");
  EXPECT_EQ(out.program.instances[InstanceId(2)].name, "C(1)");
  const ElementCall& counter = out.program.calls[CallId(3)];
  EXPECT_EQ(counter.parameter, 7);
  EXPECT_EQ(counter.arguments.size(), 3U);
}

TEST(BuildProgram, RefusesNames) {
  expect_codes(
      {
          {"y16=y0;", "RP020[y16]"},
          {"y0=y16||y16;", "RP020[y16]"},  // once a name
          {"y0=y01;", "RP020[y01]"},
          {"y0=pin14;", "RP020[pin14]"},
          {"y0=A6>1;", "RP020[A6]"},
          {"y0=Pin3;", "RP020[Pin3]"},
          {"y0=M0;", "RP020[M0]"},
          {"A0=y0;", "RP021[A0]"},
          {"y0=T;", "RP022[T]"},
          {"ORN=y0;", "RP022[ORN]"},
          {"y0=Cmp;", "RP022[Cmp]"},
      },
      "yun");
  expect_codes(
      {
          {"I0=Q0;", "RP021[I0]"},
          {"IW1=3;", "RP021[IW1]"},
          {"TOF=Q0;", "RP022[TOF]"},
          {"Q0=C;", "RP022[C]"},
          {"M0=I0;\n//Sim\nM0=1", "RP023[M0]"},
          {"Q0=I0;\n//Sim\nQ0=1", "RP023[Q0]"},
          {"Q0=I9;", "RP035[I9]"},
          {"Q9=I0;", "RP035[Q9]"},
          {"Q0=IW2>1;", "RP035[IW2]"},
          {"q0=I0;", "RP035[q0]"},
          {"Q0=iw0;", "RP035[iw0]"},
          {"Q0=I01||Index||IQ||Q", ""},  // names like any other
      },
      "sim");
}

TEST(BuildProgram, RefusesCalls) {
  expect_codes(
      {
          {"y0=f(y1);", "RP024[f]"},
          {"y0=TOF(0,1,y1);", "RP024[TOF]"},
          {"y0=RISE(0,y1);", "RP024[RISE]"},
          {"y0=orn(y1,y2,y3);", "RP024[orn]"},
          {"y0=T();", "RP025[T()]"},
          {"y0=T(0,1);", "RP025[T(0,1)]"},
          {"y0=T(0,1,y1,y2);", "RP025[T(0,1,y1,y2)]"},
          {"y0=C(0,1,y1,y2,y3);", "RP025[C(0,1,y1,y2,y3)]"},
          {"y0=TR(y1);", "RP025[TR(y1)]"},
          {"y0=ORN(y1,y2);", "RP025[ORN(y1,y2)]"},
          {"y0=Cmp(A0,20);", "RP025[Cmp(A0,20)]"},
          {"y0=T(y1,1,y2);", "RP026[y1]"},
          {"y0=T(-1,1,y2);", "RP026[-1]"},
          {"y0=T(0.5,1,y2);", "RP026[0.5]"},
          {"y0=T(32768,1,y2);", "RP026[32768]"},
          {"y0=T(0+1,1,y2);", "RP026[0+1]"},
          {"y0=T(true,1,y2);", "RP026[true]"},
          {"y0=T(0,y1,y2);", "RP027[y1]"},
          {"y0=T(0,-1,y2);", "RP027[-1]"},
          {"y0=T(0,A0+1,y2);", "RP027[A0+1]"},
          {"y0=T(0,true,y2);", "RP027[true]"},
          {"y0=T(0,1099511628,y2);", "RP027[1099511628]"},
          {"y0=C(0,y1,y2);", "RP028[y1]"},
          {"y0=C(0,-1,y2);", "RP028[-1]"},
          {"y0=C(0,1.5,y2);", "RP028[1.5]"},
          {"y0=C(0,32768,y2);", "RP028[32768]"},
          {"y0=Cmp(A0,\">=\",5);", "RP033[\">=\"]"},
          {"y0=Cmp(A0,\"\",5);", "RP033[\"\"]"},
          {"y0=Cmp(A0,y1,5);", "RP034[y1]"},
          {"y0=Cmp(A0,3,5);", "RP034[3]"},
          {"y0=\"<\";", "RP034[\"<\"]"},
          {"y0=T(0,1,\"<\");", "RP034[\"<\"]"},
          {"y0=T(\"0\",1,y1);", "RP026[\"0\"]"},
          {"y0=Cmp(\"a\",\"<\",5);", "RP034[\"a\"]"},
      },
      "yun");
  expect_codes(
      {
          {"Q0=TR(0,I0);", "RP024[TR]"},
          {"Q0=Cmp(IW0,\"<\",5);", "RP024[Cmp]"},
          {"Q0=C(0,1,I0);", "RP025[C(0,1,I0)]"},
          {"Q0=T(2147483648,1,I0);", "RP026[2147483648]"},
          {"Q0=C(0,42949673,I0,I0,I0);", "RP028[42949673]"},
          {"Q0=T(0,1,IW0);", "RP029[IW0]"},
          {"Q0=T(0,1,I0+I1);", "RP029[I0+I1]"},
          {"Q0=T(0,1,2);", "RP029[2]"},
          {"Q0=I0==\"a\";", "RP034[\"a\"]"},
      },
      "sim");
}

// The operator of Cmp is unknown: its operands are evaluated all the same.
TEST(BuildProgram, UnknownComparisonIsFalse) {
  Built out;
  build("y0=Cmp(A0,\">=\",T(0,1,y1));", "yun", out);
  EXPECT_EQ(dump_rungs(out.program), "y0 = A0 y1 T:T(0)/1000 word < false &&");
  ASSERT_EQ(out.diagnostics.size(), 1U);
  EXPECT_EQ(out.diagnostics[0].severity, Severity::Warning);
}

TEST(BuildProgram, RefusesInitialValues) {
  expect_codes(
      {
          {"Q0=M0;\n//Var\nM0=x;", "RP037[M0=x]"},
          {"Q0=M0>1;\n//Var\nM0=0.5;", "RP037[M0=0.5]"},
          {"Q0=IW0>1;\n//Var\nIW0=40000;", "RP037[IW0=40000]"},
          {"Q0=I0;\n//Var\nI0=2;", "RP037[I0=2]"},
          {"Q0=M0>1;\n//Var\nM0=3000000000;", "RP037[M0=3000000000]"},
          {"Q0=M0;\n//Var\nM0=!true;", "RP037[M0=!true]"},
          {"Q0=M0>1;\n//Var\nM0=1/0;", "RP032[1/0] RP037[M0=1/0]"},
      },
      "sim");
}

TEST(BuildProgram, PlantVariablesKeepTheirExpressions) {
  Built out;
  build("Q0=I0;\n//Var\nh=0.5;q=h+1;\n//Sim\nh=h*q;if(h>1)h=0;\n", "", out);
  ASSERT_EQ(out.program.plant.initials.size(), 2U);
  EXPECT_EQ(out.program.plant.initials[1].target, "q");
  ASSERT_EQ(out.program.plant.statements.size(), 4U);
  const AstExpression& value = out.program.plant.statements[0].value;
  ASSERT_EQ(value.end - value.begin, 3U);
  EXPECT_EQ(out.program.plant.nodes[value.root()].op, AstOp::Multiply);
  EXPECT_EQ(out.program.plant.nodes[value.begin].text, "h");
  EXPECT_EQ(out.program.plant.nodes[value.begin + 1].text, "q");
}

TEST(BuildProgram, MessagesNameWhatTheyMean) {
  const std::vector<Row> table = {
      {"y0=Pin3;", "did you mean `pin3`?"},
      {"y0=TRR(0,y1);", "did you mean `TR`?"},
      {"y0=TOF(0,1,y1);", "is a function of the sim dialect"},
      {"y0=T(0,1);", "`T(n, d, v)`"},
      {"pin20=y0;", "y0..y15, pin0..pin13 and A0..A5"},
  };
  for (const Row& row : table) {
    Built out;
    build(row.text, "yun", out);
    ASSERT_EQ(out.diagnostics.size(), 1U) << row.text;
    EXPECT_NE(out.diagnostics[0].message.find(row.expected), std::string::npos)
        << out.diagnostics[0].message;
  }
}

TEST(BuildProgram, DepthCostsNoStack) {
  std::string text = "y0=";
  constexpr std::size_t kDeep = 100'000;
  for (std::size_t i = 0; i < kDeep; ++i) text += "ORN(!y1,y2,";
  text += "y3";
  text.append(kDeep, ')');
  Built out;
  build(text, "", out);
  EXPECT_EQ(codes(out.read.sources, out.diagnostics, true), "");
  EXPECT_EQ(out.program.nodes.size(), 6 * kDeep + 1);
}

TEST(BuildProgram, FindsCells) {
  Built out;
  build("Q0=I0;", "", out);
  EXPECT_EQ(find_cell(out.program, "I0"), CellId(1));
  EXPECT_FALSE(find_cell(out.program, "I1").has_value());
}

}  // namespace
}  // namespace rung::test
