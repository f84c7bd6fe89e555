// Ladders of LDmicro: letters and names, inputs that are read when they are
// looked at, scans of a fixed time.

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "backend/ldmicro/write.h"
#include "lowering.h"

namespace rung {
namespace {

const WrittenLanguage kLdmicro = {"ldmicro", lower_to_ldmicro};

std::string written(const std::string& text,
                    const std::string& from = "script") {
  const auto source = read_program(from, "", text, "folder/test.rung");
  EXPECT_EQ(source->error, "");
  if (!source->error.empty()) return source->error;
  const Lowered lowered = lower(kLdmicro, *source);
  if (!lowered.written) return lowered.refused;
  EXPECT_EQ(validate(kLdmicro, *source, *lowered.written), "")
      << lowered.written->text;
  return lowered.written->text;
}

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

// A pin is read at every contact: one that has several is copied first.
TEST(WritingLdmicro, InputsAreReadOnce) {
  const std::string text = written("Q0 = I0 && I1; Q1 = !I0;\n");
  EXPECT_TRUE(contains(text,
                       "RUNG\n    CONTACTS XI0 0\n    COIL RXI0 0 0 0\nEND\n"
                       "RUNG\n    CONTACTS RXI0 0\n    CONTACTS XI1 0\n"))
      << text;
  EXPECT_TRUE(contains(text, "CONTACTS RXI0 1\n")) << text;
}

// One that is read twice is two inputs, and that is no translation.
TEST(WritingLdmicro, AnInputThatIsReadTwiceIsNoticed) {
  const auto source = read_program("script", "", "Q0 = I0 && I1; Q1 = !I0;\n");
  Lowered lowered = lower(kLdmicro, *source);
  ASSERT_TRUE(lowered.written);
  std::string& text = lowered.written->text;
  for (std::size_t at;
       (at = text.find("CONTACTS RXI0")) != std::string::npos;) {
    text.replace(at, 13, "CONTACTS XI0");
  }
  EXPECT_EQ(validate(kLdmicro, *source, *lowered.written), "`XI0.2` is new");
}

TEST(WritingLdmicro, NamesSayWhatTheyAre) {
  const std::string text = written(
      "PROGRAM p\nVAR_INPUT Xstart, stop : BOOL; END_VAR\n"
      "VAR_OUTPUT Ymotor, lamp : BOOL; END_VAR\n"
      "VAR Ron, off : BOOL; n, count, Time : INT; END_VAR\n"
      "Ymotor := (Xstart OR Ymotor) AND stop; Ron := Ymotor; off := NOT Ron;\n"
      "lamp := off; count := n * 3; Time := count - n;\nEND_PROGRAM\n",
      "st");
  EXPECT_TRUE(contains(text,
                       "VAR LIST\n    2 bytes n\n    2 bytes count\n"
                       "    2 bytes NTime\n"))
      << text;
  for (const char* const name :
       {" Xstart at 0\n", " Xstop at 0\n", " Ymotor at 0\n", " Ylamp at 0\n",
        "COIL Ron 0 0 0\n", "COIL Roff 0 0 0\n", "MUL count n 3\n"}) {
    EXPECT_TRUE(contains(text, name)) << name << text;
  }
}

// In a file that says how long a scan takes, that is the time of the source.
TEST(WritingLdmicro, TheCycleIsTheScan) {
  const auto cycle = [](const std::string& scan) {
    const std::string text = written("//@ scan " + scan + "\nQ0 = I0;\n");
    const std::size_t at = text.find("CYCLE=") + 6;
    return text.substr(at, text.find(' ', at) - at);
  };
  EXPECT_EQ(cycle("7 ms"), "7000");
  EXPECT_EQ(cycle("1..100 ms"), "10000");
  EXPECT_EQ(cycle("1..9 ms"), "9000");
  EXPECT_EQ(cycle("30..90 ms"), "30000");
}

// A delay that ends within a scan is over at its end.
TEST(WritingLdmicro, DelaysAreWholeScans) {
  const std::string text =
      written("//@ scan 30 ms\nQ0 = T(0, 0.2, I0); Q1 = TOF(1, 0.06, I1);\n");
  EXPECT_TRUE(contains(text, "TON T_0 210000 0\n")) << text;
  EXPECT_TRUE(contains(text, "TOF TOF_1 60000 0\n")) << text;
}

TEST(WritingLdmicro, FirstValuesAreGivenInTheFirstScan) {
  const std::string text = written(
      "PROGRAM p\nVAR_INPUT a : BOOL; END_VAR\nVAR_OUTPUT q : BOOL; END_VAR\n"
      "VAR s : BOOL := TRUE; n : INT := 7; k : INT := 9; END_VAR\n"
      "q := s AND n > 3; s := s AND a; n := n - k;\nEND_PROGRAM\n",
      "st");
  EXPECT_TRUE(contains(text, "CONTACTS Rstarted 1\n    COIL Rs 0 1 0\n"))
      << text;
  EXPECT_TRUE(contains(text, "CONTACTS Rstarted 1\n    MOVE n 7\n")) << text;
}

TEST(WritingLdmicro, ComparisonsAreContacts) {
  const std::string text = written(
      "PROGRAM p\nVAR_INPUT a : BOOL; END_VAR\nVAR_OUTPUT q : BOOL; END_VAR\n"
      "VAR n : INT; END_VAR\nn := n + 1;\n"
      "q := NOT (n > 5) AND (a OR n * 2 = 4) AND n <> -3;\nEND_PROGRAM\n",
      "st");
  EXPECT_TRUE(contains(text, "LEQ n 5\n")) << text;
  EXPECT_TRUE(contains(text, "MUL Nvalue_1 n 2\n")) << text;
  EXPECT_TRUE(contains(text, "EQU Nvalue_1 4\n")) << text;
  EXPECT_TRUE(contains(text, "NEQ n -3\n")) << text;
}

// Older versions of the tool have room for sixteen elements in a row.
TEST(WritingLdmicro, LongRowsHaveRelays) {
  std::string all = "I0";
  for (int i = 1; i < 300; ++i) all += " && I" + std::to_string(i);
  const std::string text = written("Q0 = " + all + ";\n");
  std::size_t rows = 0;
  for (std::size_t at = 0; (at = text.find("RUNG\n", at)) != std::string::npos;
       at += 5) {
    const std::string rung = text.substr(at, text.find("END\n", at) - at);
    std::size_t contacts = 0;
    for (std::size_t i = 0; (i = rung.find("CONTACTS", i)) != std::string::npos;
         ++i) {
      ++contacts;
    }
    EXPECT_LE(contacts, 15U) << rung;
    ++rows;
  }
  EXPECT_EQ(rows, 300U / 15 + 2 + 1);
}

// Lines are not indented by their depth for ever.
TEST(WritingLdmicro, IsLinearInTheDepth) {
  std::string deep = "I0";
  for (int i = 1; i < 2000; ++i) {
    deep = "(" + deep + (i % 2 == 0 ? " && I" : " || I") +
           std::to_string(i % 9) + ")";
  }
  EXPECT_LT(written("Q0 = " + deep + ";\n").size(), 600'000U);
}

TEST(WritingLdmicro, PropertyLinesAndCommentsGoAlong) {
  const std::string text = written(
      "//@ scan 10 ms\n//@ R: never Q0 && s\n//@ always T(0).q -> I0\n"
      "// @ R: never I0\n// \x40 \\r\\n@ R: never I0\n" +
      ("// " + std::string(298, 'x') + "  @ R: never I0\n") +
      "s = T(0, 1, I0); Q0 = s;\n");
  const auto back = read_program("ldmicro", "", text);
  ASSERT_EQ(back->error, "");
  std::vector<std::string> lines;
  for (const AstAnnotation& one : back->program.annotations) {
    lines.emplace_back(one.text);
  }
  EXPECT_EQ(lines, (std::vector<std::string>{"R: never YQ0 && Rs"})) << text;
  EXPECT_TRUE(contains(text, "COMMENT of the source: always T(0).q -> XI0"))
      << text;
}

TEST(WritingLdmicro, RefusesWhatItCannotExpress) {
  const auto refused = [](const std::string& text, const char* words,
                          const std::string& from = "script") {
    const std::string said = written(text, from);
    EXPECT_TRUE(contains(said, "RP084 ") && contains(said, words)) << said;
  };
  refused("Q0 = T(0, 1, I0);\n", "scans of a fixed time");
  refused("//@ scan 9..10 ms\nQ0 = T(0, 1, I0);\n", "scans of a fixed time");
  refused("//@ scan 1 ms\nQ0 = T(0, 33, I0);\n", "more than 32767 scans");
  refused("//@ scan 2000000 ms\nQ0 = I0;\n", "more than 1000 s");
  refused("Q0 = IW0 > 3;\n", "`IW0` is a word");
  refused("//@ scan 10 ms\nQ0 = T(0, 1, I0) && T(0, 1, I1);\n",
          "several places");
  refused("//@ scan 10 ms\nQ0 = T(0, 1, I0) ; Q1 = T(0, 2, I1);\n",
          "several presets");
  refused("//@ scan 10 ms\nQ0 = I1 && T(0, 1, I0);\n", "in every scan");
  refused("Q0 = C(0, 3, I0, I1, false);\n", "counts down");
  const std::string head =
      "PROGRAM p\nVAR_INPUT a, b : BOOL; END_VAR\nVAR_OUTPUT q : BOOL; "
      "END_VAR\nVAR x : CTU; t : TP; END_VAR\n";
  refused(head + "x(CU := a, R := b, PV := 7); q := x.Q;\nEND_PROGRAM\n",
          "have nothing for", "st");
  refused(head + "t(IN := a, PT := T#1s); q := t.Q;\nEND_PROGRAM\n",
          "have nothing for", "st");
  refused(
      "LDmicro0.1\nCYCLE=10000 us\nPROGRAM\nRUNG\n    CONTACTS Xa 0\n"
      "    COIL Ya 0 0 0\nEND\nRUNG\n    CONTACTS Xa 0\n    COIL Yb 0 0 "
      "0\nEND\n",
      "another look at an input", "ldmicro");
}

}  // namespace
}  // namespace rung
