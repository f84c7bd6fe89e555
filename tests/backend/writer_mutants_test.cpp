// Mistakes of a writer, one at a time: the validation must notice each.

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "lowering.h"

namespace rung {
namespace {

constexpr const char* kSim =
    "Q0 = (I0 || Q0) && !I1;\n"
    "Q1 = T(0, 0.2, Q0 && I2);\n"
    "Q2 = TOF(0, 0.5, I3) && (I4 || !I5);\n"
    "Q3 = C(0, 3, I2, false, I1);\n"
    "Q4 = I0 && T(1, 1, I6) || I7 && I1;\n"
    "Q5 = IW0 > 20 && (IW0 < 50 || Q5);\n";
constexpr const char* kYun =
    "y0 = T(0, 0.2, pin2) || TR(0, pin3);\n"
    "y1 = C(0, 3, pin4);\n"
    "y2 = CR(0, pin5) || y1 != y0;\n";
constexpr const char* kBits =
    "Q0 = (I0 || Q0) && !I1;\n"
    "Q3 = Q1 && (I4 || I5 && !I6) || Q0 && I2;\n"
    "Q1 = !I3;\n";
constexpr const char* kPoints =
    "//@ input IW0 in 0..90\n"
    "Q3 = C(0, 3, I2, false, I1);\n"
    "Q4 = I1 && (I3 || Q3);\n"
    "Q5 = IW0 > 20 && (IW0 < 50 || Q5);\n";
constexpr const char* kTimers =
    "Q1 = T(0, 0.2, I0 && !I2);\n"
    "Q2 = TOF(1, 0.3, I3);\n";
constexpr const char* kKept =
    "Q0 = Q0 || I0 && !I1;\nQ1 = Q1 && !I1;\nQ1 = Q1 || Q0 && I2;\n";
constexpr const char* kFixed =
    "//@ scan 10 ms\n"
    "Q0 = (I0 || Q0) && !I1;\n"
    "Q1 = T(0, 0.2, Q0 && I2);\n"
    "Q2 = TOF(0, 0.5, I3) && (I4 || !I5);\n"
    "Q3 = C(0, 3, I2, false, I1);\n"
    "Q4 = Q4 || I0 && I3;\n";
constexpr const char* kFixedYun =
    "//@ scan 10 ms\n"
    "y0 = T(0, 0.2, pin2) || TR(0, pin3);\n"
    "y1 = C(0, 3, pin4);\n"
    "y2 = CR(0, pin5) || y1 != y0;\n";
constexpr const char* kEdges =
    "postfix 1\ndialect sim\nevaluation strict\nscan 1..100 ms\n"
    "input bit a\noutput bit q\noutput bit r\nelement E(0) edge\n"
    "element E(1) edge\nrungs\na RISE(0) =q\na FALL(1) =r\n";

/// In what was written of `source`, the first `from` becomes `to`.
struct Mistake {
  const char* language;
  const char* source;
  const char* from;
  const char* to;
};
std::ostream& operator<<(std::ostream& out, const Mistake& mistake) {
  return out << mistake.language << ": " << mistake.from << " -> "
             << mistake.to;
}

const Mistake kMistakes[] = {
    // An N, a parenthesis, an operator.
    {"il-iec", kSim, "ANDN I1", "AND I1"},
    {"il-iec", kSim, "ORN  I5", "OR   I5"},
    {"il-iec", kSim, "  AND(\n  LD   I4\n  ORN  I5\n  )\n",
     "  AND  I4\n  ORN  I5\n"},
    {"il-iec", kSim, "GT   20", "GE   20"},
    {"il-iec", kYun, "XOR  y0", "OR   y0"},
    // Two rungs that change places; one that is lost.
    {"il-iec", kSim, "  ST   Q0\n\n  LD   Q0\n  AND  I2\n  ST   T_0.IN\n",
     "  ST   T_0.IN\n\n  LD   Q0\n  AND  I2\n  ST   Q0\n"},
    {"il-iec", kYun,
     "  CAL  T_0(IN := T_0_started, PT := T#201ms)\n  LD   pin2",
     "  LD   pin2"},
    // A preset, a count, a limit, the first value.
    {"il-iec", kSim, "PT := T#200ms", "PT := T#201ms"},
    {"il-iec", kYun, "PT := T#201ms", "PT := T#200ms"},
    {"il-iec", kSim, "PT := T#500ms", "PT := T#499ms"},
    {"il-iec", kSim, "EQ   3", "GE   3"},
    {"il-iec", kYun, "PV := 3", "PV := 4"},
    {"il-iec", kSim, "Q0 : BOOL", "Q0 : BOOL := TRUE"},
    // A condition, an edge, the wrong block.
    {"il-iec", kSim, "JMPCN skip_1", "JMPC  skip_1"},
    {"il-iec", kSim, "TOF_0 : TOF", "TOF_0 : TON"},
    {"il-iec", kEdges, "E_0 : R_TRIG", "E_0 : F_TRIG"},
    {"il-iec", kYun, "R := pin5", "CU := pin5"},
    {"il-iec", kYun, "R := FALSE, ", ""},
    {"il-iec", kEdges, "ST   E_1_last", "STN  E_1_last"},
    // Of a script.
    {"script", kSim, "!I1", "I1"},
    {"script", kSim, "(I4 || !I5)", "I4 || !I5"},
    {"script", kSim, "T(0, 0.2", "T(0, 0.201"},
    {"script", kSim, "T(1, 1,", "T(0, 1,"},
    {"script", kSim, "false, I1", "I1, false"},
    {"script", kYun, "TR(0, pin3)", "TR(1, pin3)"},
    {"script", kYun, "C(0, 3", "C(0, 4"},
    {"script", kEdges, "E_0_last = a;", "E_0_last = !a;"},
    // A list of the FX family.
    {"il-mitsubishi", kBits, "ANI  X1", "AND  X1"},
    {"il-mitsubishi", kBits, "ORB\n", "ANB\n"},
    {"il-mitsubishi", kBits, "LDI  X3\n", "LD   X3\n"},
    {"il-mitsubishi", kBits, "OR   Y0\n", ""},
    {"il-mitsubishi", kTimers, "T0 K2", "T0 K3"},
    {"il-mitsubishi", kTimers, "OUT  T1", "OUT  T2"},
    // Structured text.
    {"st", kTimers, "T#200ms", "T#201ms"},
    {"st", kTimers, "TOF_1 : TOF", "TOF_1 : TON"},
    {"st", kBits, "NOT I1", "I1"},
    {"st", kBits, "OR", "AND"},
    {"st", kBits, "Q0 : BOOL", "Q0 : BOOL := TRUE"},
    // A ladder diagram.
    {"plcopen", kBits, "negated=\"true\"", "negated=\"false\""},
    {"plcopen", kBits, "<variable>I6<", "<variable>I5<"},
    {"plcopen", kBits,
     "                <connection refLocalId=\"3\">\n"
     "                  <position x=\"250\" y=\"40\" />\n"
     "                  <position x=\"230\" y=\"40\" />\n"
     "                  <position x=\"230\" y=\"80\" />\n"
     "                  <position x=\"150\" y=\"80\" />\n"
     "                </connection>\n",
     ""},
    {"plcopen", kBits, "refLocalId=\"8\"", "refLocalId=\"7\""},
    {"plcopen", kTimers, "T#200ms", "T#201ms"},
    {"plcopen", kSim, "typeName=\"EQ\"", "typeName=\"GE\""},
    {"plcopen", kSim, "typeName=\"ADD\"", "typeName=\"SUB\""},
    {"plcopen", kSim, "<expression>50<", "<expression>51<"},
    {"plcopen", kYun, "<expression>FALSE<", "<expression>TRUE<"},
    {"plcopen", kYun, "<expression>3<", "<expression>4<"},
    {"plcopen", kYun, "T#201ms", "T#200ms"},
    {"plcopen", kKept, "storage=\"reset\"", "storage=\"set\""},
    {"plcopen", kKept, " storage=\"set\"", ""},
    // A contact that is no longer before a box, and one at another rail.
    {"plcopen", kSim, "<variable>Q5_1<", "<variable>Q5_2<"},
    {"plcopen", kEdges, "<variable>E_1_last<", "<variable>a<"},
    // LDmicro.
    {"ldmicro", kFixed, "CYCLE=10000", "CYCLE=20000"},
    {"ldmicro", kFixed, "RXI1 1", "RXI1 0"},
    {"ldmicro", kFixed, "        CONTACTS YQ0 0\n", ""},
    {"ldmicro", kFixed, "TON T_0 200000 0", "TON T_0 210000 0"},
    {"ldmicro", kFixed, "TON T_0 200000 0", "TON T_0 200000 -1"},
    {"ldmicro", kFixed, "TOF TOF_0", "TON TOF_0"},
    {"ldmicro", kFixed, "EQU NC_0_value 3", "GEQ NC_0_value 3"},
    {"ldmicro", kFixed, "ADD NC_0_value NC_0_value 1",
     "ADD NC_0_value NC_0_value 2"},
    {"ldmicro", kFixed, "COIL YQ4 0 1 0", "COIL YQ4 0 0 0"},
    {"ldmicro", kFixed, "PARALLEL\n        CONTACTS XI4 0\n        CONTACTS",
     "PARALLEL\n        CONTACTS YQ0 0\n        CONTACTS"},
    {"ldmicro", kFixedYun, "TON T_0 210000", "TON T_0 200000"},
    {"ldmicro", kFixedYun, "CTU C_0 3", "CTU C_0 4"},
    {"ldmicro", kFixedYun, "RES T_0", "RES C_0"},
    {"ldmicro", kFixedYun, "COIL RT_0_started 0 1 0",
     "COIL RT_0_started 0 0 0"},
    {"ldmicro", kEdges, "COIL RE_1_last 0 0 0", "COIL RE_1_last 1 0 0"},
    // A drawing.
    {"ascii", kBits, "[/]", "[ ]"},
    {"ascii", kBits, "I6", "I5"},
    {"ascii", kBits, "Q0      I2", "I3      I2"},
    {"ascii", kTimers, "200ms", "201ms"},
    {"ascii", kTimers, "| TOF |", "| TON |"},
    // A sketch.
    {"plclib", kBits, "andNotBit(I1)", "andBit(I1)"},
    {"plclib", kBits, "  inNot(I3)", "  in(I3)"},
    {"plclib", kBits, "  orBit(Q0);\n", ""},
    {"plclib", kBits, "stack.orBlock()", "stack.andBlock()"},
    {"plclib", kBits, "stack.push();\n  in(", "stack.push();\n  inNot("},
    {"plclib", kTimers, "(T_0, 200)", "(T_0, 201)"},
    {"plclib", kTimers, "timerOn(T_0", "timerOff(T_0"},
    {"plclib", kTimers, "timerOn(TOF_1", "timerOn(T_0"},
    {"plclib", kTimers, "in(TOF_1_out)", "inNot(TOF_1_out)"},
    {"plclib", kPoints, "in(I2_now)", "in(I1_now)"},
    {"plclib", kPoints, "  andBit(I1_now)", "  andBit(I2_now)"},
    {"plclib", kPoints, "value == 3", "value >= 3"},
    {"plclib", kPoints, "value = 0;\n  }", "value = 1;\n  }"},
    {"plclib", kPoints, "IW0_now > 20", "IW0_now >= 20"},
    {"plclib", kYun, "(T_0, 201)", "(T_0, 200)"},
    {"plclib", kEdges, "out(E_1_last)", "out(E_0_last)"},
};

class WriterMutants : public testing::TestWithParam<Mistake> {};

TEST_P(WriterMutants, AreNoticed) {
  const Mistake& mistake = GetParam();
  const bool script = mistake.source != kEdges;
  const auto source =
      read_program(script ? "script" : "postfix", "", mistake.source);
  ASSERT_EQ(source->error, "");
  for (const WrittenLanguage& language : written_languages()) {
    if (language.name != mistake.language) continue;
    Lowered lowered = lower(language, *source);
    ASSERT_TRUE(lowered.written) << lowered.refused;
    ASSERT_EQ(validate(language, *source, *lowered.written), "");
    std::string& text = lowered.written->text;
    const std::size_t at = text.find(mistake.from);
    ASSERT_NE(at, std::string::npos) << text;
    text.replace(at, std::string(mistake.from).size(), mistake.to);
    const std::string found = validate(language, *source, *lowered.written, 3);
    EXPECT_EQ(found.substr(0, 11), "different: ") << found << "\n" << text;
    return;
  }
  FAIL() << "no such language";
}

INSTANTIATE_TEST_SUITE_P(Mistakes, WriterMutants, testing::ValuesIn(kMistakes));

}  // namespace
}  // namespace rung
