#include <gtest/gtest.h>

#include <random>
#include <string>
#include <vector>

#include "sample.h"

namespace rung {
namespace {

struct Case {
  const char* line;
  const char* expected;
};

std::string shown(const Property& property) {
  std::string text = property.name + " =";
  for (const std::string& formula : property.formulas) {
    const bool absent = property.absent && &formula == &property.formulas[1];
    text += (absent ? " no {" : " {") + formula + "}";
  }
  if (property.milliseconds >= 0) {
    text += " " + std::to_string(property.milliseconds) + " ms";
  }
  if (property.scans >= 0) {
    text += " " + std::to_string(property.scans) + " scans";
  }
  if (property.dominant_set) text += " dominant set";
  return text;
}

class Accepted : public testing::TestWithParam<Case> {};

TEST_P(Accepted, IsRead) {
  const ReadLines read(GetParam().line);
  EXPECT_FALSE(read.found.has_errors()) << read.error();
  ASSERT_FALSE(read.set.properties.empty());
  EXPECT_EQ(shown(read.set.properties.front()), GetParam().expected);
}

INSTANTIATE_TEST_SUITE_P(
    Lines, Accepted,
    testing::Values(
        Case{"always Q0 -> !I1", "always@1 = {Q0 -> !I1}"},
        Case{"  a.b-c :  never  Q0 AND Q1  ", "a.b-c = {Q0 AND Q1}"},
        Case{"back: recoverable !Q0", "back = {!Q0}"},
        Case{"settles within 3 scans",
             "settles@1 = {Q0} {Q1} {Q2} {Q3} {Q4} {QW0} 3 scans"},
        Case{"eventually Q0", "eventually@1 = {Q0}"},
        Case{"e: eventually !Q0 given fair I0", "e = {!Q0} {I0}"},
        Case{"eventually once(Q0) given fair (I0 && !I1), rose(I2), !Q1",
             "eventually@1 = {once(Q0)} {(I0 && !I1)} {rose(I2)} {!Q1}"},
        Case{"calm: settles within 1 scan",
             "calm = {Q0} {Q1} {Q2} {Q3} {Q4} {QW0} 1 scans"},
        Case{"interlock Q0, Q1", "interlock@1 = {Q0} {Q1}"},
        Case{"interlock Q0, Q1 && (Q2 || I0), Q2 gap 1.5 s",
             "interlock@1 = {Q0} {Q1 && (Q2 || I0)} {Q2} 1500 ms"},
        Case{"latch Q0 set I0 reset I1", "latch@1 = {Q0} {I0} {I1}"},
        Case{"latch Q0 set I0 && I2 reset !I1 dominant set",
             "latch@1 = {Q0} {I0 && I2} {!I1} dominant set"},
        Case{"latch Q0 set I0 reset I1 dominant reset",
             "latch@1 = {Q0} {I0} {I1}"},
        Case{"reach T(0).q && !prev(T(0).q)",
             "reach@1 = {T(0).q && !prev(T(0).q)}"},
        Case{"after I0, Q1 within 3 scans", "after@1 = {I0} {Q1} 3 scans"},
        Case{"after I0, Q1 within 1 scan", "after@1 = {I0} {Q1} 1 scans"},
        Case{"after I0, Q1 within 0 ms", "after@1 = {I0} {Q1} 0 ms"},
        Case{"after I0, Q1 within 2 min", "after@1 = {I0} {Q1} 120000 ms"},
        Case{"after I0, no Q1 for 500 ms", "after@1 = {I0} no {Q1} 500 ms"},
        Case{"after I0, no Q1 for 2 scans", "after@1 = {I0} no {Q1} 2 scans"},
        Case{"after I0, no(Q1) for 1 s", "after@1 = {I0} no {(Q1)} 1000 ms"},
        Case{"after I0, Q1 within 500ms", "after@1 = {I0} {Q1} 500 ms"},
        Case{"I0 for 500 ms implies Q3", "for@1 = {I0} {Q3} 500 ms"},
        Case{"q: I0 for 0.5 s implies Q3 -> Q1", "q = {I0} {Q3 -> Q1} 500 ms"},
        Case{"Q0 only after I0", "only-after@1 = {Q0} {I0}"},
        Case{"p:Q0 only after I0", "p = {Q0} {I0}"},
        Case{"always IW0 + 2 * QW0 <= 10 <-> I0 ^ I1",
             "always@1 = {IW0 + 2 * QW0 <= 10 <-> I0 ^ I1}"},
        Case{"always prev(IW0) = QW0 OR I0",
             "always@1 = {prev(IW0) = QW0 OR I0}"},
        Case{"always C(0).value < 4", "always@1 = {C(0).value < 4}"},
        Case{"always begin(Q0 && IW0 > 3) -> once(Q0)",
             "always@1 = {begin(Q0 && IW0 > 3) -> once(Q0)}"},
        Case{"pattern pattern-implication(Q0; I0 && Q1)",
             "always@1 = {(Q0) -> (I0 && Q1)}"},
        Case{"pattern pattern-invariant(Q0)", "always@1 = {Q0}"},
        Case{"f: pattern pattern-forbidden(Q0 AND Q1)", "f = {Q0 AND Q1}"},
        Case{"pattern pattern-statechange-duringcycle(Q0; Q1)",
             "always@1 = {begin(Q0) -> (Q1)}"},
        Case{"pattern pattern-statechange-betweencycles(Q0; Q1; Q2)",
             "always@1 = {prev(Q0) && (Q1) -> (Q2)}"},
        Case{"pattern pattern-reachability(Q0)", "reach@1 = {Q0}"},
        Case{"pattern pattern-repeatability(Q0)", "recoverable@1 = {Q0}"},
        Case{"pattern pattern-leadsto(Q0; I0)", "only-after@1 = {Q0} {I0}"},
        Case{"pattern pattern-leadsto-trigger(Q0; I0; I1)",
             "only-after@1 = {Q0} {prev(I0) && (I1)}"},
        Case{"pattern pattern-leadsto-earlier(Q0; Q1)",
             "only-after@1 = {Q0} {begin(Q1)}"},
        Case{"pattern pattern-timed-trigger(I0; 500; Q3)",
             "for@1 = {I0} {Q3} 500 ms"},
        Case{"pattern pattern-timed-trigger(I0; 2 s; Q3)",
             "for@1 = {I0} {Q3} 2000 ms"}));

class Refused : public testing::TestWithParam<Case> {};

TEST_P(Refused, SaysWhatAndWhere) {
  const ReadLines read(GetParam().line);
  EXPECT_EQ(read.error(), GetParam().expected);
}

INSTANTIATE_TEST_SUITE_P(
    Shape, Refused,
    testing::Values(
        Case{"alwais Q0",
             "RP060 [alwais] `alwais` starts no property line (did you mean "
             "`always`?)"},
        Case{"=> Q0", "RP060 [=> Q0] `=> Q0` starts no property line"},
        Case{"Q0", "RP060 [Q0] `Q0` starts no property line"},
        Case{"  ", "RP060 [  ] a property line is empty"},
        Case{"x:", "RP060 [x:] a property line is empty"},
        Case{"always", "RP060 [] an expression is missing here"},
        Case{"never ", "RP060 [] an expression is missing here"},
        Case{"reach", "RP060 [] an expression is missing here"},
        Case{"assume", "RP060 [] an expression is missing here"},
        Case{"input", "RP060 [] a name is missing here"},
        Case{"output", "RP060 [] a name is missing here"},
        Case{"input in 0..3", "RP062 [in 0..3] the program has no `in 0..3`"},
        Case{"interlock Q0",
             "RP060 [Q0] an interlock is between two expressions or more: "
             "`A, B`"},
        Case{"interlock Q0,", "RP060 [] an expression is missing here"},
        Case{"interlock Q0, , Q1", "RP060 [] an expression is missing here"},
        Case{"latch Q0", "RP060 [] `set` is missing: `latch Q set S reset R`"},
        Case{"latch Q0 set I0",
             "RP060 [] `reset` is missing: `latch Q set S reset R`"},
        Case{"latch Q0 reset I1 set I0",
             "RP060 [] `reset` is missing: `latch Q set S reset R`"},
        Case{"latch Q0 set I0 reset I1 dominant I0",
             "RP060 [I0] `dominant` is followed by `set` or `reset`"},
        Case{"latch Q0 set I0 reset", "RP060 [] an expression is missing here"},
        Case{"after I0, Q1",
             "RP060 [] `within` is missing: `after P, Q within 500 ms`"},
        Case{"after I0, Q1 for 500 ms",
             "RP060 [Q1] `no` is missing: `after P, no Q for 500 ms`"},
        Case{"after I0, nothing for 500 ms",
             "RP060 [nothing] `no` is missing: `after P, no Q for 500 ms`"},
        Case{"after I0, no for 500 ms",
             "RP060 [no] `no` is missing: `after P, "
             "no Q for 500 ms`"},
        Case{"after no I0 for 500 ms",
             "RP060 [no I0 for 500 ms] `after` has two expressions: `after P, "
             "Q within 3 scans`"},
        Case{"after I0 within 3 scans",
             "RP060 [I0 within 3 scans] `after` has two expressions: `after P, "
             "Q within 3 scans`"},
        Case{"after I0, Q1, Q2 within 3 scans",
             "RP060 [I0, Q1, Q2 within 3 scans] `after` has two expressions: "
             "`after P, Q within 3 scans`"},
        Case{"I0 implies Q0",
             "RP060 [] `for` is missing: `P for 500 ms implies Q`"},
        Case{"Q0 only before I0",
             "RP060 [before I0] `only` is followed by `after`"},
        Case{"Q0 only after", "RP060 [] an expression is missing here"},
        Case{"n: input I0", "RP060 [n] only a property can have a name"},
        Case{"n: scan 1 ms", "RP060 [n] only a property can have a name"},
        Case{"pattern always(Q0)", "RP060 [always] `always` is no pattern"},
        Case{"pattern pattern-invariant Q0",
             "RP060 [pattern-invariant Q0] a pattern is written "
             "`pattern-invariant(A)`"},
        Case{"pattern", "RP060 [] a pattern is written `pattern-invariant(A)`"},
        Case{"pattern pattern-invariants(Q0)",
             "RP060 [pattern-invariants] `pattern-invariants` is no pattern "
             "(did you mean `pattern-invariant`?)"},
        Case{"pattern pattern-implication(Q0)",
             "RP060 [Q0] `pattern-implication` has 2 parameters, separated by "
             "`;`"},
        Case{"pattern pattern-implication(Q0; )",
             "RP060 [] an expression is missing here"},
        Case{"pattern pattern-timed-trigger(I0; I1; Q3)",
             "RP065 [I1] a time such as `500 ms` or `1.5 s` is expected here"},
        Case{"pattern pattern-statechange-duringcycle(rose(Q0); Q1)",
             "RP069 [pattern pattern-statechange-duringcycle(rose(Q0); Q1)] "
             "`begin` is of signals: timers, counters and functions have no "
             "value of their own there"}));

INSTANTIATE_TEST_SUITE_P(
    Eventually, Refused,
    testing::Values(
        Case{"eventually", "RP060 [] an expression is missing here"},
        Case{"eventually given fair I0",
             "RP061 [f] an operator is missing before `fair`"},
        Case{"eventually Q0 given",
             "RP060 [] `given` is followed by `fair`: `eventually P given fair "
             "F`"},
        Case{"eventually Q0 given I0",
             "RP060 [I0] `given` is followed by `fair`: `eventually P given "
             "fair F`"},
        Case{"eventually Q0 given fairly I0",
             "RP060 [fairly I0] `given` is followed by `fair`: `eventually P "
             "given fair F`"},
        Case{"eventually Q0 given fair",
             "RP060 [] an expression is missing here"},
        Case{"eventually Q0 given fair I0,",
             "RP060 [] an expression is missing here"},
        Case{"eventually Q0 given fair , I0",
             "RP060 [] an expression is missing here"},
        Case{"eventually Q0, Q1", "RP061 [,] `,` outside of a call"},
        Case{"eventually Q0 given fair I7",
             "RP062 [I7] the program has no `I7` (did you mean `I0`?)"},
        Case{"eventually IW0 given fair I0",
             "RP063 [IW0] `IW0` is a word, and a bit is needed here"},
        Case{"eventually Q0 given fair IW0",
             "RP063 [IW0] `IW0` is a word, and a bit is needed here"},
        Case{"eventually Q0 within 3 scans",
             "RP061 [w] an operator is missing before `within`"}));

INSTANTIATE_TEST_SUITE_P(
    Settles, Refused,
    testing::Values(
        Case{"settles",
             "RP060 [] `settles` is followed by a number of scans: "
             "`settles within 3 scans`"},
        Case{"settles in 3 scans",
             "RP060 [in 3 scans] `settles` is followed by a number of scans: "
             "`settles within 3 scans`"},
        Case{"settles Q0 within 3 scans",
             "RP060 [Q0 within 3 scans] `settles` is followed by a number of "
             "scans: `settles within 3 scans`"},
        Case{"settles within3 scans",
             "RP060 [within3 scans] `settles` is followed by a number of "
             "scans: `settles within 3 scans`"},
        Case{"settles within",
             "RP065 [] a time such as `500 ms`, `1.5 s` or `3 scans` is "
             "expected here"},
        Case{"settles within 0 scans",
             "RP065 [0 scans] inputs change at once, outputs in a scan: 1 scan "
             "is the least"},
        Case{"settles within 30 ms",
             "RP065 [30 ms] time stands still here: scans are counted, not ms"},
        Case{"settles within 1000001 scans",
             "RP065 [1000001 scans] more than 1000000 scans"},
        Case{"settles within 1.5 scans",
             "RP065 [1.5 scans] a time is a whole number of ms or scans"},
        Case{"settles within -1 scans",
             "RP065 [-1 scans] a time such as `500 ms`, `1.5 s` or `3 scans` "
             "is expected here"},
        Case{"settles within 3 scans given fair I0",
             "RP065 [3 scans given fair I0] a time such as `500 ms`, `1.5 s` "
             "or `3 scans` is expected here"}));

INSTANTIATE_TEST_SUITE_P(
    Numbers, Refused,
    testing::Values(
        Case{"after I0, Q1 within 3",
             "RP065 [3] a time such as `500 ms`, `1.5 s` or `3 scans` is "
             "expected here"},
        Case{"after I0, Q1 within",
             "RP065 [] a time such as `500 ms`, `1.5 s` or `3 scans` is "
             "expected here"},
        Case{"after I0, Q1 within 3 weeks",
             "RP065 [3 weeks] a time such as `500 ms`, `1.5 s` or `3 scans` is "
             "expected here"},
        Case{"after I0, Q1 within 1.5 scans",
             "RP065 [1.5 scans] a time is a whole number of ms or scans"},
        Case{"after I0, Q1 within 0.5 ms",
             "RP065 [0.5 ms] a time is a whole number of ms or scans"},
        Case{"after I0, Q1 within 1.2.3 s",
             "RP065 [1.2.3 s] a time is a whole number of ms or scans"},
        Case{"after I0, Q1 within 9999999 scans",
             "RP065 [9999999 scans] more than 1000000 scans"},
        Case{"after I0, Q1 within 99999999999 s",
             "RP065 [99999999999 s] more than a year"},
        Case{"after I0, Q1 within 999999999999999999999999 s",
             "RP065 [999999999999999999999999] a whole number is expected "
             "here"},
        Case{"I0 for 3 scans implies Q0",
             "RP065 [3 scans] a time in ms or s is expected here, not scans"},
        Case{"interlock Q0, Q1 gap 3 scans",
             "RP065 [3 scans] a time in ms or s is expected here, not scans"},
        Case{"interlock Q0, Q1 gap -5 ms",
             "RP065 [-5 ms] a time such as `500 ms` or `1.5 s` is expected "
             "here"},
        Case{"scan 1..100", "RP065 [1..100] the unit `ms` is missing"},
        Case{"scan 100..1 ms",
             "RP065 [100..1] the range is empty: 100 is above 1"},
        Case{"scan 0..10 ms",
             "RP065 [0..10 ms] a scan takes 1 ms or more, and less than a "
             "year"},
        Case{"scan ms", "RP065 [] a whole number is expected here"},
        Case{"scan 1..x ms", "RP065 [x] a whole number is expected here"},
        Case{"input IW0 in 5..1",
             "RP065 [5..1] the range is empty: 5 is above 1"},
        Case{"input IW0 in 0..", "RP065 [] a whole number is expected here"},
        Case{"input IW0 in 0..9999999999",
             "RP065 [input IW0 in 0..9999999999] the range leaves "
             "-32768..32767, the range of `IW0`"},
        Case{"input IW0 in 0..32768",
             "RP065 [input IW0 in 0..32768] the range leaves "
             "-32768..32767, the range of `IW0`"}));

INSTANTIATE_TEST_SUITE_P(
    Formulas, Refused,
    testing::Values(
        Case{"always Q0 &&", "RP061 [] the formula ends too early"},
        Case{"always Q0 Q1", "RP061 [Q] an operator is missing before `Q1`"},
        Case{"always (Q0", "RP061 [(] `(` without `)`"},
        Case{"always Q0 -> Q9",
             "RP062 [Q9] the program has no `Q9` (did you mean `Q0`?)"},
        Case{"n: interlock Q0, motor",
             "RP062 [motor] the program has no `motor`"},
        Case{"always T(1).q",
             "RP062 [T(1).q] the program has no `T(1).q` (did you mean "
             "`T(0).q`?)"},
        Case{"always T(0).value > 3",
             "RP062 [T(0).value] the program has no `T(0).value` (did you mean "
             "`C(0).value`?)"},
        Case{"always C(0).elapsed > 3",
             "RP062 [C(0).elapsed] the program has no `C(0).elapsed` (did you "
             "mean `T(0).elapsed`?)"},
        Case{"always previous(Q0)",
             "RP062 [previous(Q0)] properties have no function `previous`"},
        Case{"always pre(Q0)",
             "RP062 [pre(Q0)] properties have no function `pre` (did you mean "
             "`prev`?)"},
        Case{"always prev(Q0, Q1)",
             "RP063 [prev(Q0, Q1)] `prev` has one operand"},
        Case{"always IW0",
             "RP063 [IW0] `IW0` is a word, and a bit is needed here"},
        Case{"always 1", "RP063 [1] `1` is a word, and a bit is needed here"},
        Case{"always Q0 && IW0 + 1",
             "RP063 [IW0 + 1] `IW0 + 1` is a word, and a bit is needed here"},
        Case{"always Q0 < 3",
             "RP063 [Q0] `Q0` is a bit, and a word is needed here"},
        Case{"always Q0 == 1",
             "RP063 [Q0] `Q0` is a bit, and a word is needed here"},
        Case{"always IW0 + Q0 > 1",
             "RP063 [Q0] `Q0` is a bit, and a word is needed here"},
        Case{"always (I0 ? Q0 : IW0)",
             "RP063 [IW0] `IW0` is a word, and a bit is needed here"},
        Case{"always rose(IW0)",
             "RP063 [IW0] `IW0` is a word, and a bit is needed here"},
        Case{"always IW0 * IW0 * IW0 * IW0 > 1",
             "RP063 [IW0 * IW0 * IW0 * IW0] the value of this can leave 53 "
             "bits"},
        Case{"always T(0).elapsed > IW0",
             "RP069 [T(0).elapsed] `T(0).elapsed` can only be compared with a "
             "number"},
        Case{"always T(0).elapsed + 1 > 3",
             "RP069 [T(0).elapsed] `T(0).elapsed` can only be compared with a "
             "number"},
        Case{"always prev(T(0).elapsed) > 3",
             "RP069 [T(0).elapsed] `T(0).elapsed` can only be compared with a "
             "number"},
        Case{"always T(0).elapsed",
             "RP063 [T(0).elapsed] `T(0).elapsed` is a word, and a bit is "
             "needed here"},
        Case{"always T(0).elapsed < 999999999999",
             "RP069 [T(0).elapsed] `T(0).elapsed` is compared with more than a "
             "year"},
        Case{"always C(0).value >= -32768",
             "RP069 [C(0).value] `C(0).value` is compared with -32768 or less: "
             "so far down the count is not followed"},
        Case{"always begin(T(0).q)",
             "RP069 [begin(T(0).q)] `begin` is of signals: timers, counters "
             "and functions have no value of their own there"},
        Case{"always begin(prev(Q0))",
             "RP069 [begin(prev(Q0))] `begin` is of signals: timers, counters "
             "and functions have no value of their own there"},
        Case{"assume Q0",
             "RP068 [Q0] `Q0` is no input: an assumption is about inputs"},
        Case{"assume prev(I0) || T(0).q",
             "RP068 [T(0).q] `T(0).q` is no input: an assumption is about "
             "inputs"}));

INSTANTIATE_TEST_SUITE_P(
    Declarations, Refused,
    testing::Values(
        Case{"input I9",
             "RP062 [I9] the program has no `I9` (did you mean `I0`?)"},
        Case{"input T(0).q", "RP062 [T(0).q] `T(0).q` is no signal"},
        Case{"input Q0 in 0..3",
             "RP067 [Q0] `Q0` is no input: a rung assigns it"},
        Case{"input M0", "RP067 [M0] `M0` is no input: a rung assigns it"},
        Case{"input I0 in 0..1",
             "RP067 [input I0 in 0..1] `I0` is a bit and has no range"},
        Case{"input IW0 nc",
             "RP067 [input IW0 nc] `IW0` is a word: only a bit is wired so"},
        Case{"input I0 nc trip reset",
             "RP060 [input I0 nc trip reset] an input is a `trip` or a "
             "`reset`, not both"},
        Case{"input I0 no", "RP062 [I0 no] the program has no `I0 no`"},
        Case{"input nc", "RP062 [nc] the program has no `nc`"},
        Case{"output M1", "RP067 [M1] `M1` is no output: no rung assigns it"},
        Case{"output I0", "RP067 [I0] `I0` is no output: no rung assigns it"},
        Case{"a: never Q0\na: never Q1",
             "RP066 [a: never Q1] a second property is called `a`"},
        Case{"a.sets: never Q0\na: latch Q0 set I0 reset I1",
             "RP066 [a: latch Q0 set I0 reset I1] a second property is called "
             "`a.sets`"},
        Case{"expect a proved", "RP062 [a] no property is called `a`"},
        Case{"ab: never Q0\nexpect ac proved",
             "RP062 [ac] no property is called `ac` (did you mean `ab`?)"},
        Case{"a: never Q0\nexpect a safe",
             "RP060 [safe] `expect NAME VERDICT`: a verdict is `proved`, "
             "`violated`, `bounded`, `vacuous` or `unknown`"}));

TEST(Lines, AllErrorsOfAFileAreFoundInOneRun) {
  const ReadLines read("alwais Q0\nnever Q9\nscan 5\nalways IW0 && Q1\n");
  std::string codes;
  for (const Diagnostic& item : read.found.items()) {
    codes += std::string(item.code) + " ";
  }
  EXPECT_EQ(codes, "RP060 RP065 RP062 RP063 ");
}

TEST(Lines, DeclarationsChangeTheProgram) {
  const ReadLines read(
      "input M1\noutput M0\ninput IW0 in 10..20\nscan 5..7 ms\n");
  ASSERT_FALSE(read.found.has_errors()) << read.error();
  const Program& program = read.sample.program;
  EXPECT_EQ(program.cells[read.sample.find("M1")].role, CellRole::Input);
  EXPECT_EQ(program.cells[read.sample.find("M0")].role, CellRole::Output);
  const Cell& word = program.cells[read.sample.find("IW0")];
  EXPECT_EQ(word.low, 10);
  EXPECT_EQ(word.high, 20);
  EXPECT_EQ(word.initial, 10) << "the range holds before the first scan, too";
  EXPECT_EQ(program.scan.min_ms, 5);
  EXPECT_EQ(program.scan.max_ms, 7);
}

TEST(Lines, AWordOnDeclaredInputsMayBeAssumed) {
  const ReadLines read("assume M1 || prev(I0)\ninput M1\n");
  ASSERT_FALSE(read.found.has_errors()) << read.error();
  EXPECT_EQ(read.set.assumptions, std::vector<std::string>{"M1 || prev(I0)"});
}

TEST(Lines, OtherPartsLinesAreLeftToThem) {
  const ReadLines read(
      "language script\ndialect sim\nallow RP101: the lamp test\n"
      "allow double-coil\n");
  EXPECT_FALSE(read.found.has_errors()) << read.error();
}

TEST(Lines, ComparingAnElapsedTimeRaisesTheCapOfItsClock) {
  const ReadLines read("always 10 * 100 + 1 s > T(0).elapsed -> Q0 || !Q0");
  ASSERT_FALSE(read.found.has_errors()) << read.error();
  EXPECT_EQ(read.sample.program.instances[InstanceId(0)].clock_cap, 2001);
}

TEST(Lines, ExpectationsAreKept) {
  const ReadLines read(
      "expect a.holds violated\na: latch Q0 set I0 reset I1\n"
      "expect builtin.Q1.can-become-true proved\n");
  ASSERT_FALSE(read.found.has_errors()) << read.error();
  ASSERT_EQ(read.set.expectations.size(), 2U);
  EXPECT_EQ(read.set.expectations[0].obligation, "a.holds");
  EXPECT_EQ(read.set.expectations[0].verdict, "violated");
}

TEST(Lines, HistoryIsBounded) {
  std::string formula;
  for (int i = 0; i < 60; ++i) formula += "rose(";
  formula += "Q0" + std::string(60, ')');
  EXPECT_FALSE(ReadLines("always " + formula).found.has_errors());
  EXPECT_EQ(ReadLines("always prev(" + formula + ")").error().substr(0, 5),
            "RP069");
}

TEST(Lines, AnyWordsGiveALineOrAnError) {
  const std::vector<std::string> words = {
      "always",     "never",   "interlock",
      "latch",      "set",     "reset",
      "reach",      "after",   "within",
      "for",        "implies", "only",
      "gap",        "input",   "scan",
      "assume",     "expect",  "dominant",
      "in",         "Q0",      "I0",
      "IW0",        "T(0).q",  "T(0).elapsed",
      "C(0).value", "M1",      "prev(",
      "begin(",     "rose(",   "once(",
      "(",          ")",       ",",
      ";",          "->",      "&&",
      "||",         "!",       "==",
      "<",          "+",       "*",
      "-",          "?",       ":",
      "0",          "3",       "1.5",
      "ms",         "s",       "scans",
      "..",         "pattern", "pattern-implication(",
      "x",          ".",       "%",
      "\xff",       "=",       "NOT",
      "fell("};
  std::mt19937 dice(1);
  int accepted = 0;
  for (int i = 0; i < 4'000; ++i) {
    std::string line;
    if (i % 2 == 0) line = "always Q0 ";
    for (auto n = dice() % 9; n > 0; --n) {
      line += words[dice() % words.size()] + (dice() % 3 == 0 ? "" : " ");
    }
    ReadLines read(line);
    if (read.found.has_errors()) continue;
    ++accepted;
    TransitionSystem ts = build_transition_system(read.sample.program);
    for (const Obligation& made :
         make_obligations(read.sample.program, read.set, ts)) {
      ASSERT_TRUE(made.condition.has_value()) << line;
    }
  }
  EXPECT_GT(accepted, 200);
}

TEST(Lines, DepthCostsNoStack) {
  const std::string open(200'000, '(');
  const std::string close(200'000, ')');
  EXPECT_FALSE(ReadLines("always " + open + "Q0" + close).found.has_errors());
}

}  // namespace
}  // namespace rung
