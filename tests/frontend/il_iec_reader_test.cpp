#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "analysis/element.h"
#include "analysis/program.h"
#include "analysis/simulator.h"
#include "dump.h"
#include "frontend/iec/blocks.h"
#include "frontend/il_iec/reader.h"
#include "frontend/recognise.h"

namespace rung::test {
namespace {

constexpr std::string_view kHead =
    "PROGRAM p\n"
    "VAR_INPUT a, b, c : BOOL; n : INT; END_VAR\n"
    "VAR_OUTPUT q, o : BOOL; w : INT; END_VAR\n"
    "VAR m : BOOL := TRUE; t : TON; u : CTU; d : CTD; e : R_TRIG; f : SR;\n"
    "  l : RS; time : TIME; END_VAR\n"
    "VAR CONSTANT k : INT := 7; wait : TIME := T#2s; END_VAR\n";

struct Text {
  explicit Text(std::string text)
      : file(sources.add("list.il", std::move(text))),
        ast(read_il_iec(sources, file, {}, list)) {
    if (!list.has_errors()) program = build_program(ast, {}, list);
  }
  std::string rungs() const {
    std::string result;
    for (const AstAssignment& rung : ast.rungs) {
      result += (result.empty() ? "" : " | ") + std::string(rung.target) + "=" +
                dump(ast, rung.value);
    }
    return result;
  }
  std::string problems() const {
    std::string result;
    for (const Diagnostic& item : list.items()) {
      const LineColumn at = sources[file].position(item.where.begin);
      result += std::string(item.code) + " " + std::to_string(at.line) + ":" +
                std::to_string(at.column) + " " + item.message + "\n";
    }
    return result;
  }

  SourceSet sources;
  DiagnosticList list;
  FileId file;
  Ast ast;
  Program program;
};

std::string whole(std::string_view body) {
  return std::string(kHead) + std::string(body) + "\nEND_PROGRAM\n";
}

struct Accepted {
  std::string_view body;
  std::string_view rungs;
};

TEST(IlIecReader, ReadsInstructions) {
  const std::vector<Accepted> table = {
      {"", ""},
      {"LD a\nST q", "q=a"},
      {"ld A\n st Q", "q=a"},
      {"LDN a\nANDN b\nOR m\nST q", "q=(|| (&& (! a) (! b)) m)"},
      {"LD a\n& b\nXORN c\nSTN q", "q=(! (^ (&& a b) (! c)))"},
      {"LD a (* one *) // two\nST q ; three", "q=a"},
      {"LD a\nAND (* in it *) b\nST q", "q=(&& a b)"},
      {"LD TRUE\nNOT\nST q", "q=(! true)"},
      // Deferral, both ways to write it.
      {"LD a\nAND( b\nOR c\n)\nST q", "q=(&& a (|| b c))"},
      {"LD a\nAND(\nLD b\nOR c\n)\nST q", "q=(&& a (|| b c))"},
      {"LD a\nORN( b AND c )\nST q", "q=(|| a (! (&& b c)))"},
      {"LD a\nOR( b\nAND( c\nOR m\n)\n)\nST q", "q=(|| a (&& b (|| c m)))"},
      // The current result goes on, as it was.
      {"LD a\nST q\nAND b\nST o", "q=a | o=(&& q b)"},
      {"LD a\nSTN q\nST o", "q=(! a) | o=(! q)"},
      {"LD a\nS q", "q=(|| q a)"},
      {"LD a\nAND b\nR q", "q=(&& q (! (&& a b)))"},
      {"LD q\nR q\nST o", "kept.1=q | q=(&& q (! kept.1)) | o=kept.1"},
      {"LD a\nS q\nR o", "kept.1=a | q=(|| q kept.1) | o=(&& o (! kept.1))"},
      // Words.
      {"LD n\nADD -5\nST w", "w=(wrap16 (+ n -5))"},
      {"LD n\nDIV 2\nGT k\nST q", "q=(> (wrap16 (/ n 2)) 7)"},
      {"LD a\nEQ b\nST q", "q=(! (^ a b))"},
      {"LD a\nNE b\nST q", "q=(^ a b)"},
      // Blocks.
      {"CAL t(IN := a, PT := T#1s500ms)\nLD t.Q\nST q",
       "t.IN=a | t.Q=(TON t.IN 0 1500) | q=t.Q"},
      {"CAL t(a, wait)\nLD t.q\nST q",
       "t.IN=a | t.Q=(TON t.IN 0 2000) | q=t.Q"},
      {"CAL t(\n  IN := a,\n  PT := T#1s,\n  Q\n  => q)",
       "t.IN=a | t.Q=(TON t.IN 0 1000) | q=t.Q"},
      {"LD T#5s\nST t.PT\nLD a\nIN t", "t.IN=a | t.Q=(TON t.IN 0 5000)"},
      {"LD T#5s\nST t.PT\nCAL t", "t.Q=(TON t.IN 0 5000)"},
      {"LD a\nCU u\nLD u.CV\nST w",
       "u.CU=a | u.Q=(CTU u.CU u.R u.PV 1) | u.CV=(CTU.CV 1) | w=u.CV"},
      {"LD a\nLD d\nLD d.Q\nST q",
       "d.LD=a | d.Q=(CTD d.CD d.LD d.PV 2) | q=d.Q"},
      {"LD a\nS1 f\nLD b\nR f",
       "f.S1=a | f.Q1=(SR f.S1 f.R 4) | f.R=b | f.Q1=(SR f.S1 f.R 4)"},
      {"LD a\nS l", "l.S=a | l.Q1=(RS l.S l.R1 5)"},
      {"LD a\nCLK e\nLD e.Q\nST q", "e.CLK=a | e.Q=(R_TRIG e.CLK 3) | q=e.Q"},
      // Functions, and a preset that a variable gives.
      {"LD n\nMOD 3\nST w", "w=(wrap16 (- n (* (/ n 3) 3)))"},
      {"LD n\nMAX 3\nST w",
       "kept.1=(< n 3) | w=(+ (* (to_word kept.1) 3) (* (to_word (! kept.1)) "
       "n))"},
      {"SEL(G := a, IN0 := b, IN1 := c)\nST q", "q=(|| (&& a c) (&& (! a) b))"},
      {"CAL t(IN := a, PT := time)", "t.IN=a | t.Q=(TON t.IN 0 0)"},
      {"CAL e(EN := a, CLK := b, Q => q)",
       "e.CLK=b | e.EN=a | run.1=e.EN | e.Q=(|| (&& run.1 (R_TRIG e.CLK 3)) "
       "(&& (! run.1) e.Q)) | q=e.Q"},
      {"CAL e(a, q)", "e.CLK=a | e.Q=(R_TRIG e.CLK 3) | q=e.Q"},
      // Jumps guard what they skip.
      {"LD a\nJMPC on\nLD b\nST q\non: LD c\nST o",
       "run.1=(! a) | q=(|| (&& run.1 b) (&& (! run.1) q)) | o=c"},
      {"LD a\nJMPCN on\nLD n\nST w\non: LD c\nST o",
       "run.1=a | w=(+ (* (to_word run.1) n) (* (to_word (! run.1)) w)) | "
       "o=c"},
      {"LD a\nRETC\nLD b\nS q",
       "run.1=(! a) | q=(|| (&& run.1 (|| q b)) (&& (! run.1) q))"},
      {"LD a\nCALC e(CLK := b)\nLD c\nST o",
       "run.1=a | e.CLK=(|| (&& run.1 b) (&& (! run.1) e.CLK)) | "
       "e.Q=(|| (&& run.1 (R_TRIG e.CLK 3)) (&& (! run.1) e.Q)) | o=c"},
      {"LD a\nJMPC x\nLD b\nJMPC y\nx: LD c\nST q\ny: LD c\nST o",
       "run.1=(! a) | run.2=(&& run.1 (! b)) | run.3=(|| run.2 (! run.1)) | "
       "q=(|| (&& run.3 c) (&& (! run.3) q)) | o=c"},
  };
  for (const Accepted& row : table) {
    const Text text(whole(row.body));
    EXPECT_EQ(text.problems(), "") << row.body;
    EXPECT_EQ(text.rungs(), row.rungs) << row.body;
  }
}

struct Refused {
  std::string_view body;
  std::string_view problem;  // a part of the only error
};

TEST(IlIecReader, RefusesWithNameAndPlace) {
  const std::vector<Refused> table = {
      {"LOAD a", "RP040 7:1 `LOAD` is no operator"},
      {"LDX a", "(did you mean `LD`?)"},
      {"EQU a",
       "RP040 7:1 `EQU` is no operator of instruction lists, and no function "
       "that is supported (did you mean `EQ`?)"},
      {"LD n\nMOD k\nMOD n", "RP049 9:1 MOD takes a constant divisor"},
      {"LD x", "RP041 7:4 `x` is not declared"},
      {"LD tim", "(did you mean `time`?)"},
      {"LD a b", "RP047 7:6 expected the end of the line and found `b`"},
      {"LD", "RP047 7:3 expected an operand and found the end of the line"},
      {"LD a; AND b", "RP047 7:7 an instruction behind `;`"},
      {"LD a; ST q", "RP047 7:7 an instruction behind `;`"},
      {"LD ?", "RP047 7:4 expected an operand and found `?`"},
      {"LD 1.5", "RP043 7:4 `1.5`: REAL"},
      {"LD 16#fg", "RP043 7:4"},
      {"LD n\nADD 40000", "RP043 8:5 40000 is not in the range of INT"},
      {"LD -32769\nST w", "RP043 7:4"},
      {"LD T#5", "RP043 7:4 `T#5` is no time"},
      {"LD T#0.5ms", "RP043 7:4"},
      {"LD T#1s2h", "RP043 7:4"},
      {"LD T#-1s", "RP043 7:4"},
      {"LD T#60d", "RP043 7:4"},
      {"AND a", "RP048 7:1 there is no current result"},
      {"ST q", "RP048 7:1"},
      {"CAL e\nST q", "RP048 8:1"},
      {"LD a\nJMPC x\nx: ST q", "RP048 9:4"},
      {"LD n\nST q", "RP049 8:1 a BOOL is expected here, and this is a INT"},
      {"LD a\nADD 1", "RP049 8:1 ADD of two BOOL is not supported"},
      {"LD n\nAND n", "RP049 8:1 AND of two INT"},
      {"LD a\nGT b", "RP049 8:1"},
      {"LD n\nGT T#1s", "RP049 8:1"},
      {"LD time\nADD time", "RP049 8:1"},
      {"LD n\nDIV n", "RP049 8:1 DIV takes a constant divisor"},
      {"LD n\nDIV 0", "RP049 8:1"},
      {"LDN n", "RP049 7:1"},
      {"LD n\nNOT", "RP049 8:1"},
      {"LD n\nS q", "RP049 8:1"},
      {"LD a\nS w", "RP049 8:3"},
      {"LD a\nS", "RP047 8:2 `S` needs a variable"},
      {"LD b\nST a", "RP044 8:4 `a` is an input"},
      {"LD 1\nST k", "RP044 8:4 `k` is a constant"},
      {"LD b\nST TRUE", "RP047 8:4"},
      {"LD b\nST t.Q", "RP049 8:4 `t.Q` is an output"},
      {"LD b\nST t.X", "a TON has no `X`: it has IN PT Q ET"},
      {"LD t", "RP049 7:4 `t` is a function block: name an output of it"},
      {"LD f.Q", "RP049 7:4 a SR has no `Q`: it has S1 R Q1"},
      {"LD t.PT", "RP049 7:4 PT of a timer cannot be read"},
      {"CAL t", "RP045 7:1 `t` has no PT here"},
      {"LD a\nJMPC x\nLD T#1s\nST time\nx: CAL t(IN := a, PT := time)",
       "RP045 11:19 PT must be a TIME literal"},
      {"LD a\nCALC t(PT := T#1s)\nCAL t", "RP045 9:1"},
      {"CAL x", "RP041 7:5 `x` is not declared as a function block"},
      {"CAL e\nCAL e(EN := a)", "RP049 8:1 EN is given here and not in a call"},
      {"CAL t(IN := a, PT := T#1s, EN => q)", "no output `EN`"},
      {"CAL t(IN := n, PT := T#1s)", "RP049 7:7 a BOOL is expected here"},
      {"CAL t(IN := a", "RP047"},
      {"CAL t(IN := a IN := b)", "RP047 7:15 expected `,` or `)`"},
      {"CAL t(a, T#1s, q, time, b)", "has no more inputs: it has IN PT Q ET"},
      {"CAL t(IN := a, PT := T#1s, Q => w)", "RP049 7:28"},
      {"CAL t(IN := a, PT := T#1s, Q => b)", "RP044 7:28"},
      {"LD a\nCLK t", "RP049 8:1 a TON has no input `CLK`"},
      {"LD a\nCLK q", "RP049 8:1 `q` is no function block"},
      {"LD a\nCLK z", "RP041 8:5"},
      {"JMP x", "RP046 7:5 there is no label `x`"},
      {"JMP", "RP046 7:4 a jump needs a label"},
      {"x: LD a\nST q\nJMP x", "RP046 9:5 a jump back"},
      {"x: LD a\nST q\nx: LD b\nST o",
       "RP046 9:1 the label `x` stands here a "
       "second time"},
      {"LD n\nJMPC x\nx:", "RP049 8:1"},
      {"LD a\nAND( b\nST q\n)", "RP047 9:1 `ST` inside of parentheses"},
      {"LD a\nAND( b\nJMP x\n)\nx:", "RP047 9:1"},
      {"LD a\nAND( b\nx: OR c\n)", "RP046 9:1 a label inside"},
      {"LD a\nAND( b", "RP047 8:1 this parenthesis is not closed"},
      {"LD a\n)", "RP047 8:1 this parenthesis closes nothing"},
      {"LD a\nAND(\n)", "RP048 9:1"},
      {"LD %IX", "RP044"},
      {"LD %IX3", "RP044"},
      {"LD %IX0.00", "RP044"},
      {"LD %IX00.0", "RP044"},
      {"LD %IL0", "RP044 7:4 `%IL0` is no address"},
      {"LD %IX0.0\nST %QX0.0\nLD %QW0\nST w", "RP044 9:4 bits and words"},
      {"LD %QX0.0\nST %IX0.0", "RP044 8:4"},
      {"LD a (* open", "RP007"},
      {"LIMIT(IN := n)", "RP049 7:1 `LIMIT` is given the wrong number"},
      {"LD a\nq := a;", "RP040 8:1 `q`"},
  };
  for (const Refused& row : table) {
    const Text text(whole(row.body));
    EXPECT_NE(text.problems().find(row.problem), std::string::npos)
        << row.body << "\n"
        << text.problems();
    if (row.problem != "RP007") {
      EXPECT_EQ(text.list.items().size(), 1U) << row.body << "\n"
                                              << text.problems();
    }
  }
}

TEST(IlIecReader, RefusesDeclarations) {
  const std::vector<Refused> table = {
      {"VAR a BOOL; END_VAR", "RP042"},
      {"VAR a : ; END_VAR", "RP042"},
      {"VAR a : BOOL END_VAR", "RP042"},
      {"VAR a : BOOL;", "RP042 2:1 `VAR` has no END_VAR"},
      {"VAR a, A : BOOL; END_VAR", "RP042 2:8 `A` is declared a second time"},
      {"VAR IF : BOOL; END_VAR", "RP042 2:5 `IF` is a reserved word"},
      {"VAR a : REAL; END_VAR",
       "RP041 3:4 the type `REAL` of this variable is not supported"},
      {"VAR a : TOM; END_VAR", "(did you mean `TOF`?)"},
      {"VAR a : CMD_MONITOR; END_VAR", "RP041"},
      {"VAR a : BOOL := 2; END_VAR", "RP043 2:5 `2` is no initial value"},
      {"VAR a : INT := 40000; END_VAR", "RP043"},
      {"VAR a : TIME := 5; END_VAR", "RP043"},
      {"VAR a : TON := (PT := T#1s); END_VAR", "RP041"},
      {"VAR RETAIN a : BOOL; END_VAR", "RP041 2:12 `a` is RETAIN"},
      {"VAR_EXTERNAL a : BOOL; END_VAR", "the type `VAR_EXTERNAL`"},
      {"VAR_IN_OUT a : BOOL; END_VAR", "RP041"},
      {"VAR_INPUT a : TON; END_VAR", "RP041"},
      {"VAR_INPUT a : BOOL := TRUE; END_VAR", "RP043"},
      {"VAR a AT %IX0.0, b AT %I0.0 : BOOL; END_VAR", "RP044"},
      {"VAR a AT %IW0 : BOOL; END_VAR", "RP044"},
      {"VAR_OUTPUT a AT %IX0.0 : BOOL; END_VAR", "RP044"},
      {"VAR a AT x : BOOL; END_VAR", "RP042"},
  };
  for (const Refused& row : table) {
    const Text text("PROGRAM p\n" + std::string(row.body) +
                    "\nLD a\nEND_PROGRAM");
    EXPECT_NE(text.problems().find(row.problem), std::string::npos)
        << row.body << "\n"
        << text.problems();
  }
}

TEST(IlIecReader, RefusesFiles) {
  for (const std::string_view text :
       {"PROGRAM\nLD TRUE\nEND_PROGRAM", "PROGRAM p\nLD TRUE\n",
        "PROGRAM p\nEND_PROGRAM\nPROGRAM q\nEND_PROGRAM",
        "FUNCTION f\nLD 1\nST f\nEND_FUNCTION",
        "PROGRAM p\nEND_PROGRAM\nCONFIGURATION c\nx\nEND_CONFIGURATION",
        "LD S8.X\nST b", "LD a\nST b\nEND_PROGRAM", "LD a\x01\n"}) {
    EXPECT_TRUE(Text(std::string(text)).list.has_errors()) << text;
  }
}

TEST(IlIecReader, SaysAllErrorsInOneRun) {
  const Text text(whole("LD x\nST y\nLD a\nST z\nJMP nowhere"));
  EXPECT_EQ(text.list.items().size(), 4U) << text.problems();
}

TEST(IlIecReader, RolesTypesAndInitialValues) {
  const Text text(
      "PROGRAM p\nVAR a AT %IX0.0 : BOOL; b AT %Q1.2 : BOOL; c : INT := -3;\n"
      "END_VAR\nLD a\nST b\nLD c\nST %MW4\nEND_PROGRAM");
  ASSERT_EQ(text.problems(), "");
  const auto cell = [&](std::string_view name) -> const rung::Cell& {
    return text.program.cells[find_cell(text.program, name)];
  };
  EXPECT_EQ(cell("a").role, CellRole::Input);
  EXPECT_EQ(cell("b").role, CellRole::Output);
  EXPECT_EQ(cell("c").initial, -3);
  EXPECT_EQ(cell("c").low, -32768);
  EXPECT_EQ(cell("%MW4").role, CellRole::Memory);
}

TEST(IlIecReader, BareListsInferRoles) {
  const Text text("LD start\nOR motor\nANDN stop\nST motor\n");
  ASSERT_EQ(text.problems(), "");
  EXPECT_EQ(text.rungs(), "motor=(&& (|| start motor) (! stop))");
  for (const rung::Cell& cell : text.program.cells) {
    EXPECT_EQ(cell.role,
              cell.name == "motor" ? CellRole::Output : CellRole::Input);
  }
}

TEST(IlIecReader, PropertyLines) {
  const Text text(
      "(*@ language il-iec *)\n//@ never q\n(*@ reach\n r *)\nLD a\nST q\n");
  ASSERT_EQ(text.ast.annotations.size(), 2U);
  EXPECT_EQ(text.ast.annotations[0].text, "never q");
}

TEST(IlIecReader, BlocksAreTheElementsOfTheTables) {
  for (const iec::Block& block : iec::blocks()) {
    const FoundOperation found = find_operation("iec", block.name);
    ASSERT_NE(found.kind, nullptr) << block.name;
    EXPECT_EQ(found.kind->id, block.element);
    std::vector<std::string_view> inputs;
    for (const ElementParameter& it : found.operation->parameters) {
      if (it.kind != ParameterKind::Index) inputs.push_back(it.name);
    }
    ASSERT_EQ(inputs.size(), block.inputs.size()) << block.name;
    for (std::size_t i = 0; i < inputs.size(); ++i) {
      EXPECT_EQ(inputs[i], block.inputs[i].name);
    }
    for (const iec::Pin& pin : block.outputs.subspan(1)) {
      const std::string name =
          std::string(block.name) + "." + std::string(pin.name);
      const FoundOperation read = find_operation("iec", name);
      ASSERT_NE(read.operation, nullptr) << name;
      EXPECT_EQ(read.operation->word, pin.type != &iec::kBool) << name;
    }
  }
}

TEST(IlIecReader, SkippedCallsAndAssignmentsKeepTheirValues) {
  const Text text(
      "PROGRAM p\nVAR_INPUT skip, v : BOOL; END_VAR\n"
      "VAR_OUTPUT q : BOOL; w : INT; END_VAR\nVAR c : CTU; END_VAR\n"
      "LD skip\nJMPC over\nCAL c(CU := v, PV := 2)\nLD v\nST q\nLD c.CV\n"
      "ADD 10\nST w\nover:\nEND_PROGRAM");
  ASSERT_EQ(text.problems(), "");
  Simulator simulator(text.program);
  const auto run = [&](bool skip, bool v) {
    simulator.set_input(find_cell(text.program, "skip"), skip ? 1 : 0);
    simulator.set_input(find_cell(text.program, "v"), v ? 1 : 0);
    simulator.scan(10);
    return std::to_string(simulator.value(find_cell(text.program, "q"))) + " " +
           std::to_string(simulator.value(find_cell(text.program, "w")));
  };
  EXPECT_EQ(run(true, true), "0 0");
  EXPECT_EQ(run(false, true), "1 11");
  EXPECT_EQ(run(true, false), "1 11");  // the edge is not seen
  EXPECT_EQ(run(false, true), "1 11");  // so this is none
  EXPECT_EQ(run(false, false), "0 11");
  EXPECT_EQ(run(false, true), "1 12");
}

TEST(IlIecReader, IsRecognised) {
  for (const std::string_view text :
       {"LD start\nST motor", "ldn %IX0.0\nst %QX0.0",
        "(* a list *)\nPROGRAM p\nVAR a : BOOL; END_VAR\n LD a\n ST a\n"
        "END_PROGRAM",
        "FUNCTION_BLOCK f\nVAR a : BOOL; END_VAR\nagain: LD a\n"
        "END_FUNCTION_BLOCK",
        "CAL t(IN := a)", "(*@ language il-iec *)\nLD a"}) {
    EXPECT_EQ(recognise(text).name, "il-iec") << text;
  }
  for (const std::string_view text :
       {"PROGRAM p\nVAR a : BOOL; END_VAR\na := TRUE;\nEND_PROGRAM", "S = I0;",
        "R = I0", "LD X0\nOUT Y0", "Q0 = I0;", "", "IN == 1"}) {
    EXPECT_NE(recognise(text).name, "il-iec") << text;
  }
}

}  // namespace
}  // namespace rung::test
