// What a written program looks like, and what is refused.

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "lowering.h"

namespace rung {
namespace {

const WrittenLanguage& language(std::string_view name) {
  const auto& all = written_languages();
  return *std::find_if(all.begin(), all.end(), [&](const WrittenLanguage& it) {
    return it.name == name;
  });
}

std::string written(std::string_view name, const std::string& script,
                    const std::string& from = "script") {
  const auto source = read_program(from, "", script, "folder/test.rung");
  EXPECT_EQ(source->error, "");
  const Lowered lowered = lower(language(name), *source);
  if (!lowered.written) return lowered.refused;
  EXPECT_EQ(validate(language(name), *source, *lowered.written), "");
  return lowered.written->text;
}

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

// --- the pages ---------------------------------------------------------------

struct Example {
  std::string language;  // of the second block
  std::string script;
  std::string expected;
  int line = 0;
};

/// A block fenced by ```rung, and the next one: what it is lowered to.
std::vector<Example> documented() {
  std::ifstream page(RUNG_SOURCE_DIR "/docs/lowering.md");
  std::vector<Example> examples;
  std::string script;
  std::string* block = nullptr;
  int number = 0;
  for (std::string line; std::getline(page, line);) {
    ++number;
    if (!line.starts_with("```")) {
      if (block != nullptr) *block += line + "\n";
    } else if (block != nullptr) {
      block = nullptr;
    } else if (line == "```rung") {
      script.clear();
      block = &script;
    } else if (!script.empty()) {
      examples.push_back({line.substr(3), script, "", number});
      block = &examples.back().expected;
    }
  }
  return examples;
}

TEST(WritingDocumentation, ShowsWhatIsWritten) {
  const auto examples = documented();
  EXPECT_EQ(examples.size(), written_languages().size());
  for (const Example& example : examples) {
    const std::string text = written(example.language, example.script);
    if (example.language == "plcopen") {  // the page shows the drawing alone
      EXPECT_TRUE(contains(text, example.expected))
          << "docs/lowering.md:" << example.line << "\n"
          << text;
      continue;
    }
    EXPECT_EQ(text, example.expected) << "docs/lowering.md:" << example.line;
  }
}

// --- names and comments ------------------------------------------------------

TEST(WritingIec, NamesThatCannotBeAreRenamed) {
  const std::string text = written(
      "il-iec",
      "s = I0 && !S; S = s || I1;\nwhile__1 = S; TON = s; _x_ = TON;\n");
  EXPECT_TRUE(contains(text, "s_1 : BOOL; (* s *)")) << text;
  EXPECT_TRUE(contains(text, "S_2 : BOOL; (* S *)")) << text;
  EXPECT_TRUE(contains(text, "while_1 : BOOL; (* while__1 *)")) << text;
  EXPECT_TRUE(contains(text, "TON_1 : BOOL; (* TON *)")) << text;
  EXPECT_TRUE(contains(text, "x : BOOL; (* _x_ *)") ||
              contains(text, "vx : BOOL; (* _x_ *)"))
      << text;
}

TEST(WritingIec, CommentsStandAtTheirRungs) {
  const std::string text =
      written("il-iec",
              "// first *) line\n/* two\n   lines */\nQ0 = I0; // behind\n"
              "// last\n");
  EXPECT_TRUE(contains(text,
                       "  (* first * ) line *)\n  (* two *)\n  (* lines *)\n"
                       "  (* behind *)\n  LD   I0\n"))
      << text;
  EXPECT_TRUE(contains(text, "(* last *)\nEND_PROGRAM")) << text;
}

TEST(WritingIec, PropertyLinesGoAlong) {
  const std::string text = written(
      "il-iec",
      "//@ language script\n//@ scan 2..9 ms\n//@ input IW0 in 0..50\n"
      "//@ R: never Q0 && s\n//@ always T(0).q -> I0\n//@ expect R violated\n"
      "s = T(0, 1, I0); Q0 = IW0 > 20;\n");
  EXPECT_TRUE(contains(text, "(*@ scan 2..9 ms *)")) << text;
  EXPECT_TRUE(contains(text, "(*@ input IW0 in 0..50 *)")) << text;
  EXPECT_TRUE(contains(text, "never Q0 && s_1 *)")) << text;
  EXPECT_TRUE(contains(text, "(* of the source: always T(0).q")) << text;
  EXPECT_TRUE(contains(text, "(* of the source: expect")) << text;
  EXPECT_FALSE(contains(text, "language")) << text;
}

TEST(WritingIec, PropertyLinesOfMadeCellsGoAlong) {
  const std::string list =
      "\tL DW#16#2\n\tL DW#16#1\n\t__ASSERT== __ACCU 1, DW#16#1\n";
  const std::string text = written("st", list, "stl");
  EXPECT_TRUE(contains(text, "always assert_")) << text;
}

// --- refusals ----------------------------------------------------------------

TEST(WritingIec, RefusesWhatDoesNotFit) {
  const auto refused = [](const std::string& script, const char* words) {
    const std::string said = written("il-iec", script);
    EXPECT_TRUE(contains(said, "RP084 ") && contains(said, words)) << said;
  };
  refused("N = N + 1; Q0 = N > 3;\n", "`N` may leave -32768..32767");
  refused("Q0 = IW0 * 40000 > 7;\n", "the constant 40000 is outside of");
  refused("Q0 = IW0 * 2 > 7;\n", "this may leave -32768..32767");
  refused("Q0 = C(0, 3, I0, I1, false);\n", "counts down without a bound");
  refused("Q0 = C(0, 656, I0, false, I1);\n", "the count 656 is too large");
  refused("Q0 = T(0, 2147484, I0);\n", "2147484000 ms does not fit a TIME");
  refused("//@ dialect yun\ny0 = C(0, 32767, pin2);\n", "too large");
}

// Half of it may not stay: all that is wrong is said, and nothing is written.
TEST(WritingIec, SaysAllThatDoesNotFit) {
  const std::string said =
      written("il-iec", "N = N + 1; Q0 = C(0, 3, I0, I1, false) && N > 9;\n");
  EXPECT_TRUE(contains(said, "`N` may leave")) << said;
  EXPECT_TRUE(contains(said, "counts down")) << said;
}

TEST(WritingIec, TheControllersArithmeticWraps) {
  const std::string text =
      written("il-iec", "y10 = A0 * 9 - A1 * 60 + y10; y0 = y10 - 5 > A2;\n");
  EXPECT_TRUE(contains(text, "MUL  60")) << text;
}

// What a jump skipped in the source is skipped again.
TEST(WritingIec, InstructionListsComeBack) {
  const std::string list =
      "PROGRAM p\nVAR_INPUT a, b : BOOL; n : INT; END_VAR\n"
      "VAR_OUTPUT q, m : BOOL; END_VAR\n"
      "VAR t : TON; c : CTU; e : R_TRIG; l : SR; v : INT; END_VAR\n"
      "  LD a\n  JMPCN over\n  CAL t(IN := b, PT := T#3s)\n  LD n\n  ADD v\n"
      "  ST v\nover: CAL c(CU := b, R := a, PV := 7)\n  LD c.CV\n  GT v\n"
      "  ST q\n  CAL e(CLK := q)\n  LD e.Q\n  S m\n  LD t.Q\n  R m\n"
      "  CAL l(S1 := a, R := m)\n  LD l.Q1\n  ST q\nEND_PROGRAM\n";
  const std::string text = written("il-iec", list, "il-iec");
  EXPECT_TRUE(contains(text, "  LD   c.CV\n  GT   v\n")) << text;
  EXPECT_FALSE(contains(text, "t_Q")) << text;
}

}  // namespace
}  // namespace rung
