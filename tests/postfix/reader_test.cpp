// The text form: what is refused, and with which words.

#include "frontend/postfix/reader.h"

#include <gtest/gtest.h>

#include "frontend/postfix/disassemble.h"
#include "tests/postfix/image.h"

namespace rung {
namespace {

std::string said(std::string_view text) {
  std::string diagnostics;
  program_of(text, diagnostics);
  return diagnostics;
}

constexpr std::string_view kCells =
    "input bit a\noutput bit q\nmemory word w in 0..9\nelement T(0) "
    "timer-yun\nelement C(0) counter-yun\nelement E(0) edge\n";

std::string said_of_rung(std::string_view rung) {
  return said(postfix_text(kCells, std::string(rung) + "\n"));
}

std::string said_of_line(std::string_view line) {
  return said(postfix_text(std::string(line) + "\n", ""));
}

TEST(PostfixReader, ReadsTheExampleOfTheManual) {
  const std::string text =
      "postfix 1\ndialect yun\nevaluation strict\nscan 1..100 ms\n"
      "input bit pin4\ninput word A0 in 0..1023\noutput bit pin3\n"
      "memory bit y5 = 1\nmemory word level in -32768..32767 = 20\n"
      "element T(0) timer-yun\n//@ always !(pin3 && pin4)\nrungs\n"
      "pin4 T(0,2000ms) =y5\nA0 level + wrap16 100 > y5 || =pin3\n";
  const Program program = program_of(text);
  EXPECT_EQ(program.language, "postfix");
  EXPECT_EQ(program.dialect, "yun");
  EXPECT_EQ(program.cells.size(), 5U);
  EXPECT_EQ(program.rungs.size(), 2U);
  ASSERT_EQ(program.annotations.size(), 1U);
  EXPECT_EQ(program.annotations[0].text, "always !(pin3 && pin4)");
  EXPECT_EQ(program.calls[CallId(0)].parameter, 2000);
  EXPECT_EQ(program.instances[InstanceId(0)].name, "T(0)");
  EXPECT_EQ(program.instances[InstanceId(0)].clock_cap, 2001);
}

TEST(PostfixReader, LeavesCommentsAndBlanksAside) {
  const Program program = program_of(
      "// a file\n\n  postfix\t1 // version\r\ndialect none\n\nevaluation "
      "strict\nscan 0..5 ms\noutput bit q\nrungs\n\n// nothing\n true =q // "
      "done\n//@ never !q");
  EXPECT_EQ(program.rungs.size(), 1U);
  EXPECT_EQ(program.comments.size(), 4U);
  EXPECT_EQ(program.annotations.size(), 1U);
}

TEST(PostfixReader, QuotedNames) {
  const Program program = program_of(postfix_text(
      "input bit \"Motor 1\"\ninput bit \"true\"\noutput bit \"=q\"\n"
      "memory bit \"//\"\noutput bit T\n",
      "\"Motor 1\" \"true\" && =\"=q\"\n\"//\" =T\n"));
  EXPECT_EQ(program.cells[CellId(0)].name, "Motor 1");
  EXPECT_EQ(program.rungs.size(), 2U);
}

TEST(PostfixReader, RefusesAHeaderOutOfOrder) {
  EXPECT_NE(said(""), "");
  EXPECT_NE(said("postfix 1\n"), "");
  EXPECT_EQ(said("postfix 2\ndialect none\nevaluation strict\nscan 1..2 "
                 "ms\nrungs\n"),
            "RP081: this line reads `postfix 1`: there is no other version\n");
  EXPECT_EQ(said("postfix 1\nevaluation strict\nscan 1..2 ms\nrungs\n"),
            "RP081: a `dialect` line is expected here, not `evaluation`\n");
  EXPECT_EQ(said("postfix 1\ndialect none\nevaluation strict\nscan 1..2 "
                 "ms\nscan 1..2 ms\nrungs\n"),
            "RP081: the `scan` line comes first\n");
  EXPECT_EQ(said("postfix 1\nrungs\n"),
            "RP081: a `dialect` line is expected here, not `rungs`\n");
  EXPECT_EQ(said("postfix 1\ndialect none\nevaluation strict\nscan 1..2 ms\n"),
            "RP081: the file ends before its `rungs` line\n");
  for (const char* line :
       {"dialect plclib", "dialect", "dialect yun sim", "\"dialect\" none"}) {
    EXPECT_NE(said("postfix 1\n" + std::string(line) +
                   "\nevaluation strict\nscan 1..2 ms\nrungs\n") +
                  (line[0] == '"' ? "x" : ""),
              "")
        << line;
  }
  for (const char* line :
       {"scan 2..1 ms", "scan 1..2", "scan 1-2 ms", "scan -1..2 ms",
        "scan 1..2147483648 ms", "scan 1..2 s", "scan ..2 ms", "scan 1.. ms"}) {
    EXPECT_NE(said("postfix 1\ndialect none\nevaluation strict\n" +
                   std::string(line) + "\nrungs\n"),
              "")
        << line;
  }
}

TEST(PostfixReader, RefusesDeclarations) {
  for (const char* line : {"input",
                           "input bit",
                           "input byte a",
                           "input bit 1a",
                           "input bit a-b",
                           "input bit a =",
                           "input bit a = 2",
                           "input bit a = -1",
                           "input bit a 1",
                           "input bit a in 0..1",
                           "input word a",
                           "input word a in",
                           "input word a in 0",
                           "input word a in 1..0",
                           "input word a in 0..2147483648",
                           "input word a in 0..9 = 10",
                           "input word a in 0..9 = x",
                           "input word a in 0..9 = 1 2",
                           "inout bit a",
                           "input bit =a",
                           "input bit \"\"",
                           "input bit true",
                           "input bit \"a",
                           "element",
                           "element T(0)",
                           "element T(0) timer",
                           "element C(0) timer-yun",
                           "element T timer-yun",
                           "element T(-1) timer-yun",
                           "element T() timer-yun",
                           "element T(0,1) timer-yun",
                           "element T(2147483648) timer-yun",
                           "element T(0) timer-yun\nelement T(0) timer-sim",
                           "a =q"}) {
    EXPECT_NE(said_of_line(line), "") << line;
  }
  EXPECT_EQ(said_of_line("input bit a\nmemory bit a"),
            "RP083: the cell `a` stands above already\n");
}

TEST(PostfixReader, RefusesRungs) {
  const std::string missing = "RP080: an operand is missing before ";
  EXPECT_EQ(said_of_rung("a && =q"), missing + "`&&`\n");
  EXPECT_EQ(said_of_rung("! =q"), missing + "`!`\n");
  EXPECT_EQ(said_of_rung("T(0,1ms) =q"), missing + "`T(0,1ms)`\n");
  EXPECT_EQ(said_of_rung("a"), "RP080: a rung ends with its target, `=NAME`\n");
  EXPECT_EQ(said_of_rung("=q"), "RP080: the rung has no value\n");
  EXPECT_EQ(said_of_rung("a a =q"),
            "RP080: the rung has 2 values: an operator is missing\n");
  EXPECT_EQ(said_of_rung("a =q a =q"), "RP080: a rung ends at its target\n");
  EXPECT_EQ(said_of_rung("a =q a"), "RP080: a rung ends at its target\n");
  for (const char* rung : {"a =1",
                           "2147483648 =w",
                           "1.5 =w",
                           "0x10 =w",
                           "a & =q",
                           "a = q",
                           "a \"b",
                           "a =\"q",
                           "a T(0,1) =q",
                           "a T(0,1s) =q",
                           "a T(0) =q",
                           "a T(0,) =q",
                           "a T(,1ms) =q",
                           "a T(1,1ms) =q",
                           "a T(0,1ms,2) =q",
                           "a TR(0,1ms) =q",
                           "a C(0,1ms) =q",
                           "a C(0,2147483648) =q",
                           "a TOF(0,1ms) =q",
                           "a E(0) =q",
                           "a (0) =q",
                           "a T(0,1ms =q",
                           "a\x01 =q",
                           "a a && && =q",
                           "\xff\xfe =\xff"}) {
    EXPECT_NE(said_of_rung(rung), "") << rung;
  }
}

TEST(PostfixReader, RefusesNamesAndTypes) {
  EXPECT_EQ(said_of_rung("b =q"), "RP083: no cell `b` is declared\n");
  EXPECT_EQ(said_of_rung("a =b"), "RP083: no cell `b` is declared\n");
  EXPECT_EQ(said_of_rung("a =a"),
            "RP083: `a` is an input: no rung writes it\n");
  EXPECT_EQ(said_of_rung("w =q"),
            "RP083: a bit is expected here and a word is given: `to_bit` "
            "converts it\n");
  EXPECT_EQ(said_of_rung("w 0 / =w"),
            "RP083: the divisor must be a constant other than 0\n");
  for (const char* rung : {"a =w", "1 =q", "w a && =q", "a w + =w", "a a == =q",
                           "w ! =q", "a neg =w", "a wrap16 =w", "w to_word =w",
                           "a to_bit =q", "w T(0,1ms) =q", "5 TR(0) =q",
                           "5 RISE(0) =q", "w w / =w", "w 1 neg / =w"}) {
    EXPECT_NE(said_of_rung(rung), "") << rung;
  }
}

TEST(PostfixReader, OneErrorALineAndOnWithTheNext) {
  EXPECT_EQ(said_of_rung("x =q\na =q\ny =q"),
            "RP083: no cell `x` is declared\nRP083: no cell `y` is declared\n");
  EXPECT_EQ(said_of_rung("a ?? =q\na =q\n= =q"),
            "RP080: `??` is no name, no operator and no word of 32 bits\n"
            "RP080: `=` is no name, no operator and no word of 32 bits\n");
}

TEST(PostfixReader, RefusesABinaryWithItsReason) {
  Image image;
  image.code = Image::bytes_of({0x03, 0, 0x04, 0, 0});
  EXPECT_EQ(said(image.file()),
            "RP082: `p.postfix` is refused: a rung writes an input (refusal "
            "17), at byte 52\n");
}

TEST(PostfixReader, KnowsItsFilesByTheirContent) {
  EXPECT_TRUE(is_postfix("postfix 1\n"));
  EXPECT_TRUE(is_postfix("// x\n\n postfix 2"));
  EXPECT_TRUE(is_postfix(Image().file()));
  EXPECT_FALSE(is_postfix(""));
  EXPECT_FALSE(is_postfix("postfix"));
  EXPECT_FALSE(is_postfix("postfix = a;"));
  EXPECT_FALSE(is_postfix("y5 = y3;\npostfix 1\n"));
  EXPECT_FALSE(is_postfix("\"postfix\" 1"));
  EXPECT_FALSE(is_postfix("=postfix 1"));
  EXPECT_FALSE(is_postfix("\x9eRP"));
}

// Depth costs no stack.
TEST(PostfixReader, ReadsADeepExpression) {
  std::string rung;
  constexpr int kDepth = 100000;
  for (int i = 0; i < kDepth; ++i) rung += "a ";
  for (int i = 1; i < kDepth; ++i) rung += "&& ";
  const Program program =
      program_of(postfix_text("input bit a\noutput bit q\n", rung + "=q\n"));
  EXPECT_EQ(program.nodes.size(), 2U * kDepth - 1);
}

// The machine can run these; they are the postfix form of no program.
TEST(PostfixReader, RefusesCodeThatIsNoExpression) {
  Image image;
  image.words = 1;
  image.attributes += '\0';
  image.ranges = Image::number(0) + Image::number(0) + Image::number(9);
  image.names += "\1w";
  image.bit_stack = 2;
  image.word_stack = 2;
  // w a w <: the machine's words stand on a stack of their own.
  image.code =
      Image::bytes_of({0x13, 0, 0x03, 0, 0x13, 0, 0x22, 0x06, 0x04, 1, 0});
  EXPECT_EQ(disassemble_postfix(image.file()).refusal,
            "a word is expected right before");

  Image skip;
  skip.flags = 1;
  skip.branches = 1;
  skip.code = Image::bytes_of({0x03, 0, 0x09, 2, 0, 0x03, 0, 0x04, 1, 0});
  EXPECT_EQ(disassemble_postfix(skip.file()).refusal,
            "a skip passes over no element");

  Image strict;
  strict.flags = 1;
  strict.slots = 1;
  strict.bit_stack = 2;
  strict.slot_table = Image::bytes_of({0x50}) + Image::number(0);
  strict.code = Image::bytes_of({0x03, 0, 0x03, 0, 0x50, 0, 0x06, 0x04, 1, 0});
  EXPECT_EQ(disassemble_postfix(strict.file()).refusal,
            "the right operand holds an element and is not skipped");
}

}  // namespace
}  // namespace rung
