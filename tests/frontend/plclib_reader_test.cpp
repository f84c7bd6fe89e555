#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "analysis/program.h"
#include "analysis/simulator.h"
#include "dump.h"
#include "frontend/plclib/reader.h"

namespace rung::test {
namespace {

struct Text {
  explicit Text(std::string text, const ReadOptions& options = {})
      : file(sources.add("sketch.ino", std::move(text))),
        ast(read_plclib(sources, file, options, list)) {
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

std::string sketch(std::string_view globals, std::string_view loop) {
  return "#include <plcLib.h>\n" + std::string(globals) +
         "\nvoid setup() { setupPLC(); }\nvoid loop() {\n" + std::string(loop) +
         "\n}\n";
}

struct Row {
  std::string_view globals;
  std::string_view loop;
  std::string_view expected;
};

TEST(PlclibReader, ReadsCalls) {
  const std::vector<Row> table = {
      {"", "", ""},
      {"", "in(X0); out(Y0);", "Y0=X0"},
      {"", "load(X0); andLogic(X1); orInv(X2); out(Y5);",
       "Y5=(|| (&& X0 X1) (! X2))"},
      {"", "in(X0); andNotBit(X1); outNot(Y0);",
       "scanValue.1=(&& X0 (! X1)) | Y0=(! scanValue.1)"},
      // Each read is a sample of its own; an output gives what was written.
      {"", "in(X0); out(Y0); in(X0); andBit(Y0); out(Y1);",
       "Y0=X0 | Y1=(&& X0.2 Y0)"},
      // `set` leaves the output's value in the accumulator.
      {"", "in(X0); set(Y0); out(Y1);", "Y0=(|| X0 Y0) | Y1=Y0"},
      {"", "in(X0); reset(Y0); out(Y1);", "Y0=(&& Y0 (! X0)) | Y1=X0"},
      {"", "in(Y0); reset(Y0); out(Y1);",
       "scanValue.1=Y0 | Y0=(&& Y0 (! Y0)) | Y1=scanValue.1"},
      {"", "in(X0); latch(Y0, X1);", "Y0=(&& (|| X0 Y0) (! X1))"},
      // Variables.
      {"unsigned int A = 1;", "in(A); andBit(X0); set(A);",
       "A=(|| (&& true X0) true)"},
      {"unsigned int A; bool b;", "A = in(X0); b = A == 1 && !digitalRead(X1);",
       "A=X0 | b=(&& A (! X1))"},
      {"bool a, b, c;", "b = digitalRead(X0); c = !b; a = X0 > 3 ? b : c;",
       "b=X0 | c=(! b) | choice.1=(> 14 3) | a=(|| (&& choice.1 b) (&& (! "
       "choice.1) c))"},
      // The accumulator of the last scan.
      {"", "out(Y0);", "Y0=scanValue | scanValue=Y0"},
      // Conditions.
      {"unsigned int a, b;", "a = in(X0); if (a) { b = 1; } else b = 0;",
       "a=X0 | if.1=a | b=(|| (&& if.1 true) (&& (! if.1) b)) | "
       "if.2=(! if.1) | b=(|| (&& if.2 false) (&& (! if.2) b))"},
      // Timers.
      {"unsigned long T;", "in(X0); timerOn(T, 2000); out(Y0);",
       "T.1=(timerOn X0 0 2000) | Y0=T.1"},
      // Loops and functions are put in.
      {"unsigned int A;",
       "for (unsigned int i = 0; i < 2; i++) { in(i); out(A); } in(A); "
       "out(Y0);",
       "A=false | A=true | Y0=A"},
      {"#define motor Y0\nvoid run() { in(X0); out(motor); }", "run();",
       "Y0=X0"},
      // Objects.
      {"Stack s;", "in(X0); s.push(); in(X1); s.orBlock(); out(Y0);",
       "stack.1=X0 | Y0=(|| X1 stack.1)"},
      {"Pulse p;", "in(X0); p.inClock(); p.rising(); set(Y0);",
       "clock.1=X0 | p.rising=(&& clock.1 (! p.clock)) | "
       "p.falling=(&& (! clock.1) p.clock) | p.clock=clock.1 | "
       "Y0=(|| p.rising Y0)"},
  };
  for (const Row& row : table) {
    Text text(sketch(row.globals, row.loop));
    EXPECT_EQ(text.problems(), "") << row.loop;
    EXPECT_EQ(text.rungs(), row.expected) << row.loop;
  }
}

TEST(PlclibReader, AnalogueValuesAreWords) {
  const std::vector<Row> table = {
      {"", "inAnalog(X0); compareLT(X1); out(Y0);", "Y0=(< X0 X1)"},
      {"", "inAnalog(X0); out(Y0);", "Y0=(== X0 1)"},
      {"", "inAnalog(X0); outPWM(Y0);", "Y0=(/ X0 4)"},
      {"const unsigned int limit = 500;",
       "inAnalog(X0); compareGT(limit); "
       "out(Y0);",
       "Y0=(> X0 500)"},
      {"", "inAnalog(X0); andBit(X1); out(Y0);",
       "last.1=(!= X0 (* (/ X0 2) 2)) | Y0=(&& X1 last.1)"},
  };
  for (const Row& row : table) {
    Text text(sketch(row.globals, row.loop));
    EXPECT_EQ(text.problems(), "") << row.loop;
    EXPECT_EQ(text.rungs(), row.expected) << row.loop;
  }
}

TEST(PlclibReader, ChoosesTheLibraryByItsCalls) {
  EXPECT_EQ(Text(sketch("", "load(X0); out(Y0);")).ast.semantics, "plclib");
  EXPECT_EQ(Text(sketch("", "in(X0); out(Y0);")).ast.semantics, "plclib14");
  const ReadOptions thesis = {.semantics = find_semantics("plclib")};
  EXPECT_EQ(Text(sketch("", "set(Y0);"), thesis).ast.dialect, "plclib");
  EXPECT_EQ(Text(sketch("", "in(X0);"), thesis).problems(),
            "RP058 5:1 `in` is a call of the other library of this name: the "
            "semantics are those of `plclib`\n");
}

TEST(PlclibReader, InputsMayBeStable) {
  const std::string text = sketch("", "in(X0); out(Y0); in(X0); out(Y1);");
  EXPECT_EQ(Text(text, {.stable_inputs = true}).rungs(), "Y0=X0 | Y1=X0");
  EXPECT_EQ(Text("//@ inputs stable\n" + text).rungs(), "Y0=X0 | Y1=X0");
  EXPECT_EQ(Text("//@ inputs firm\n" + text).problems(),
            "RP056 1:5 expected `inputs stable` and found `inputs firm`\n");
}

// `unsigned int` has 16 bits and wraps; nothing else may leave its type.
TEST(PlclibReader, UnsignedArithmeticWraps) {
  Text text(sketch("unsigned int u = 65535, v; bool b;",
                   "u = u + 1; v = u - 1; b = u + 65535U;"));
  EXPECT_EQ(text.problems(), "");
  Simulator simulator(text.program);
  const auto value = [&](std::string_view name) {
    return simulator.value(find_cell(text.program, name));
  };
  simulator.scan(10);
  EXPECT_EQ(value("u"), 0);
  EXPECT_EQ(value("v"), 65'535);
  EXPECT_EQ(value("b"), 1);
  simulator.scan(10);
  EXPECT_EQ(value("u"), 1);
  EXPECT_EQ(value("v"), 0);
  EXPECT_EQ(value("b"), 0);
}

TEST(PlclibReader, IntegersAreThoseOfCpp) {
  Text text(sketch("int a, b, c, d, g, n; unsigned int e; bool f;",
                   "a = digitalRead(X0) ? -17 : 9; g = digitalRead(X1) ? 17 : "
                   "2; b = -a / 5 + a % 5; c = g << 2 >> 1; "
                   "d = a > 3 ? a - 20 : 7; e = (g & 1) | (b == -1); "
                   "f = !a || d < b && c >= 34; n += 3; n -= 1; n--;"));
  EXPECT_EQ(text.problems(), "");
  Simulator simulator(text.program);
  simulator.set_input(find_cell(text.program, "X0"), 1);
  simulator.set_input(find_cell(text.program, "X1"), 1);
  simulator.scan(10);
  const auto value = [&](std::string_view name) {
    return simulator.value(find_cell(text.program, name));
  };
  EXPECT_EQ(value("b"), 17 / 5 + -17 % 5);
  EXPECT_EQ(value("c"), 17 << 2 >> 1);
  EXPECT_EQ(value("d"), 7);
  EXPECT_EQ(value("e"), 1);
  EXPECT_EQ(value("f"), 0);
  EXPECT_EQ(value("n"), 1);
}

// Before each call and after the last one the task may run, with the
// accumulator that it finds and leaves.
TEST(PlclibReader, ATaskMayRunBetweenCalls) {
  Text text(
      sketch("void loop1(100) { load(X1); out(Y1); }", "load(X0); out(Y0);"));
  EXPECT_EQ(text.problems(), "");
  const auto task = [](std::string_view number) {
    const std::string n(number);
    return "runs." + n + "=(runs loop1." + n + " 0 100) | Y1=(|| (&& runs." +
           n + " X1" + (n == "1" ? "" : "." + n) + ") (&& (! runs." + n +
           ") Y1)) | scanValue=(|| (&& runs." + n + " Y1) (&& (! runs." + n +
           ") scanValue))";
  };
  EXPECT_EQ(text.rungs(), task("1") + " | scanValue=X0 | " + task("2") +
                              " | Y0=scanValue | scanValue=Y0 | " + task("3"));
}

TEST(PlclibReader, CallsThatWaitMakeTheScanLonger) {
  Text text(sketch("int c, now, was;",
                   "load(X0); counter(c, now, was, 3); delay(10);"));
  EXPECT_EQ(text.problems(), "");
  EXPECT_EQ(text.program.scan.min_ms, 61);
  EXPECT_EQ(text.program.scan.max_ms, 160);
}

// The count of a variable is known to be in its range.
TEST(PlclibReader, LearnsWhatVariablesHold) {
  Text text(sketch("int c, now, was;\nunsigned int a, b = 3;",
                   "load(X0); counterState(c, now, was, 3); a = b; b = a;"));
  EXPECT_EQ(text.problems(), "");
  const auto high = [&](std::string_view name) {
    return text.program.cells[find_cell(text.program, name)].high;
  };
  EXPECT_EQ(high("c"), 3);
  EXPECT_EQ(high("was"), 1);
  EXPECT_EQ(high("a"), 3);
}

TEST(PlclibReader, SetupGivesInitialValues) {
  Text text(
      "#include <plcLib.h>\nunsigned int a = 1, b;\nint led = 7;\n"
      "void setup() { setupPLC(); pinMode(led, OUTPUT); b = a + 2; a = 0;\n"
      "  digitalWrite(led, HIGH); Serial.begin(9600); delay(5); }\n"
      "void loop() { in(b); out(Y0); in(a); set(led); }\n");
  EXPECT_EQ(text.problems(), "");
  const auto initial = [&](std::string_view name) {
    return text.program.cells[find_cell(text.program, name)].initial;
  };
  EXPECT_EQ(initial("b"), 3);
  EXPECT_EQ(initial("a"), 0);
  EXPECT_EQ(initial("led"), 1);
}

// What is wrong in a sketch, each with the error it gives.
struct Refused {
  std::string_view text;  // loop's body, or a whole file if it has an #include
  std::string_view code;
};

TEST(PlclibReader, RefusesWhatItCannotRead) {
  const std::vector<Refused> table = {
      {"while (1) { in(X0); }", "RP055"},
      {"do { in(X0); } while (0);", "RP055"},
      {"switch (1) { case 1: break; }", "RP055"},
      {"goto end;", "RP055"},
      {"return 3;", "RP055"},
      {"if (digitalRead(X0)) { return; } in(X1);", "RP055"},
      {"for (;;) { in(X0); }", "RP055"},
      {"for (int i = 0; i < 300; i++) in(X0);", "RP059"},
      {"for (int i = 0; i < 3; i += 2) in(X0);", "RP055"},
      {"unknown(X0);", "RP055"},
      {"millis();", "RP055"},
      {"a = 1;", "RP057"},
      {"in(a);", "RP057"},
      {"in(X9);", "RP057"},
      {"in(500);", "RP058"},
      {"out(X0);", "RP058"},
      {"in();", "RP056"},
      {"in(X0, X1);", "RP056"},
      {"in(X0)", "RP056"},
      {"in(X0;", "RP056"},
      {"in(X0); load(X0);", "RP058"},
      {"in(X0) = 1;", "RP056"},
      {"1 + 1;", "RP056"},
      {"int x; in(X0);", "RP055"},
      {"int x = in(X0) + in(X1); in(x);", "RP055"},
      {"int x = in(X0); in(x);", "RP058"},
      {"timerOn(T, 10);", "RP058"},
      {"setupPLC();", "RP055"},
      {"pinMode(X0, INPUT);", "RP055"},
      {"inAnalog(X0); in(X0);", "RP055"},
      {"outPWM(Y0); out(Y0);", "RP055"},
      {"inAnalog(X0); timerOff(T, 10);", "RP058"},
      {"in(X0); andBit(X1 & ~X2);", "RP055"},
      {"bool b = in(X0) & in(X1);", "RP055"},
      {"Serial.read();", "RP055"},
      {"Serial.println(in(X0));", "RP055"},
      {"if (digitalRead(X0)) delay(10);", "RP055"},
      {"digitalWrite(Y0);", "RP056"},
      {"setup();", "RP055"},
      {"}", "RP056"},
      {"{", "RP056"},
      {"in(\"X0\");", "RP056"},
      {"in(X0); @", "RP056"},
      {"int Y0 = 3; out(Y0);", "RP058"},
      {"in(0.5);", "RP056"},
      {"for (int i = 3; i < 3; i++) in(X0);", "RP055"},
      {"if (in(X0) == digitalRead(X1)) out(Y0);", "RP055"},
      {"set(1U + 1U);", "RP055"},
      {"out(2U);", "RP058"},
      {"in(100000UL);", "RP055"},
      {"#include <plcLib.h>\nint x;\nvoid setup() {}\nvoid loop() {\n"
       "x = x + 1; if (x + 1) in(X0); }",
       "RP055"},
      {"#include <plcLib.h>\nint x, y;\nvoid setup() {}\nvoid loop() {\n"
       "x = x + 1; y = (x + 1) / 2; }",
       "RP055"},
      {"#include <plcLib.h>\nvoid f() {}\nvoid setup() {}\nvoid loop() {}",
       "RP055"},
      {"#include <plcLib.h>\nvoid f() { int x = 1; in(X0); }\n"
       "void loop1(9) { f(); }\nvoid setup() {}\nvoid loop() { f(); }",
       "RP055"},
      {"#include <plcLib.h>\nvoid loop1(20) {}\nvoid setup() {}\n"
       "void loop() { delay(20); }",
       "RP055"},
      {"#include <plcLib.h>\nStack s;\nvoid setup() {}\nvoid loop() "
       "{ s.push(); }",
       "RP055"},
      {"#include <plcLib.h>\nStack s;\nvoid setup() {}\nvoid loop() "
       "{ s.pop(); }",
       "RP058"},
      {"#include <plcLib.h>\nunsigned long T;\nvoid setup() {}\nvoid loop() "
       "{ timerOn(T, 5); delay(1); timerOn(T, 5); }",
       "RP055"},
      {"in(X0 ? 1);", "RP056"},
      {"in((X0);", "RP056"},
      {"#include <plcLib.h>\nvoid loop() {}", "RP056"},
      {"#include <plcLib.h>\nvoid setup() {}", "RP056"},
      {"#include <plcLib.h>\n#include <Servo.h>\nvoid setup() {}\nvoid loop() "
       "{}",
       "RP055"},
      {"#include <plcLib.h>\n#ifdef X\nvoid setup() {}\nvoid loop() {}",
       "RP055"},
      {"#include <plcLib.h>\n#define F(x) x\nvoid setup() {}\nvoid loop() {}",
       "RP055"},
      {"#include <plcLib.h>\nvoid setup() {}\nvoid loop() {", "RP056"},
      {"#include <plcLib.h>\nint f(int x) { }\nvoid setup() {}\nvoid loop() {}",
       "RP055"},
      {"#include <plcLib.h>\nint a[3];\nvoid setup() {}\nvoid loop() {}",
       "RP055"},
      {"#include <plcLib.h>\nfloat f;\nvoid setup() {}\nvoid loop() {}",
       "RP055"},
      {"#include <plcLib.h>\nextern int x;\nvoid setup() {}\nvoid loop() {}",
       "RP055"},
      {"#include <plcLib.h>\nint a; int a;\nvoid setup() {}\nvoid loop() {}",
       "RP057"},
      {"#include <plcLib.h>\nPulse a, b c;\nvoid setup() {}\nvoid loop() {}",
       "RP056"},
      {"#include <plcLib.h>\nCounter c;\nvoid setup() {}\nvoid loop() {}",
       "RP058"},
      {"#include <plcLib.h>\nvoid setup() { while (1); }\nvoid loop() {}",
       "RP055"},
      {"#include <plcLib.h>\nvoid setup() { in(A0); }\nvoid loop() {}",
       "RP055"},
      {"#include <plcLib.h>\nvoid f() { f(); }\nvoid setup() {}\nvoid loop() { "
       "f(); }",
       "RP055"},
      {"#include <plcLib.h>\nvoid loop1(0) {}\nvoid setup() {}\nvoid loop() {}",
       "RP055"},
      {"#include <plcLib.h>\nvoid loop1(5) {}\nvoid loop2(5) {}\n"
       "void setup() {}\nvoid loop() {}",
       "RP055"},
      {"#include <plcLib.h>\nunsigned long T = 3;\nvoid setup() {}\nvoid "
       "loop() "
       "{ timerOn(T, 1); }",
       "RP058"},
      {"#include <plcLib.h>\nunsigned long T;\nvoid setup() {}\nvoid loop() "
       "{ timerOn(T, 1); in(T); }",
       "RP058"},
      {"#include <plcLib.h>\nunsigned long T; int x;\nvoid setup() {}\nvoid "
       "loop() { x = x + 1; timerOn(T, x); }",
       "RP058"},
      {"/* #include <plcLib.h>", "RP007"},
  };
  for (const Refused& row : table) {
    const bool whole = row.text.find("#include") != std::string_view::npos;
    Text text(whole ? std::string(row.text) : sketch("", row.text));
    EXPECT_TRUE(text.list.has_errors()) << row.text;
    EXPECT_EQ(text.problems().substr(0, 5), row.code) << row.text << "\n"
                                                      << text.problems();
  }
}

TEST(PlclibReader, NestingAndSizeAreBounded) {
  const auto repeat = [](std::string_view part, int times) {
    std::string result;
    for (int i = 0; i < times; ++i) result += part;
    return result;
  };
  EXPECT_TRUE(Text(sketch("", repeat("{", 100'000))).list.has_errors());
  EXPECT_TRUE(
      Text(sketch("int x;", "x = " + repeat("(", 100'000))).list.has_errors());
  EXPECT_TRUE(Text(sketch("int x;", "x = " + repeat("!", 100'000) + "1;"))
                  .list.has_errors());
  const std::string loops = repeat("for (int i = 0; i < 200; i++) ", 1) +
                            "for (int j = 0; j < 200; j++) in(X0);";
  EXPECT_NE(Text(sketch("", loops)).problems().find("RP059"),
            std::string::npos);
  std::string macros = "#define A0x in(X0);\n";
  for (int i = 1; i < 60; ++i) {
    macros += "#define A" + std::to_string(i) + "x A" + std::to_string(i - 1) +
              "x A" + std::to_string(i - 1) + "x\n";
  }
  EXPECT_TRUE(Text(sketch(macros, "A59x")).list.has_errors());
}

/// The outputs of a run, a letter a scan; `inputs` has a string for each input.
std::string run(const Program& program, std::string_view output,
                const std::vector<std::pair<std::string, std::string>>& inputs,
                std::int64_t dt) {
  Simulator simulator(program);
  std::string seen;
  for (std::size_t scan = 0; scan < inputs.front().second.size(); ++scan) {
    for (const auto& [name, levels] : inputs) {
      simulator.set_input(find_cell(program, name),
                          levels[scan] == '1' ? 1 : 0);
    }
    simulator.scan(dt);
    const auto value = simulator.value(find_cell(program, output));
    seen += static_cast<char>('0' + value);
  }
  return seen;
}

TEST(PlclibReader, TimersRunAsListed) {
  const auto timer = [](std::string_view call) {
    return sketch("unsigned long T;",
                  "in(X0); " + std::string(call) + " out(Y0);");
  };
  // Scans of 10 ms. An on-delay's first scan is false whatever its period is.
  EXPECT_EQ(run(Text(timer("timerOn(T, 20);")).program, "Y0",
                {{"X0", "0111110111"}}, 10),
            "0001110001");
  EXPECT_EQ(
      run(Text(timer("timerOn(T, 0);")).program, "Y0", {{"X0", "0110"}}, 10),
      "0010");
  EXPECT_EQ(run(Text(timer("timerOff(T, 20);")).program, "Y0",
                {{"X0", "0010000010"}}, 10),
            "0011000011");
  EXPECT_EQ(run(Text(timer("timerPulse(T, 20);")).program, "Y0",
                {{"X0", "0111110010"}}, 10),
            "0110000011");
  // The thesis's compare with `>`, and its timerOn is an off-delay.
  const ReadOptions thesis = {.semantics = find_semantics("plclib")};
  const auto old = [](std::string_view call) {
    return sketch("unsigned long T, U;",
                  "load(X0); " + std::string(call) + " out(Y0);");
  };
  EXPECT_EQ(run(Text(old("timerDelay(T, 20);"), thesis).program, "Y0",
                {{"X0", "0111110111"}}, 10),
            "0000110000");
  EXPECT_EQ(run(Text(old("timerOn(T, 20);"), thesis).program, "Y0",
                {{"X0", "0010000010"}}, 10),
            "0011100011");
  EXPECT_EQ(run(Text(old("m8013(T, U);"), thesis).program, "Y0",
                {{"X0", "0111111111"}}, 400),
            "0111000011");
}

TEST(PlclibReader, CountersCountAsListed) {
  Text text(sketch("Counter c(2);",
                   "in(X0); c.countUp(); in(X1); c.clear(); c.upperQ(); "
                   "out(Y0); c.lowerQ(); out(Y1);"));
  EXPECT_EQ(text.problems(), "");
  EXPECT_EQ(
      run(text.program, "Y0", {{"X0", "1101101111"}, {"X1", "0000000100"}}, 10),
      "0001111000");
  EXPECT_EQ(run(text.program, "c.count",
                // Cleared, a clock that is still true counts again.
                {{"X0", "1101101111"}, {"X1", "0000000100"}}, 10),
            "1112222011");
}

TEST(PlclibReader, ShiftRegistersShiftAsListed) {
  Text text(sketch("Shift s(0x8001);",
                   "in(X1); s.inputBit(); in(X0); s.shiftRight(); "
                   "s.bitValue(0); out(Y0); s.bitValue(15); out(Y1);"));
  EXPECT_EQ(text.problems(), "");
  EXPECT_EQ(run(text.program, "Y0", {{"X0", "0110"}, {"X1", "0100"}}, 10),
            "1000");
  EXPECT_EQ(run(text.program, "Y1", {{"X0", "0110"}, {"X1", "0100"}}, 10),
            "1111");
}

}  // namespace
}  // namespace rung::test
