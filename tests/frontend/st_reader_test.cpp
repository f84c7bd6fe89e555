#include <gtest/gtest.h>

#include <string>
#include <string_view>
#include <vector>

#include "declared_text.h"
#include "frontend/recognise.h"

namespace rung::test {
namespace {

constexpr std::string_view kHead =
    "FUNCTION_BLOCK twice VAR_INPUT x : BOOL; END_VAR VAR_OUTPUT y : BOOL; "
    "END_VAR VAR old : BOOL; END_VAR y := x AND old; old := x; "
    "END_FUNCTION_BLOCK\n"
    "FUNCTION inc : INT VAR_INPUT v : INT; END_VAR inc := v + 1; "
    "END_FUNCTION\n"
    "PROGRAM p VAR_INPUT a, b, c : BOOL; n, k : INT; d : DINT; u : USINT; "
    "END_VAR VAR_OUTPUT q, o : BOOL; w : INT; e : DINT; s : USINT; END_VAR "
    "VAR t : TON; r : R_TRIG; f : twice; time : TIME := T#2s; x : REAL; "
    "i : INT; END_VAR VAR CONSTANT seven : INT := 7; END_VAR\n";

std::string whole(std::string_view body) {
  return std::string(kHead) + std::string(body) + "\nEND_PROGRAM\n";
}

struct Row {
  std::string_view body;
  std::string_view expected;
};

TEST(StReader, ReadsStatements) {
  const std::vector<Row> table = {
      {"", ""},
      {";;", ""},
      {"q := a;", "q=a"},
      {"Q := A AND (* and *) NOT b // end\n;", "q=(&& a (! b))"},
      // Precedence, weakest last.
      {"q := a OR b XOR c AND NOT a;", "q=(|| a (^ b (&& c (! a))))"},
      {"q := a = b AND c;", "q=(&& (! (^ a b)) c)"},
      {"q := n < k = a;", "q=(! (^ (< n k) a))"},
      {"w := n + k * 2 - -3;",
       "w=(wrap16 (- (wrap16 (+ n (wrap16 (* k 2)))) -3))"},
      {"q := NOT a = b;", "q=(! (^ (! a) b))"},
      {"q := (a OR b) & c;", "q=(&& (|| a b) c)"},
      {"w := n MOD 10;", "w=(wrap16 (- n (* (/ n 10) 10)))"},
      {"w := -n;", "w=(wrap16 (- 0 n))"},
      {"w := 16#10 + 2#101;", "w=21"},
      {"q := n >= seven;", "q=(>= n 7)"},
      {"w := INT#5;", "w=5"},
      {"q := BOOL#1; o := 0;", "q=true | o=false"},
      // Integers of two types meet in the larger one.
      {"e := d + n;", "e=(wrap32 (+ d n))"},
      {"e := n;", "e=n"},
      {"s := u + 1;", "s=(wrap_u8 (+ u 1))"},
      {"q := u < n;", "q=(< u n)"},
      // IF and CASE.
      {"IF a THEN q := b; END_IF;",
       "run.1=a | q=(|| (&& run.1 b) (&& (! run.1) q))"},
      {"IF a THEN q := b; ELSIF c THEN q := o; ELSE o := c; END_IF;",
       "run.1=a | q=(|| (&& run.1 b) (&& (! run.1) q)) | run.2=(! run.1) | "
       "run.3=(&& run.2 c) | q=(|| (&& run.3 o) (&& (! run.3) q)) | "
       "run.4=(&& run.2 (! run.3)) | o=(|| (&& run.4 c) (&& (! run.4) o))"},
      {"CASE n OF 1: q := a; 2, 4..6: q := b; ELSE w := 0; END_CASE",
       "case.1=n | run.2=(== case.1 1) | q=(|| (&& run.2 a) (&& (! run.2) q)) "
       "| run.3=(! run.2) | run.4=(&& run.3 (|| (== case.1 2) (&& (>= case.1 "
       "4) (<= case.1 6)))) | q=(|| (&& run.4 b) (&& (! run.4) q)) | "
       "run.5=(&& run.3 (! run.4)) | w=(+ (* (to_word run.5) 0) (* (to_word "
       "(! run.5)) w))"},
      // RETURN holds behind the IF that it stands in.
      {"IF a THEN RETURN; END_IF; q := b;",
       "run.1=a | gone.2=run.1 | run.3=false | run.4=(! gone.2) | "
       "q=(|| (&& run.4 b) (&& (! run.4) q))"},
      {"FOR i := 1 TO 3 BY 2 DO w := w + i; END_FOR;",
       "i=1 | w=(wrap16 (+ w i)) | i=3 | w=(wrap16 (+ w i)) | i=5"},
      {"FOR i := 3 TO 1 DO FOR i := 1 TO 2 DO END_FOR END_FOR; q := a;",
       "i=3 | q=a"},
      // Calls.
      {"t(IN := a, PT := T#1s, Q => q);",
       "t.IN=a | t.Q=(TON t.IN 0 1000) | q=t.Q"},
      {"t(a, time);", "t.IN=a | t.Q=(TON t.IN 0 2000)"},
      {"r(CLK := a AND b); q := r.Q;",
       "r.CLK=(&& a b) | r.Q=(R_TRIG r.CLK 1) | q=r.Q"},
      {"r(CLK := a, NOT Q => q);",
       "r.CLK=a | r.Q=(R_TRIG r.CLK 1) | q=(! r.Q)"},
      {"f(x := a); q := f.y;",
       "f.x=a | f.y=(&& f.x f.old) | f.old=f.x | q=f.y"},
      {"w := inc(n);",
       "inc.1.v=0 | inc.1.inc=0 | inc.1.v=n | inc.1.inc=(wrap16 (+ inc.1.v 1)) "
       "| "
       "w=inc.1.inc"},
      {"q := AND(a, b, NOT c);", "q=(&& (&& a b) (! c))"},
      {"q := GT(n, k, 0);", "q=(&& (> n k) (> k 0))"},
      {"q := SEL(a, b, c);", "q=(|| (&& a c) (&& (! a) b))"},
      {"w := DINT_TO_INT(d); q := INT_TO_BOOL(n);",
       "w=(wrap16 d) | q=(!= n 0)"},
      {"q := GE(EN := TRUE, IN1 := n, IN2 := k, ENO => o);",
       "o=true | q=(>= n k)"},
      {"q := GE(EN := a, IN1 := n, IN2 := k);",
       "q=(|| (&& a (>= n k)) (&& (! a) false))"},
      {"f(EN := a, x := b); q := f.ENO;",
       "f.x=b | f.EN=a | f.ENO=f.EN | run.1=f.EN | "
       "f.y=(|| (&& run.1 (&& f.x f.old)) (&& (! run.1) f.y)) | "
       "f.old=(|| (&& run.1 f.x) (&& (! run.1) f.old)) | q=f.ENO"},
  };
  for (const Row& row : table) {
    const DeclaredText text("st", whole(row.body));
    EXPECT_EQ(text.problems(), "") << row.body;
    EXPECT_EQ(text.rungs(), row.expected) << row.body;
  }
}

TEST(StReader, RefusesStatements) {
  const std::vector<Row> table = {
      {"q := a", "RP047 4:7 expected `;`"},
      {"q = a;", "RP047 4:3 expected `:=`"},
      {"q := ;", "RP047 4:6 expected an operand"},
      {"q := a b;", "RP047 4:8 expected `;`"},
      {"q := (a;", "RP047 4:8 expected `)`"},
      {"q := a);", "RP047 4:7"},
      {"q := a AND;", "RP047 4:11"},
      {"q := zz;", "RP041 4:6 `zz` is not declared"},
      {"zz := a;", "RP041 4:1"},
      {"a := b;", "RP044 4:1 `a` is an input"},
      {"seven := 1;", "RP044 4:1 `seven` is a constant"},
      {"q := n;", "RP049 4:1 a BOOL is expected here, and this is a INT"},
      {"w := a;", "RP049"},
      {"w := d;", "RP049 4:1 a INT is expected"},
      {"w := 40000;", "RP043 4:6 40000 is not in the range of INT"},
      {"s := u + n;", "RP049"},
      {"q := a < b;", "RP049 4:8 LT of two BOOL"},
      {"q := a AND n;", "RP049"},
      {"w := n AND k;", "RP049 4:8 AND of two INT"},
      {"w := n / k;", "RP049 4:8 DIV takes a constant divisor"},
      {"w := n / 0;", "RP049"},
      {"w := n MOD 0;", "RP049"},
      {"w := n ** 2;", "RP041 4:8 `**`"},
      {"w := 1.5;", "RP041 4:6 `1.5`: REAL"},
      {"q := 'a';", "RP041"},
      {"x := 1;", "RP041 4:1 the type `REAL` of this variable"},
      {"q := x > 0;", "RP041 4:6 the type `REAL`"},
      {"WHILE a DO q := b; a := q; END_WHILE;",
       "RP041 4:1 `WHILE` is not supported"},
      {"WHILE a DO q := b; END_WHILE;",
       "RP100 4:1 nothing in this WHILE changes its condition: a scan"},
      {"WHILE (n < 4) AND NOT (a) DO q := b; i := 1; END_WHILE;", "RP100"},
      {"WHILE TRUE DO IF a THEN q := b; END_IF; END_WHILE;", "RP100"},
      {"WHILE n < 4 DO WHILE a DO n := n + 1; END_WHILE; END_WHILE;",
       "RP041 4:1 `WHILE`"},
      {"WHILE n < 4 DO WHILE a DO i := 1; END_WHILE; END_WHILE;", "RP100 4:1"},
      {"WHILE n < 4 DO FOR N := 1 TO 3 DO q := b; END_FOR; END_WHILE;",
       "RP041"},
      {"WHILE a DO t(IN := b); END_WHILE;", "RP041"},  // a call may do it
      {"WHILE t.Q DO f(x => q); END_WHILE;", "RP041"},
      {"WHILE a DO EXIT; END_WHILE;", "RP041"},
      {"WHILE a DO q := b;", "RP041"},  // no end
      {"WHILE a", "RP041"},
      {"REPEAT a := b; UNTIL a END_REPEAT;", "RP041 4:1 `REPEAT`"},
      {"REPEAT q := b; UNTIL a END_REPEAT;",
       "RP100 4:1 nothing in this REPEAT changes its condition: its first"},
      {"FOR i := 1 TO n DO q := a; END_FOR;", "RP041 4:15 the end of a FOR"},
      {"FOR i := 1 TO 3 BY 0 DO END_FOR;", "RP049"},
      {"FOR i := 1 TO 5000 DO END_FOR;", "RP050 4:1 a FOR of more than 1000"},
      {"FOR i := 1 TO 3 DO i := 1; END_FOR;",
       "RP044 4:20 `i` is the variable of a FOR"},
      {"FOR i := 1 TO 3 DO q := a;", "RP047 4:1 this has no END_FOR"},
      {"IF a THEN q := b;", "RP047 4:1 this has no END_IF"},
      {"IF n THEN q := b; END_IF;", "RP049 4:4 the condition of IF"},
      {"IF a q := b; END_IF;", "RP047"},
      {"END_IF;", "RP047 4:1 this ends no IF"},
      {"ELSE q := a;", "RP047 4:1 ELSE belongs"},
      {"IF a THEN ELSE ELSIF b THEN END_IF;", "RP047 4:16 ELSIF behind ELSE"},
      {"IF a THEN q := b; END_CASE;", "RP047 4:19"},
      {"CASE a OF 1: q := b; END_CASE;", "RP049 4:6 the selector"},
      {"CASE n OF q := b; END_CASE;", "RP047 4:11 expected a label"},
      {"CASE n OF k: q := b; END_CASE;", "RP049 4:11 a label of CASE"},
      {"CASE n OF 70000: q := b; END_CASE;", "RP043"},
      {"{x}", "RP041 4:1 a pragma"},
      {"t(IN := a);", "RP045 4:1 `t` has no PT"},
      {"t(IN := a, PT := time); time := T#3s;", "RP045 4:12 PT must be"},
      {"t(IN := a, XX := b);", "RP049 4:12 a TON has no input `XX`"},
      {"t(IN := a, IN := b);", "RP049 4:12 `IN` is given a second time"},
      {"t(a, T#1s, q, time, b);", "RP049"},
      {"t(IN := a, Q := q);", "RP049"},
      {"q := t;", "RP049 4:6 `t` is a function block"},
      {"q := t.X;", "RP049"},
      {"q := f.old;", "RP049 4:6 `old` is no input and no output"},
      {"q := a.b;", "RP049"},
      {"f.y := a;", "RP049 4:1 `f.y` is an output"},
      {"t(IN := a, PT := T#1s, Q => f.y);", "RP049"},
      {"q(a);", "RP049 4:1 `q` is no function block"},
      {"q := nothing(a);", "RP041 4:6 there is no function `nothing`"},
      {"w := inc(a);", "RP049"},
      {"w := inc(n, k);", "RP049"},
      {"q := a AND GE(IN1 := n, IN2 := k, ENO => o);",
       "RP049 4:12 `GE` has outputs"},
      {"w := LIMIT(1, n);", "RP049 4:6 `LIMIT` is given the wrong number"},
      {"f();\nf(EN := a);", "RP049 5:1 EN is given here and not"},
  };
  for (const Row& row : table) {
    const DeclaredText text("st", whole(row.body));
    EXPECT_NE(text.problems().find(row.expected), std::string::npos)
        << row.body << "\n"
        << text.problems();
  }
}

TEST(StReader, RefusesFiles) {
  const std::vector<Row> table = {
      {"PROGRAM p\nq := a;\n", "RP042 1:1 this has no END_PROGRAM"},
      {"PROGRAM p\nEND_PROGRAM\nPROGRAM q\nEND_PROGRAM", "RP041 3:9 which"},
      {"PROGRAM p\nEND_PROGRAM\nq := a;", "RP042 3:1"},
      {"FUNCTION f\nEND_FUNCTION", "RP042 2:1 expected `:`"},
      {"PROGRAM p VAR a : STRING(20); END_VAR a := a; END_PROGRAM",
       "the type `STRING(20)`"},
      {"PROGRAM p VAR a : ARRAY [0..1] OF INT; END_VAR a := 1; END_PROGRAM",
       "the type `ARRAY"},
      {"PROGRAM p VAR RETAIN a : BOOL; END_VAR END_PROGRAM", "RP041"},
      {"PROGRAM p VAR IF : BOOL; END_VAR END_PROGRAM", "RP042"},
      {"PROGRAM p VAR t : TON := (PT := T#1s); END_VAR END_PROGRAM", "RP041"},
      {"FUNCTION_BLOCK f VAR g : f; END_VAR g(); END_FUNCTION_BLOCK\n"
       "PROGRAM p VAR g : f; END_VAR g(); END_PROGRAM",
       "RP050 1:22 `f` contains itself"},
      {"FUNCTION f : INT f := g(); END_FUNCTION\n"
       "FUNCTION g : INT g := f(); END_FUNCTION\nPROGRAM p VAR i : INT; "
       "END_VAR i := f(); END_PROGRAM",
       "RP050"},
      {"PROGRAM p END_PROGRAM CONFIGURATION c\nPROGRAM i : x; "
       "END_CONFIGURATION",
       "RP041 2:9 there is no program `x`"},
      {"PROGRAM p END_PROGRAM CONFIGURATION c PROGRAM i : p; PROGRAM j : p; "
       "END_CONFIGURATION",
       "the configuration has 2 programs: name one of the units `p`"},
      {"PROGRAM p END_PROGRAM CONFIGURATION c TASK t(INTERVAL := 5);"
       "END_CONFIGURATION",
       "RP043"},
      {"{#include \"x\"}\nPROGRAM p END_PROGRAM", "RP041 1:1 an include"},
      {"PROGRAM p VAR_EXTERNAL g : BOOL; END_VAR g := TRUE; END_PROGRAM",
       "RP041"},
  };
  for (const Row& row : table) {
    const DeclaredText text("st", std::string(row.body));
    EXPECT_NE(text.problems().find(row.expected), std::string::npos)
        << row.body << "\n"
        << text.problems();
  }
}

TEST(StReader, ConfigurationsNameTheProgramAndItsScan) {
  const std::string units =
      "PROGRAM p VAR_OUTPUT q : BOOL; END_VAR q := TRUE; END_PROGRAM\n"
      "PROGRAM r VAR_OUTPUT o : BOOL; END_VAR o := TRUE; END_PROGRAM\n";
  const DeclaredText one("st", units +
                                   "CONFIGURATION c RESOURCE x ON y TASK "
                                   "t(INTERVAL := T#20ms, PRIORITY := 0); "
                                   "PROGRAM i WITH t : r; END_RESOURCE "
                                   "END_CONFIGURATION");
  EXPECT_EQ(one.problems(), "");
  EXPECT_EQ(one.rungs(), "o=true");
  EXPECT_EQ(one.ast.scan_min_ms, 20);
  EXPECT_EQ(one.ast.scan_max_ms, 20);
  ReadOptions options;
  options.pou = "P";
  EXPECT_EQ(DeclaredText("st", units, options).rungs(), "q=true");
  options.pou = "x";
  EXPECT_NE(DeclaredText("st", units, options)
                .problems()
                .find("there is no unit `x`: there are `p`, `r`"),
            std::string::npos);
}

TEST(StReader, GlobalsAndInOut) {
  const DeclaredText text(
      "st",
      "FUNCTION_BLOCK add VAR_IN_OUT sum : INT; END_VAR sum := sum + 1; "
      "END_FUNCTION_BLOCK\n"
      "PROGRAM p VAR_EXTERNAL g : INT; END_VAR VAR a : add; END_VAR "
      "a(sum := g); a(sum := g); END_PROGRAM\n"
      "CONFIGURATION c VAR_GLOBAL g AT %QW0 : INT := 3; END_VAR PROGRAM i : p; "
      "END_CONFIGURATION");
  EXPECT_EQ(text.problems(), "");
  EXPECT_EQ(text.rungs(), "g=(wrap16 (+ g 1)) | g=(wrap16 (+ g 1))");
  EXPECT_EQ(text.run(";", "g"), "5 7");
}

TEST(StReader, WordsWrapAtTheirWidth) {
  const DeclaredText text(
      "st",
      "PROGRAM p VAR_INPUT d : DINT; u : UINT; END_VAR VAR_OUTPUT e : DINT; "
      "f : UDINT; s : SINT; b : USINT; w : UINT; m : INT; END_VAR\n"
      "e := d + d; f := DINT_TO_UDINT(d) + 1; s := DINT_TO_SINT(d); "
      "b := DINT_TO_USINT(d); w := u - 1; m := DINT_TO_INT(d) MOD 7; "
      "END_PROGRAM");
  ASSERT_EQ(text.problems(), "");
  EXPECT_EQ(text.run("d=2147483647 u=0; d=-1 u=1; d=200 u=7", "e f s b w m"),
            "-2,2147483648,-1,255,65535,-1 -2,0,-1,255,0,-1 "
            "400,201,-56,200,6,4");
}

TEST(StReader, ReturnLeavesTheBlockOnly) {
  const DeclaredText text(
      "st",
      "FUNCTION_BLOCK f VAR_INPUT x, y : BOOL; END_VAR VAR_OUTPUT n : INT; "
      "END_VAR n := 0; IF x THEN n := 1; IF y THEN RETURN; END_IF; n := 2; "
      "END_IF; n := n + 10; END_FUNCTION_BLOCK\n"
      "PROGRAM p VAR_INPUT x, y : BOOL; END_VAR VAR_OUTPUT n : INT; q : BOOL; "
      "END_VAR VAR b : f; END_VAR b(x := x, y := y, n => n); q := NOT q; "
      "END_PROGRAM");
  ASSERT_EQ(text.problems(), "");
  EXPECT_EQ(text.run("x=0 y=0; x=1 y=0; x=1 y=1; x=0 y=1", "n q"),
            "10,1 12,0 1,1 10,0");
}

TEST(StReader, FunctionsCompute) {
  const DeclaredText text(
      "st",
      "PROGRAM p VAR_INPUT n, k : INT; w : WORD; END_VAR VAR_OUTPUT a, b, c, "
      "d, "
      "e, f : INT; g : WORD; END_VAR a := ABS(n); b := LIMIT(-5, n, 5); "
      "c := MAX(n, k, 3); d := MIN(n, k); e := MUX(k, 10, 20, n); "
      "f := BCD_TO_INT(w); g := INT_TO_BCD(n); END_PROGRAM");
  ASSERT_EQ(text.problems(), "");
  EXPECT_EQ(text.run("n=-9 k=1 w=4660; n=1234 k=2 w=39321; n=2 k=7 w=0",
                     "a b c d e f"),
            "9,-5,3,-9,20,1234 1234,5,1234,2,1234,9999 2,2,7,2,0,0");
  EXPECT_EQ(text.run("n=1234; n=9", "g"), "4660 9");
}

TEST(StReader, GrowthIsBounded) {
  std::string text;
  text += "FUNCTION_BLOCK f0 END_FUNCTION_BLOCK\n";
  for (int i = 1; i < 45; ++i) {
    const std::string name = "f" + std::to_string(i);
    const std::string inner = "f" + std::to_string(i - 1);
    text += "FUNCTION_BLOCK " + name + " VAR a, b : " + inner +
            "; END_VAR a(); b(); END_FUNCTION_BLOCK\n";
  }
  text += "PROGRAM p VAR a : f44; END_VAR a(); END_PROGRAM\n";
  EXPECT_NE(DeclaredText("st", text).problems().find("RP050"),
            std::string::npos);
  std::string loops = "PROGRAM p VAR i, j, k : INT; END_VAR\n";
  for (const char* name : {"i", "j", "k"}) {
    loops += "FOR " + std::string(name) + " := 1 TO 1000 DO ";
  }
  loops += "END_FOR; END_FOR; END_FOR; END_PROGRAM";
  EXPECT_NE(DeclaredText("st", loops).problems().find("RP050"),
            std::string::npos);
  const std::string deep = "PROGRAM p VAR_OUTPUT q : BOOL; END_VAR q := " +
                           std::string(100000, '(') + "; END_PROGRAM";
  EXPECT_NE(DeclaredText("st", deep).problems().find("RP047"),
            std::string::npos);
}

TEST(StReader, IsRecognised) {
  for (const std::string_view text :
       {"PROGRAM p\nVAR a : BOOL; END_VAR\na := TRUE;\nEND_PROGRAM",
        "(* text *)\nfunction_block f\nend_function_block",
        "CONFIGURATION c END_CONFIGURATION",
        "TYPE t : INT; END_TYPE PROGRAM p LD := TRUE; END_PROGRAM"}) {
    EXPECT_EQ(recognise(text).name, "st") << text;
  }
  for (const std::string_view text :
       {"PROGRAM p\nLD a\nEND_PROGRAM", "TYPE = I0;", "Q0 = I0;", ""}) {
    EXPECT_NE(recognise(text).name, "st") << text;
  }
}

}  // namespace
}  // namespace rung::test
