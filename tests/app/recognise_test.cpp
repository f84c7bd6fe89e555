#include "frontend/recognise.h"

#include <gtest/gtest.h>

namespace rung {
namespace {

TEST(Recognise, TellsLanguagesByTheirContent) {
  EXPECT_EQ(recognise("Q0 = I0;\n").name, "script");
  EXPECT_EQ(recognise("").name, "script");
  EXPECT_EQ(recognise("// a comment\n\npostfix 1\n").name, "postfix");
  EXPECT_EQ(recognise("\x9eRPF\x01").name, "postfix");
  EXPECT_EQ(recognise("LDmicro0.1\n").name, "ldmicro");
  EXPECT_EQ(recognise("<?xml version='1.0'?>").name, "plcopen");
  EXPECT_EQ(recognise("// x\n#include <plcLib.h>\n").name, "plclib");
  EXPECT_EQ(recognise("void customIO() {\n").name, "plclib");
  EXPECT_EQ(recognise("// x\n  L 30\n  T MW 0\n").name, "stl");
  EXPECT_EQ(recognise("L = I0;\nU = L;\n").name, "script");
  EXPECT_EQ(recognise("PROGRAM main\n").name, "st");
  EXPECT_EQ(recognise("LD X0\nOUT Y0\n").name, "il-mitsubishi");
  EXPECT_EQ(recognise("LD start\nST motor\n").name, "il-iec");
  EXPECT_EQ(recognise("||--] [--( )--||\n").name, "ascii");
}

TEST(Recognise, FilesThatNoReaderTakesAreKnown) {
  const char* const project =
      "VOVKPLCPROJECT p\nPROGRAM main\n  LD X0.0\n  ST Y0.0\n";
  EXPECT_EQ(recognise(project).name, "vovkplc");
  EXPECT_EQ(recognise("_FILES_CLASSICLADDER\n_FILE-rungs.csv\n").name,
            "classicladder");
  EXPECT_EQ(recognise("// x\nlet a: u8 @ M0 = 1;\n").name, "plcscript");
  EXPECT_EQ(recognise("function f(): u8 {\n").name, "plcscript");
  EXPECT_EQ(recognise("{\n  \"nodes\": []\n}\n").name, "json");
  EXPECT_EQ(recognise("let = I0;\n").name, "script");
  EXPECT_EQ(recognise("{ Q0 = I0; }\n").name, "script");
  EXPECT_FALSE(recognise("{}").supported());
}

TEST(Recognise, AScriptMayUseTheWordsOfOtherLanguages) {
  EXPECT_EQ(recognise("TYPE = I0;\n").name, "script");
  EXPECT_EQ(recognise("LD = I0;\n").name, "script");
  EXPECT_EQ(recognise("postfix = I0;\n").name, "script");
  EXPECT_EQ(recognise("PROGRAM1 = I0;\n").name, "script");
  EXPECT_EQ(recognise("// PROGRAM main\nQ0 = I0;\n").name, "script");
}

TEST(DeclaredLanguage, IsWhatTheLineSays) {
  EXPECT_EQ(declared_language("Q0 = I0;\n//@ language script \n"), "script");
  EXPECT_EQ(declared_language("(*@ language il-iec *)\nLD x\n"), "il-iec");
  EXPECT_EQ(declared_language("// language st\n"), "");
  EXPECT_EQ(declared_language("//@ languages st\n"), "");
  EXPECT_EQ(declared_language("//@ language"), "");
}

}  // namespace
}  // namespace rung
