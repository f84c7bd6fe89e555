#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <string>
#include <vector>

#include "declared_text.h"
#include "frontend/semantics.h"

namespace rung::test {
namespace {

constexpr std::string_view kHead =
    "LDmicro0.1\nCYCLE=10000\nIO LIST\nXa at 1\nXb at 2\nYq at 3\nYr at 4\n"
    "END\nPROGRAM\n";

/// Rungs from `;`-separated elements; rungs are separated by `|`.
std::string program_of(std::string_view body, std::string_view head = kHead) {
  std::string text = std::string(head) + "RUNG\n";
  for (const char c : body) {
    if (c == '|') {
      text += "\nEND\nRUNG\n";
    } else {
      text += c == ';' ? '\n' : c;
    }
  }
  return text + "\nEND\n";
}

struct Row {
  std::string_view body;
  std::string_view rungs;
};

TEST(LdmicroReader, ReadsElements) {
  const std::vector<Row> table = {
      {"", ""},
      {"COMMENT nothing", ""},
      {"PLACEHOLDER", ""},
      {"CONTACTS Xa 0;COIL Yq 0 0 0", "Yq=Xa"},
      {"CONTACTS Xa 1;CONTACTS Rm 0;COIL Yq 1 0 0", "Yq=(! (&& (! Xa) Rm))"},
      {"CONTACTS Xa 0 1;COIL Yq 0 0 0 0", "Yq=Xa"},
      {"CONTACTS Xa 0;COIL Yq 0 1 0", "Yq=(|| Xa Yq)"},
      {"CONTACTS Xa 0;COIL Yq 0 0 1", "Yq=(&& (! Xa) Yq)"},
      {"CONTACTS Xa 0;COIL Yq 0 0 0 1", "Yq=(^ (RISE Xa 0) Yq)"},
      {"SHORT;COIL Yq 0 0 0", "Yq=true"},
      {"CONTACTS Xa 0;OPEN;COIL Yq 0 0 0", "Yq=(&& Xa false)"},
      // Branches of contacts are one expression.
      {"PARALLEL;CONTACTS Xa 0;SERIES;CONTACTS Xb 0;CONTACTS Rm 1;END;END;"
       "COIL Yq 0 0 0",
       "Yq=(|| Xa (&& Xb (! Rm)))"},
      {"CONTACTS Xa 0;PARALLEL;CONTACTS Xb 0;PARALLEL;CONTACTS Rm 0;SHORT;END;"
       "END;COIL Yq 0 0 0",
       "Yq=(&& Xa (|| Xb (|| Rm true)))"},
      // Every read of an input is a fresh sample.
      {"CONTACTS Xa 0;COIL Yq 0 0 0|CONTACTS Xa 0;CONTACTS Xa 1;COIL Yr 0 0 0",
       "Yq=Xa | Yr=(&& Xa.2 (! Xa.3))"},
      // Branches with coils begin with the same power.
      {"CONTACTS Xa 0;PARALLEL;COIL Yq 0 0 0;COIL Yr 1 0 0;END",
       "power.1=Xa | Yq=power.1 | Yr=(! power.1)"},
      {"PARALLEL;COIL Yq 0 0 0;SERIES;CONTACTS Xa 0;COIL Yr 0 0 0;END;END",
       "Yq=true | Yr=Xa"},
      // What a branch writes, the next one sees; not the power before it.
      {"CONTACTS Rm 0;PARALLEL;COIL Rm 1 0 0;SERIES;CONTACTS Rm 0;COIL Yq 0 0 "
       "0;END;END",
       "power.1=Rm | Rm=(! power.1) | Yq=(&& power.1 Rm)"},
      {"CONTACTS Xa 0;OSR;COIL Yq 0 0 0", "Yq=(RISE Xa 0)"},
      {"CONTACTS Xa 0;OSF;COIL Yq 0 0 0", "Yq=(FALL Xa 0)"},
      {"CONTACTS Xa 0;PARALLEL;OSR;OSF;END;COIL Yq 0 0 0",
       "power.1=Xa | power.2=(RISE power.1 0) | power.3=(FALL power.1 1) | "
       "Yq=(|| power.2 power.3)"},
      // An edge is there, too, where nothing looks at it.
      {"CONTACTS Xa 0;OSR", "power.1=(RISE Xa 0)"},
      {"PARALLEL;COIL Yq 0 0 0;SERIES;OSR;CONTACTS Xa 0;END;END",
       "Yq=true | power.1=(&& (RISE true 0) Xa)"},
      {"CONTACTS Xa 0;OSC;COIL Yq 0 0 0", "osc.1=(&& Xa (! osc.1)) | Yq=osc.1"},
      {"CONTACTS Xa 0;TON Ta 30000;COIL Yq 0 0 0", "Yq=(TON Xa 0 20)"},
      {"CONTACTS Xa 0;TON Ta 30000 0;COIL Yq 0 0 0", "Yq=(TON Xa 0 30)"},
      {"CONTACTS Xa 0;TOF Ta 30000 -1;RTO Tb 35000;COIL Yq 0 0 0",
       "Yq=(RTO (TOF Xa 0 20) 1 20)"},
      {"CONTACTS Xa 0;RES Ta|TON Ta 30000",
       "power.1=Xa | reset.2=(TON.RES power.1 0) | power.3=(TON true 0 20)"},
      {"MOVE Ta 0|TON Ta 30000",
       "reset.1=(TON.RES true 0) | power.2=(TON true 0 20)"},
      {"EQU a 3;NEQ b -4;LES a b;LEQ a 0x10;GRT a 'A';GEQ a 0b11;COIL Yq 0 0 0",
       "Yq=(&& (&& (&& (&& (&& (== a 3) (!= b -4)) (< a b)) (<= a 16)) (> a "
       "65)) (>= a 3))"},
      {"MOVE a 5", "a=5"},
      {"CONTACTS Xa 0;MOVE a b",
       "power.1=Xa | a=(+ (* (to_word power.1) b) (* (to_word (! power.1)) "
       "a))"},
      {"ADD a b 1;SUB a a b;MUL a 2 b;DIV a b 3;MOD a b 3",
       "a=(wrap16 (+ b 1)) | a=(wrap16 (- a b)) | a=(wrap16 (* 2 b)) | "
       "a=(wrap16 (/ b 3)) | a=(wrap16 (- b (* (/ b 3) 3)))"},
      {"CONTACTS Xa 0;CTU Ca 5;COIL Yq 0 0 0",
       "power.1=(RISE Xa 0) | Ca=(wrap16 (+ Ca (to_word (&& power.1 (< Ca "
       "5))))) | Yq=(>= Ca 5)"},
      {"CONTACTS Xa 0;CTD Ca 5 9 \\;COIL Yq 0 0 0",
       "power.1=(FALL Xa 0) | Ca=(wrap16 (- Ca (to_word (&& power.1 (> Ca "
       "5))))) | Yq=(> Ca 5)"},
      {"CONTACTS Xa 0;MASTER_RELAY|COIL Yq 0 0 0|MASTER_RELAY|COIL Yr 0 0 0",
       "power.1=Xa | Yq=power.1 | Yr=true"},
  };
  for (const Row& row : table) {
    const DeclaredText text("ldmicro", program_of(row.body));
    EXPECT_EQ(text.rungs(), row.rungs) << row.body << "\n" << text.problems();
    EXPECT_FALSE(text.list.has_errors()) << row.body << "\n" << text.problems();
  }
}

struct Refused {
  std::string_view body;
  std::string_view problem;  // a part of the only error
};

TEST(LdmicroReader, RefusesWithNameAndPlace) {
  const std::vector<Refused> table = {
      {"UART_SEND a", "RP087 11:1 the element `UART_SEND` is not supported"},
      {"UART_RECV a", "RP087"},
      {"READ_ADC a", "RP087"},
      {"SET_PWM a 1000", "RP087"},
      {"LOOK_UP_TABLE a b 1 0 1", "RP087"},
      {"PIECEWISE_LINEAR a b 1", "RP087"},
      {"SHIFT_REGISTER a 2", "RP087"},
      {"FORMATTED_STRING a 1 92", "RP087"},
      {"PERSIST a", "RP087"},
      {"GOTO 1", "RP087"},
      {"LABEL x", "RP087"},
      {"SHL a b 1", "RP087"},
      {"SET_BIT a 1", "RP087"},
      {"TCY Ta 10000", "RP087"},
      {"ton Ta 10000", "RP087"},
      {"CONTACTS Xa", "RP054 11:1 `CONTACTS` has 2 to 3 operands, not 1"},
      {"CONTACTS Xa 0 0 0", "RP054"},
      {"COIL Yq 0 0", "RP054"},
      {"RES", "RP054"},
      {"MOVE a", "RP054"},
      {"ADD a b", "RP054"},
      {"EQU a b c", "RP054"},
      {"SHORT 1", "RP054"},
      {"CONTACTS Xa 2", "RP053"},
      {"CONTACTS Xa x", "RP053"},
      {"CONTACTS Rm 0 1", "RP087"},
      {"CONTACTS a 0", "RP052 11:10 `a` has no contact"},
      {"CONTACTS Ma 0", "RP052"},
      {"CONTACTS X.a 0", "RP052"},
      {"CONTACTS 1 0", "RP052"},
      {"COIL Xa 0 0 0", "RP052 11:6 `Xa` has no coil"},
      {"COIL Ta 0 0 0", "RP052"},
      {"COIL Yq 1 1 0", "RP053"},
      {"COIL Yq 0 2 0", "RP053"},
      {"MOVE Yq 1", "RP052 11:6 `Yq` is a bit"},
      {"MOVE #PORTB 1", "RP052"},
      {"MOVE 5 a", "RP052"},
      {"MOVE a 40000", "RP053 11:8 `40000` has more than 16 bits"},
      {"MOVE a 99999999999999999999", "RP052"},
      {"MOVE a Xa", "RP052"},
      {"EQU Rm 1", "RP052"},
      {"DIV a b 0", "RP053"},
      {"DIV a b c", "RP053"},
      {"MOD a b c", "RP053"},
      {"TON Ta 9999 0", "RP053 11:1 the delay of this timer is less"},
      {"TON Ta 10000", "RP053"},
      {"TON Ta x", "RP053"},
      {"TON Ta -1", "RP053"},
      {"TON Ta 9000000000000000000", "RP053"},
      {"TON Ta 10000 9223372036854775807", "RP053"},
      {"TON Ta 600000000;EQU Ta 5",
       "RP053 11:1 the delay of this timer is too"},
      {"TON Xa 50000", "RP052"},
      {"TON Ta 50000|TOF Ta 50000", "RP088 14:5 `Ta` is another timer"},
      {"CTU a 5", "RP052"},
      {"CTU Ca 5 x", "RP053"},
      {"CTU Ca 5 40000", "RP052"},
      {"CTU Ca 5 0 z", "RP053"},
      {"CTR Ca 5", "RP054"},
      {"CTU Ca 5 1|CTD Ca 3 2", "RP088"},
      {"RES a", "RP052"},
      {"PARALLEL;CONTACTS Xa 0", "RP051 10:1 this has no `END`"},
      {"PARALLEL;END", "RP051 11:1 there is no element"},
      {"PARALLEL;SERIES;END;CONTACTS Xa 0;END", "RP051 12:1"},
      {"SERIES;CONTACTS Xa 0;END", "RP051 11:1 `SERIES` stands in"},
      {"PARALLEL;COIL Yq 0 0 0;CONTACTS Xa 0;END;COIL Yr 0 0 0", "RP088"},
      {"PLACEHOLDER;COIL Yq 0 0 0", "RP051"},
      {"END;FOO", "RP051 12:1 expected `RUNG` and found `FOO`"},
  };
  for (const Refused& row : table) {
    const DeclaredText text("ldmicro", program_of(row.body));
    EXPECT_NE(text.problems().find(row.problem), std::string::npos)
        << row.body << "\n"
        << text.problems();
    EXPECT_TRUE(text.list.has_errors()) << row.body;
  }
}

TEST(LdmicroReader, RefusesHeads) {
  const std::vector<Refused> table = {
      {"", "RP051"},
      {"LDmicro0.3\nPROGRAM\n", "RP051 1:1 the header `LDmicro0.3`"},
      {"LDmicro0.1\n", "RP051 2:1 expected `PROGRAM`"},
      {"LDmicro0.1\nFOO=1\nPROGRAM\n", "RP051 2:1"},
      {"LDmicro0.1\nCYCLE=1500\nPROGRAM\n", "RP053 2:1 the cycle time"},
      {"LDmicro0.1\nCYCLE=0\nPROGRAM\n", "RP053"},
      {"LDmicro0.1\nCYCLE=\nPROGRAM\n", "RP053"},
      {"LDmicro0.1\nCYCLE=10 ms\nPROGRAM\n", "RP053"},
      {"LDmicro0.1\nCYCLE=99999999999999999999\nPROGRAM\n", "RP053"},
      {"LDmicro0.1\nIO LIST\nXa\nEND\nPROGRAM\n", "RP051 3:1"},
      {"LDmicro0.1\nIO LIST\nXa at x\nEND\nPROGRAM\n", "RP051 3:1"},
      {"LDmicro0.1\nIO LIST\nXa at 1\nXa at 2\nEND\nPROGRAM\n", "RP052 4:1"},
      {"LDmicro0.1\nIO LIST\nXa at 1\n", "RP051 2:1 `IO LIST` has no `END`"},
      {"LDmicro0.1\nVAR LIST\n9 bytes a\nEND\nPROGRAM\n", "RP051 3:1"},
      {"LDmicro0.1\nVAR LIST\na\nEND\nPROGRAM\n", "RP051 3:1"},
      {"LDmicro0.1\nVAR LIST\n1 bytes a\n2 bytes a\nEND\nPROGRAM\n",
       "RP052 4:9"},
      {"LDmicro0.1\nVAR LIST\n4 bytes a\nEND\nPROGRAM\nRUNG\nMOVE a 1\nEND\n",
       "RP087 7:6 a variable of 4 bytes"},
      {"LDmicro0.1\nVAR LIST\n1 bytes Ta\nEND\nPROGRAM\nRUNG\nTON Ta "
       "9000000\nEND\n",
       "RP053 7:1"},
      {"LDmicro0.1\nPROGRAM\nRUNG x\nEND\n", "RP051 3:1"},
      {"LDmicro0.1\nPROGRAM\nRUNG\n", "RP051 3:1 this has no `END`"},
      {"LDmicro0.1\nPROGRAM\n\x01", "RP001"},
  };
  for (const Refused& row : table) {
    const DeclaredText text("ldmicro", std::string(row.body));
    EXPECT_NE(text.problems().find(row.problem), std::string::npos)
        << row.body << "\n"
        << text.problems();
  }
}

TEST(LdmicroReader, HeadersChooseThePreset) {
  const std::string body = "\nPROGRAM\nRUNG\nTON Ta 50000\nEND\n";
  for (const auto& [head, preset, scans] :
       {std::tuple{"LDmicro0.1", "ldmicro0.1", "40"},
        std::tuple{"LDmicro0.2", "ldmicro0.2", "50"},
        std::tuple{"LDmicro", "ldmicro0.2", "50"}}) {
    const DeclaredText text("ldmicro", head + body);
    EXPECT_EQ(text.ast.semantics, preset);
    EXPECT_EQ(text.rungs(), std::string("power.1=(TON true 0 ") + scans + ")");
    EXPECT_EQ(recognise(head + body).name, "ldmicro");
  }
  ReadOptions options;
  options.semantics = find_semantics("ldmicro0.2");
  const DeclaredText text("ldmicro", "LDmicro0.1" + body, options);
  EXPECT_EQ(text.ast.semantics, "ldmicro0.2");
  EXPECT_EQ(text.rungs(), "power.1=(TON true 0 50)");
}

TEST(LdmicroReader, InputsCanBeStable) {
  ReadOptions options;
  options.stable_inputs = true;
  const DeclaredText text(
      "ldmicro", program_of("CONTACTS Xa 0;CONTACTS Xa 1;COIL Yq 0 0 0"),
      options);
  EXPECT_EQ(text.rungs(), "Yq=(&& Xa (! Xa))");
}

TEST(LdmicroReader, PropertyLinesStandInComments) {
  const DeclaredText text("ldmicro",
                          "LDmicro0.1\nPROGRAM\nRUNG\nCOMMENT text\\r\\n@ "
                          "never Yq\\r\\n//@ reach Yr\n ;@ scan 1..2 ms\n"
                          "END\n");
  ASSERT_EQ(text.ast.annotations.size(), 3U);
  EXPECT_EQ(text.ast.annotations[0].text, "never Yq");
  EXPECT_EQ(text.ast.annotations[1].text, "reach Yr");
  EXPECT_EQ(text.sources.text(text.ast.annotations[2].where), "scan 1..2 ms");
}

struct Behaviour {
  std::string_view body;
  std::string_view stimulus;
  std::string_view watch;
  std::string_view expected;
};

// What intcode.cpp of LDmicro does, scan by scan.
TEST(LdmicroReader, RunsAsTheToolDoes) {
  const std::vector<Behaviour> table = {
      // P = 2: two executions count, the third one is true.
      {"CONTACTS Xa 0;TON Ta 20000 0;COIL Yq 0 0 0", "Xa=1;;;;Xa=0;Xa=1;", "Yq",
       "0 0 1 1 0 0 0"},
      {"CONTACTS Xa 0;TOF Ta 20000 0;COIL Yq 0 0 0", ";Xa=1;Xa=0;;;", "Yq",
       "0 1 1 1 0 0"},
      {"CONTACTS Xa 0;RTO Ta 20000 0;COIL Yq 0 0 0", "Xa=1;Xa=0;;Xa=1;;Xa=0",
       "Yq", "0 0 0 0 1 1"},
      // The same timers where the program looks at the count.
      {"CONTACTS Xa 0;TON Ta 20000 0;COIL Yq 0 0 0|MOVE n Ta",
       "Xa=1;;;;Xa=0;Xa=1;", "Yq n", "0,1 0,2 1,2 1,2 0,0 0,1 0,2"},
      {"CONTACTS Xa 0;TOF Ta 20000 0;COIL Yq 0 0 0|MOVE n Ta", ";Xa=1;Xa=0;;;",
       "Yq n", "0,2 1,0 1,1 1,2 0,2 0,2"},
      {"CONTACTS Xa 0;RTO Ta 20000 0;COIL Yq 0 0 0|MOVE n Ta",
       "Xa=1;Xa=0;;Xa=1;;Xa=0", "Yq n", "0,1 0,1 0,1 0,2 1,2 1,2"},
      // RES arms an off-delay timer.
      {"CONTACTS Xa 0;TOF Ta 20000 0;COIL Yq 0 0 0|CONTACTS Xb 0;RES Ta",
       "Xb=1;Xb=0;;;", "Yq", "0 1 1 0 0"},
      {"CONTACTS Xa 0;TOF Ta 20000 0;COIL Yq 0 0 0|CONTACTS Xb 0;RES Ta|MOVE n "
       "Ta",
       "Xb=1;Xb=0;;;", "Yq n", "0,0 1,1 1,2 0,2 0,2"},
      {"CONTACTS Xa 0;TON Ta 20000 0;COIL Yq 0 0 0|CONTACTS Xb 0;RES Ta",
       "Xa=1;;;Xb=1;Xb=0;;", "Yq", "0 0 1 1 0 0 1"},
      {"CONTACTS Xa 0;RTO Ta 20000 0;COIL Yq 0 0 0|CONTACTS Xb 0;RES Ta",
       "Xa=1;;;Xb=1;Xb=0;;", "Yq", "0 0 1 1 0 0 1"},
      {"CONTACTS Xa 0;CTU Ca 2;COIL Yq 0 0 0|CONTACTS Xb 0;RES Ca",
       "Xa=1;;Xa=0;Xa=1;Xa=0;Xa=1;Xb=1", "Ca Yq",
       "1,0 1,0 1,0 2,1 2,1 2,1 0,1"},
      // CTD is true until it has counted down.
      {"CONTACTS Xa 0;CTD Ca 0 2;COIL Yq 0 0 0", "Xa=0;Xa=1;Xa=0;Xa=1;Xa=0",
       "Ca Yq", "2,1 1,1 1,1 0,0 0,0"},
      // CTC has a count more than its limit, and a pulse when it goes round.
      {"CONTACTS Xa 0;CTC Ca 2 0 -;COIL Yq 0 0 0", "Xa=1;;;;Xa=0", "Ca Yq",
       "1,0 2,0 0,1 1,0 1,0"},
      {"CONTACTS Xa 0;CTC Ca 1 0 o;COIL Yq 0 0 0", "Xa=1;Xa=0;;", "Ca Yq",
       "0,0 1,0 0,1 1,0"},
      {"CONTACTS Xa 0;CTR Ca -1 1 -;COIL Yq 0 0 0", "Xa=1;;;", "Ca Yq",
       "0,0 -1,0 1,1 0,0"},
      {"CONTACTS Xa 0;OSL;COIL Yq 0 0 0", ";Xa=1;Xa=0;;;Xa=1", "Yq",
       "0 1 0 1 1 1"},
      {"CONTACTS Xa 0;OSC;COIL Yq 0 0 0", "Xa=1;;;Xa=0;Xa=1", "Yq",
       "1 0 1 0 1"},
      {"CONTACTS Xa 0;COIL Yq 0 0 0 1", "Xa=1;;Xa=0;Xa=1", "Yq", "1 1 1 0"},
      {"CONTACTS Xa 0;MASTER_RELAY|CONTACTS Xb 0;MASTER_RELAY|COIL Yq 0 0 0",
       "Xa=0 Xb=0;Xa=1;Xb=1", "Yq", "1 0 1"},
      {"ADD a a 32767;MUL b a a", ";", "a b", "32767,1 -2,4"},
      {"SUB a a 7;DIV b a 2;MOD c a 2", ";", "a b c", "-7,-3,-1 -14,-7,0"},
  };
  for (const Behaviour& row : table) {
    const DeclaredText text("ldmicro", program_of(row.body));
    ASSERT_FALSE(text.list.has_errors()) << row.body << "\n" << text.problems();
    EXPECT_EQ(text.run(row.stimulus, row.watch), row.expected) << row.body;
  }
}

TEST(LdmicroReader, ByteVariablesWrapAtEightBits) {
  const DeclaredText text(
      "ldmicro", program_of("ADD a a 100;MOVE b a",
                            "LDmicro0.2\nVAR LIST\n1 bytes a\nb signed "
                            "16 bit variable\nEND\nPROGRAM\n"));
  ASSERT_FALSE(text.list.has_errors()) << text.problems();
  EXPECT_EQ(text.run(";;", "a b"), "100,100 -56,-56 44,44");
}

// Deep branches cost no stack, and the result is linear in the text.
TEST(LdmicroReader, IsLinear) {
  std::string body;
  const int depth = 3000;
  for (int i = 0; i < depth; ++i) {
    body += "PARALLEL\nCONTACTS Ra 0\nSERIES\nTON T" + std::to_string(i) +
            " 50000\nPARALLEL\nCONTACTS Rb 0\nSERIES\nCONTACTS Rc 1\n";
  }
  for (int i = 0; i < depth; ++i) body += "END\nEND\nEND\nEND\n";
  const DeclaredText text("ldmicro", program_of(body + "COIL Yq 0 0 0"));
  EXPECT_FALSE(text.list.has_errors());
  EXPECT_LT(text.ast.nodes.size(), 40U * depth);
}

// Every file of the collection is read, or refused for the reason given here.
TEST(LdmicroReader, ReadsTheCorpus) {
  const std::string root = RUNG_SOURCE_DIR "/../shared/corpus/ldmicro_ld";
  if (!std::filesystem::exists(root)) GTEST_SKIP() << "no " << root;
  const std::map<std::string, std::string_view> refused = {
      {"test-i2c-2.ld", "`I2C_RD`"},
      {"test-i2c-lcd16x2.ld", "not UTF-8"},
      {"test-uart.ld", "`FORMATTED_STRING`"},
      {"c_demo.ld", "`PERSIST`"},
      {"frmt_escape.ld", "`FORMATTED_STRING`"},
      {"swatch1.ld", "`FORMATTED_STRING`"},
      {"swatch2.ld", "`ROL`"},
  };
  int read = 0;
  int all = 0;
  for (const auto& entry :
       std::filesystem::recursive_directory_iterator(root)) {
    if (entry.path().extension() != ".ld") continue;
    std::ifstream in(entry.path(), std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(in), {}};
    EXPECT_EQ(recognise(bytes).name, "ldmicro");
    const DeclaredText text("ldmicro", bytes);
    const auto reason = refused.find(entry.path().filename().string());
    EXPECT_EQ(text.list.has_errors(), reason != refused.end())
        << entry.path() << "\n"
        << text.problems();
    if (reason != refused.end()) {
      EXPECT_NE(text.problems().find(reason->second), std::string::npos)
          << text.problems();
    }
    ++all;
    read += text.list.has_errors() ? 0 : 1;
  }
  EXPECT_EQ(all, 16);
  EXPECT_EQ(read, 9);
}

}  // namespace
}  // namespace rung::test
