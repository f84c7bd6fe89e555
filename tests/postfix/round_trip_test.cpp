// Text, binary and program are three spellings of one thing.

#include <gtest/gtest.h>

#include <random>
#include <string>
#include <vector>

#include "analysis/simulator.h"
#include "backend/postfix/lower.h"
#include "frontend/postfix/disassemble.h"
#include "tests/postfix/image.h"
#include "tests/postfix/machine_adapter.h"

namespace rung {
namespace {

std::string lowered_text(const Program& program) {
  DiagnosticList errors;
  const auto text = lower_to_postfix_text(program, errors);
  for (const Diagnostic& item : errors.items()) {
    EXPECT_EQ(item.severity, Severity::Note) << item.message;
  }
  return text.value_or("");
}

std::string lowered_binary(const Program& program) {
  DiagnosticList errors;
  const auto bytes = lower_to_postfix_binary(program, errors);
  EXPECT_TRUE(bytes.has_value());
  return bytes.value_or("");
}

std::string inexpressible(const Program& program) {
  DiagnosticList text_errors;
  DiagnosticList binary_errors;
  EXPECT_FALSE(lower_to_postfix_text(program, text_errors).has_value());
  EXPECT_FALSE(lower_to_postfix_binary(program, binary_errors).has_value());
  std::string said;
  for (const Diagnostic& item : binary_errors.items()) {
    if (item.severity == Severity::Note) continue;
    EXPECT_EQ(item.code, "RP084");
    said += item.message + "\n";
  }
  return said;
}

void expect_round_trip(const std::string& source) {
  const Program program = program_of(source);
  const std::string text = lowered_text(program);
  const std::string binary = lowered_binary(program);
  // Two ways to the same text, and a binary that is made again from it.
  const Disassembly back = disassemble_postfix(binary);
  ASSERT_EQ(back.refusal, "") << source;
  EXPECT_EQ(back.text, text);
  const Program again = program_of(binary);
  EXPECT_EQ(lowered_binary(again), binary) << source;
  EXPECT_EQ(lowered_text(again), text) << source;
  EXPECT_EQ(difference(program_of(text), again), "") << source;
}

TEST(PostfixRoundTrip, Programs) {
  expect_round_trip(postfix_text("", ""));
  expect_round_trip(postfix_text("output bit q\n", "true =q\n"));
  expect_round_trip(postfix_text(
      "input bit a\nmemory bit \"a b\" = 1\noutput bit \"neg\"\n//@ reach a\n"
      "//@ x: always a -> a\n",
      "a \"a b\" ^ =\"neg\"\n"));
  expect_round_trip(postfix_text(
      "input word w in -5..1023 = 3\noutput word q in "
      "-2147483648..2147483647\n",
      "w 2 * 100000 - neg wrap16 3 / =q\nw to_bit ! to_word -129 + =q\n"));
  expect_round_trip(postfix_text(
      "input bit a\noutput bit q\nelement T(0) timer-sim\nelement TOF(0) "
      "timer-off-sim\nelement C(12) counter-sim\nelement E(3) edge\n",
      "a T(0,100ms) =q\na TOF(0,5ms) =q\na a a C(12,7) =q\na RISE(3) a "
      "FALL(3) && =q\n"));
  expect_round_trip(postfix_text(
      "input bit a\ninput bit b\noutput bit q\nelement E(0) edge\n",
      "a b RISE(0) && =q\na b a RISE(0) || && =q\na b && b FALL(0) || =q\n",
      "short-circuit"));
}

// Bits come first in the format; else the order of the cells is kept.
TEST(PostfixRoundTrip, CellsMayComeInAnyOrder) {
  const Program program = program_of(postfix_text(
      "input word w in 0..9\noutput bit q\nmemory word v in 0..9\n",
      "w v == =q\n"));
  const Program back = program_of(lowered_text(program));
  EXPECT_EQ(difference(program, back), "cells differ");
  EXPECT_EQ(back.cells[CellId(0)].name, "q");
  EXPECT_EQ(back.cells[CellId(1)].name, "w");
  EXPECT_EQ(back.cells[CellId(2)].name, "v");
  EXPECT_EQ(difference(back, program_of(lowered_binary(program))), "");
}

TEST(PostfixRoundTrip, LinesAboutTheTextStayBehind) {
  Program program = program_of(postfix_text("output bit q\n", "true =q\n"));
  program.annotations = {{.text = "language script"},
                         {.text = "dialect yun"},
                         {.text = "reach q"}};
  EXPECT_EQ(program_of(lowered_binary(program)).annotations.size(), 1U);
}

TEST(PostfixRoundTrip, ThePlantIsLeftOutWithANote) {
  Program program = program_of(postfix_text("output bit q\n", "true =q\n"));
  program.plant.statements.push_back({});
  DiagnosticList found;
  EXPECT_TRUE(lower_to_postfix_text(program, found).has_value());
  ASSERT_EQ(found.items().size(), 1U);
  EXPECT_EQ(found.items()[0].code, "RP085");
  EXPECT_EQ(found.items()[0].severity, Severity::Note);
}

// Where a program came from changes nothing: what the machine has not is
// refused where it stands.
TEST(PostfixLowering, WritesNoDialectOfAnotherLanguage) {
  Program program = program_of(
      "postfix 1\ndialect yun\nevaluation strict\nscan 1..100 ms\n"
      "input bit a\noutput bit q\nrungs\na q || =q\n");
  program.dialect = "logix";
  const std::string text = lowered_text(program);
  EXPECT_NE(text.find("\ndialect none\n"), std::string::npos) << text;
  EXPECT_EQ(lowered_text(program_of(lowered_binary(program))), text);
}

TEST(PostfixLowering, SaysWhatCannotBeExpressed) {
  const Program good = program_of(postfix_text(
      "input bit a\noutput bit q\nmemory word w in 0..9\nelement C(0) "
      "counter-yun\n",
      "a C(0,5) =q\n3 =w\n"));
  const auto changed = [&](auto change) {
    Program program = good;
    change(program);
    return inexpressible(program);
  };
  const auto contains = [](const std::string& said, const char* words) {
    return said.find(words) != std::string::npos;
  };
  EXPECT_TRUE(contains(
      changed([](Program& p) { p.calls[CallId(0)].parameter = 2147483648; }),
      "preset 2147483648"));
  EXPECT_TRUE(
      contains(changed([](Program& p) { p.nodes[2].value = -2147483649; }),
               "constant -2147483649"));
  EXPECT_TRUE(contains(
      changed([](Program& p) { p.cells[CellId(2)].high = 4294967296; }),
      "`w` starts at 0 in 0..4294967296"));
  EXPECT_TRUE(contains(changed([](Program& p) { p.cells[CellId(0)].low = 1; }),
                       "`a` starts at 0 in 1..1"));
  EXPECT_TRUE(
      contains(changed([](Program& p) { p.cells[CellId(0)].name = "a\"b"; }),
               "the name `a\"b`"));
  EXPECT_TRUE(contains(
      changed([](Program& p) { p.cells[CellId(0)].name = ""; }), "the name"));
  EXPECT_TRUE(contains(
      changed([](Program& p) { p.instances[InstanceId(0)].index = -1; }),
      "the index of `C(0)`"));
  EXPECT_TRUE(contains(changed([](Program& p) { p.scan.max_ms = 0; }),
                       "a scan of 1..0 ms"));
  EXPECT_TRUE(contains(
      changed([](Program& p) { p.annotations.push_back({.text = "a\nb"}); }),
      "property line"));
  EXPECT_TRUE(contains(changed([](Program& p) {
                         for (int i = 0; i < 65536; ++i) {
                           p.cells.add({.name = "x" + std::to_string(i)});
                         }
                       }),
                       "more than 65535 bit cells"));
  EXPECT_TRUE(contains(changed([](Program& p) {
                         for (int i = 0; i < 65536; ++i) {
                           p.instances.add(p.instances[InstanceId(0)]);
                         }
                       }),
                       "more than 65535 elements"));
}

std::string notes_of_rung(const std::string& rung) {
  DiagnosticList found;
  lower_to_postfix_text(
      program_of(postfix_text(
          "input word a in 0..1023\nmemory word w in "
          "-2147483648..2147483647\nmemory word v in -32768..32767\n",
          rung + "\n")),
      found);
  std::string said;
  for (const Diagnostic& item : found.items()) {
    EXPECT_EQ(item.code, "RP086");
    said += item.message + "\n";
  }
  return said;
}

TEST(PostfixLowering, NotesWhereTheMachineMayStop) {
  const std::string leaves = "this may leave 32 bits: the machine then stops\n";
  const std::string range =
      "the value may leave the range of `v`: the machine then stops\n";
  EXPECT_EQ(notes_of_rung("w 1 + =w"), leaves);
  EXPECT_EQ(notes_of_rung("w 1 - =w"), leaves);
  EXPECT_EQ(notes_of_rung("w neg =w"), leaves);
  EXPECT_EQ(notes_of_rung("w 2 * 2 / wrap16 =v"), leaves);
  EXPECT_EQ(notes_of_rung("w -1 / =w"), leaves);
  EXPECT_EQ(notes_of_rung("a 2099203 * =w"), leaves);
  EXPECT_EQ(notes_of_rung("a -2099203 * =w"), leaves);
  EXPECT_EQ(notes_of_rung("a 2099202 * =w"), "");
  EXPECT_EQ(notes_of_rung("w 1 / =w"), "");
  EXPECT_EQ(notes_of_rung("a 2147482624 + =w"), "");
  EXPECT_EQ(notes_of_rung("a 2147482625 + =w"), leaves);
  EXPECT_EQ(notes_of_rung("a -2147482625 - =w"), leaves);
  EXPECT_EQ(notes_of_rung("w -65536 / =v"), range);
  EXPECT_EQ(notes_of_rung("w -65537 / =v"), "");
  EXPECT_EQ(notes_of_rung("w wrap16 =v\na neg =v\na a == to_word =v"), "");
}

// A skip's distance has two bytes.
TEST(PostfixLowering, SaysWhatIsTooFarToSkip) {
  std::string rung = "a a RISE(0) ";
  for (int i = 0; i < 22000; ++i) rung += "a && ";
  const Program program =
      program_of(postfix_text("input bit a\noutput bit q\nelement E(0) edge\n",
                              rung + "&& =q\n", "short-circuit"));
  DiagnosticList errors;
  EXPECT_TRUE(lower_to_postfix_text(program, errors).has_value());
  EXPECT_FALSE(lower_to_postfix_binary(program, errors).has_value());
  ASSERT_EQ(errors.items().size(), 1U);
  EXPECT_EQ(errors.items()[0].message,
            "the right operand takes 66004 bytes: the format skips 65535 at "
            "most");
}

// A Program that is no tree in postorder must not become a file.
TEST(PostfixLowering, RefusesNodesOutOfOrder) {
  const Program good = program_of(postfix_text(
      "input bit a\ninput bit b\noutput bit q\nelement E(0) edge\n",
      "a b RISE(0) && =q\n", "short-circuit"));
  ASSERT_EQ(good.nodes.size(), 5U);  // a, branch, b, RISE, &&
  const auto broken = [&](auto change) {
    Program program = good;
    change(program);
    return inexpressible(program).find("is not in postfix order\n") !=
           std::string::npos;
  };
  EXPECT_TRUE(
      broken([](Program& p) { std::swap(p.nodes[4].a, p.nodes[4].b); }));
  EXPECT_TRUE(broken([](Program& p) { p.nodes[4].a = 2; }));
  EXPECT_TRUE(broken([](Program& p) { p.nodes[1].skip_when = true; }));
  EXPECT_TRUE(broken([](Program& p) { p.nodes[1].target = 3; }));
  EXPECT_TRUE(broken([](Program& p) { p.nodes[1].target = 5; }));
  EXPECT_TRUE(broken([](Program& p) { p.nodes[3].type = Type::Word; }));
  EXPECT_TRUE(broken([](Program& p) { p.nodes[2].op = NodeOp::Branch; }));
  EXPECT_TRUE(broken([](Program& p) { p.evaluation = Evaluation::Strict; }));
  EXPECT_TRUE(broken([](Program& p) { p.rungs[RungId(0)].end = 4; }));
  EXPECT_TRUE(
      broken([](Program& p) { p.rungs[RungId(0)].target = CellId(0); }));
  EXPECT_TRUE(broken([](Program& p) { p.calls[CallId(0)].arguments = {0}; }));
}

// --- random programs ---------------------------------------------------------

// Grows an expression as a stack of types and brings it down to one value.
class RandomText {
 public:
  explicit RandomText(unsigned seed) : random_(seed) {}

  std::string program() {
    const bool sim = pick(2) == 0;
    declarations_ = "input bit i0\ninput bit i1\noutput bit q0 = " +
                    std::to_string(pick(2)) +
                    "\nmemory bit m0\ninput word w0 in -100..300\n"
                    "memory word w1 in -32768..32767 = -7\n";
    if (sim) {
      elements_ = {"T(0,35ms)", "TOF(0,50ms)", "C(0,2)",
                   "RISE(0)",   "FALL(0)",     "T(1,0ms)"};
      declarations_ +=
          "element T(0) timer-sim\nelement T(1) timer-sim\nelement TOF(0) "
          "timer-off-sim\nelement C(0) counter-sim\nelement E(0) edge\n";
    } else {
      elements_ = {"T(0,35ms)", "TR(0)", "C(0,2)", "CR(0)", "RISE(1)"};
      declarations_ +=
          "element T(0) timer-yun\nelement C(0) counter-yun\nelement E(1) "
          "edge\n";
    }
    counter_bits_ = sim ? 3 : 1;
    std::string rungs;
    const unsigned count = 1 + pick(4);
    for (unsigned i = 0; i < count; ++i) rungs += rung();
    return postfix_text(declarations_, rungs,
                        pick(2) == 0 ? "strict" : "short-circuit");
  }

  unsigned pick(unsigned count) {
    return std::uniform_int_distribution<unsigned>(0, count - 1)(random_);
  }

 private:
  std::string rung() {
    static const std::vector<std::string> targets = {"=q0", "=m0", "=w1"};
    text_.clear();
    types_.clear();
    for (unsigned i = pick(12); i > 0; --i) grow();
    if (types_.empty()) push_bit("i0");
    while (types_.size() > 1) join();
    const std::string& target = targets[pick(3)];
    to(target == "=w1");
    return text_ + (target == "=w1" ? "wrap16 " : "") + target + "\n";
  }

  void grow() {
    static const std::vector<std::string> bits = {"i0", "i1",   "q0",
                                                  "m0", "true", "false"};
    static const std::vector<std::string> words = {"w0", "w1", "3", "-200",
                                                   "70000"};
    switch (pick(5)) {
      case 0:
      case 1:
        return push_bit(bits[pick(6)]);
      case 2:
        text_ += words[pick(5)] + " ";
        return types_.push_back(true);
      case 3:
        if (types_.size() > 1) join();
        return;
      default:
        return element();
    }
  }

  void push_bit(const std::string& name) {
    text_ += name + " ";
    types_.push_back(false);
  }

  void to(bool word) {
    if (types_.back() == word) return;
    text_ += word ? "to_word " : "to_bit ";
    types_.back() = word;
  }

  void join() {
    static const std::vector<std::string> bit_operators = {"&&", "||", "^"};
    static const std::vector<std::string> comparisons = {"==", "!=", "<",
                                                         "<=", ">",  ">="};
    static const std::vector<std::string> word_operators = {"+", "-", "*"};
    const bool word = types_[types_.size() - 2];
    to(word);
    types_.pop_back();
    if (!word) {
      text_ += bit_operators[pick(3)] + " ";
      if (pick(4) == 0) text_ += "! ";
    } else if (pick(2) == 0) {
      text_ += comparisons[pick(6)] + " ";
      types_.back() = false;
    } else {
      text_ += word_operators[pick(3)] + " ";
      if (pick(3) == 0) text_ += "3 / ";
      if (pick(3) == 0) text_ += "neg ";
      if (pick(4) != 0) text_ += "wrap16 ";
    }
  }

  void element() {
    const std::string& name =
        elements_[pick(static_cast<unsigned>(elements_.size()))];
    const unsigned bits = name[0] == 'C' && name[1] == '(' ? counter_bits_ : 1;
    if (types_.empty()) push_bit("i1");
    to(false);
    for (unsigned i = 1; i < bits; ++i) push_bit(i == 1 ? "i0" : "m0");
    text_ += name + " ";
    types_.resize(types_.size() - bits + 1);
  }

  std::mt19937 random_;
  std::string declarations_;
  std::vector<std::string> elements_;
  unsigned counter_bits_ = 1;
  std::string text_;
  std::vector<bool> types_;
};

// The scans until the machine stops at a fault, or all.
int expect_same_run(const Program& program, RandomText& random) {
  MachineRun run(program);
  EXPECT_EQ(run.error(), "");
  Simulator simulator(program);
  for (int scan = 0; scan < 40; ++scan) {
    for (const CellId id : ids_of(program.cells)) {
      const Cell& cell = program.cells[id];
      if (cell.role != CellRole::Input) continue;
      const auto span = static_cast<unsigned>(cell.high - cell.low + 1);
      const std::int64_t value = cell.low + random.pick(span);
      run.set_input(id, value);
      simulator.set_input(id, value);
    }
    const std::int64_t dt = 1 + random.pick(30);
    simulator.scan(dt);
    if (!run.scan(dt)) return scan;
    for (const CellId id : ids_of(program.cells)) {
      EXPECT_EQ(run.value(id), simulator.value(id))
          << program.cells[id].name << " in scan " << scan + 1;
    }
    if (::testing::Test::HasFailure()) return scan;
  }
  return 40;
}

TEST(PostfixRoundTrip, RandomProgramsRunAsTheSimulatorSays) {
  int faults = 0;
  for (unsigned seed = 1; seed <= 2000; ++seed) {
    RandomText random(seed);
    const std::string text = random.program();
    SCOPED_TRACE("seed " + std::to_string(seed) + "\n" + text);
    expect_round_trip(text);
    const Program program = program_of(text);
    faults += expect_same_run(program, random) == 40 ? 0 : 1;
    if (HasFailure()) return;
  }
  EXPECT_LT(faults, 400) << "too many runs end in an overflow to test much";
}

}  // namespace
}  // namespace rung
