// Sketches for plcLib: what a compiler says of them, and what their text is.

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "lowering.h"

namespace rung {
namespace {

const WrittenLanguage& plclib() {
  for (const WrittenLanguage& language : written_languages()) {
    if (language.name == "plclib") return language;
  }
  std::abort();
}

std::string sketch(const std::string& text,
                   const std::string& from = "script") {
  const auto source = read_program(from, "", text, "test.rung");
  EXPECT_EQ(source->error, "");
  const Lowered lowered = lower(plclib(), *source);
  if (!lowered.written) return lowered.refused;
  EXPECT_EQ(validate(plclib(), *source, *lowered.written), "")
      << lowered.written->text;
  return lowered.written->text;
}

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

/// Everything that a sketch may have: words, edges, latches, IEC's counters.
constexpr const char* kList =
    "PROGRAM p\nVAR_INPUT a, b, d : BOOL; END_VAR\n"
    "VAR_OUTPUT q, m, int, PB0, B01, index : BOOL; END_VAR\n"
    "VAR t : TON; p1 : TP; f : TOF; c : CTU; g : CTD; u : CTUD;\n"
    "e : R_TRIG; n : F_TRIG; l : SR; r : RS; v : INT; w : INT := 7; END_VAR\n"
    "  LD a\n  JMPCN over\n  CAL t(IN := b, PT := T#3s)\n"
    "over: CAL c(CU := b, R := a, PV := 7)\n  LD c.CV\n  GT 5\n  ST q\n"
    "  CAL e(CLK := q)\n  LD e.Q\n  S m\n  LD t.Q\n  R m\n"
    "  CAL g(CD := b, LD := a, PV := 5)\n  LD g.Q\n  ST int\n"
    "  CAL u(CU := b, CD := d, R := a, LD := int, PV := 9)\n  LD u.QD\n"
    "  ST PB0\n  CAL p1(IN := d, PT := T#50ms)\n  LD p1.Q\n  ST B01\n"
    "  CAL f(IN := d, PT := T#70ms)\n  CAL n(CLK := f.Q)\n"
    "  CAL l(S1 := a, R := m)\n  CAL r(S := l.Q1, R1 := n.Q)\n  LD r.Q1\n"
    "  ST index\nEND_PROGRAM\n";

TEST(WritingSketches, ACompilerTakesThem) {
  // Each in a namespace of its own, so that one run of the compiler does.
  const std::filesystem::path path =
      std::filesystem::path(testing::TempDir()) / "rungproof_sketches.cpp";
  std::ofstream out(path);
  std::size_t count = 0;
  const auto add = [&](const std::string& text) {
    out << "namespace sketch_" << ++count << " {\n" << text << "}\n";
  };
  out << "#include <plcLib.h>\n";
  add(sketch(kList, "il-iec"));
  for (const auto& [name, text] : corpus()) {
    const auto source = read_program("script", "", text, name);
    const Lowered lowered = lower(plclib(), *source);
    if (lowered.written) add(lowered.written->text);
  }
  out.close();
  EXPECT_GT(count, 40U);
  const std::string command =
      std::string(RUNG_CXX) + " -std=c++11 -fsyntax-only -Wall -Wextra " +
      "-Werror -I " RUNG_SOURCE_DIR "/tests/backend/sketch " + path.string();
  EXPECT_EQ(std::system(command.c_str()), 0) << command;
}

TEST(WritingSketches, NamesOfCppAndOfTheBoardAreTaken) {
  const std::string text = sketch(kList, "il-iec");
  EXPECT_TRUE(contains(text, "const int int_1 = 7;  // int\n")) << text;
  EXPECT_TRUE(contains(text, "const int PB0_1 = ")) << text;
  EXPECT_TRUE(contains(text, "const int B01_1 = ")) << text;
  EXPECT_TRUE(contains(text, "const int index_1 = ")) << text;
  const std::string names = sketch(
      "//@ output set\n//@ output I2C\n"
      "set = I0; I2C = set; A = I1; PI = A;\n");
  EXPECT_TRUE(contains(names, "const int set_1 = 4;  // set\n")) << names;
  EXPECT_TRUE(contains(names, "const int I2C = ")) << names;
  EXPECT_TRUE(contains(names, "unsigned int A = 0;\n")) << names;
  EXPECT_TRUE(contains(names, "unsigned int PI_1 = 0;  // PI\n")) << names;
}

TEST(WritingSketches, WhatIsReadOnceIsReadThere) {
  const std::string text = sketch("Q0 = I0 && I1; Q1 = I1;\n");
  EXPECT_TRUE(contains(text,
                       "  I1_now = digitalRead(I1);\n\n  in(I0);\n"
                       "  andBit(I1_now);\n  out(Q0);\n\n  in(I1_now);\n"))
      << text;
}

TEST(WritingSketches, SamplesOfASketchAreSamplesAgain) {
  const std::string text = sketch(
      "#include <plcLib.h>\nunsigned long T = 0;\n"
      "void setup() { setupPLC(); }\n"
      "void loop() { in(X0); andBit(X1); timerOn(T, 500); out(Y0);\n"
      "  in(X0); timerPulse(T, 200); out(Y1); }\n",
      "plclib");
  EXPECT_TRUE(contains(text,
                       "  X0_now = digitalRead(X0);\n"
                       "  X0_2_now = digitalRead(X0);\n"))
      << text;
  EXPECT_TRUE(contains(text, "timerPulse(T, 200);")) << text;
}

TEST(WritingSketches, AShiftRegisterIsAChainOfBits) {
  const std::string text = sketch(
      "#include <plcLib.h>\nShift s(0x8000);\nvoid setup() { setupPLC(); }\n"
      "void loop() { in(X1); s.inputBit(); in(X0); s.shiftRight();\n"
      "  s.bitValue(0); out(Y0); }\n",
      "plclib");
  EXPECT_TRUE(contains(text, "out(s_b15);")) << text;
}

TEST(WritingSketches, AnOutputThatNothingWritesKeepsItsValue) {
  const std::string text = sketch(
      "PROGRAM p\nVAR_INPUT a : BOOL; END_VAR\n"
      "VAR_OUTPUT q, on : BOOL := TRUE; END_VAR\n  LD a\n  ST q\n"
      "END_PROGRAM\n",
      "il-iec");
  EXPECT_TRUE(contains(text, "  digitalWrite(on, HIGH);\n\n  in(a);\n"))
      << text;
  EXPECT_TRUE(contains(text, "  pinMode(q, OUTPUT);\n  digitalWrite(q, HIGH);"))
      << text;
}

TEST(WritingSketches, ACommentEndsWithItsLine) {
  const std::string text = sketch("// in C:\\plc\\\nQ0 = I0;\n");
  EXPECT_TRUE(contains(text, "// in C:\\plc\\ .\n")) << text;
}

TEST(WritingSketches, RefusesWhatABoardCannot) {
  const auto refused = [](const std::string& text, const char* words,
                          const std::string& from = "script") {
    const std::string said = sketch(text, from);
    EXPECT_TRUE(contains(said, "RP084 ") && contains(said, words)) << said;
  };
  refused("QW0 = 3;\n", "`QW0` is a word: an output pin");
  refused("Q0 = IW0 > 3;\n", "`IW0` may be outside of 0..1023");
  refused("N = N + 1; Q0 = N > 3;\n", "this may leave the 32 bits");
  refused("Q0 = C(0, 3, I0, I1, false);\n", "counts down without a bound");
  refused("Q0 = T(0, 2100000, I0);\n", "up to 24 days");
  refused("Q0 = TOF(0, 1, I0); Q1 = TOF(0, 2, I0);\n", "several presets");
  refused("//@ dialect yun\ny10 = A0 * 90; y0 = y10 > 5;\n", "16 bits");
  refused(
      "#include <plcLib.h>\nunsigned long T = 0, U = 0;\n"
      "void setup() { setupPLC(); }\n"
      "void loop() { in(X0); timerCycle(T, 5, U, 5); out(Y0); }\n",
      "a cycle-plclib14", "plclib");
  std::string pins;
  for (int i = 0; i < 50; ++i) {
    const std::string name = "out" + std::to_string(i);
    pins += "//@ output " + name + "\n" + name + " = I0;\n";
  }
  refused(pins, "51 bits and 0 words of inputs and outputs");
  std::string deep = "I0";
  for (int i = 0; i < 200; ++i) {
    deep = "(" + deep + (i % 2 == 0 ? " && I1) != I2" : " || I1) != I2");
    deep = "(" + deep + ")";
  }
  refused("Q0 = " + deep + ";\n", "nested more than");
}

TEST(WritingSketches, DeepContactsNeedNoStack) {
  std::string deep = "I0";
  for (int i = 0; i < 60; ++i) {
    deep = "(" + deep + (i % 2 == 0 ? " && I1)" : " || I2)");
  }
  const std::string text = sketch("Q0 = " + deep + ";\n");
  EXPECT_FALSE(contains(text, "stack")) << text;
}

}  // namespace
}  // namespace rung
