// Equal parts of a program are decided once; each has its own verdict.

#include "smt/alike.h"

#include <gtest/gtest.h>

#include <array>
#include <map>
#include <string>

#include "smt/merged_run.h"
#include "smt/partition.h"
#include "smt/verdicts.h"
#include "smt/verify.h"
#include "source.h"

namespace rung {
namespace {

/// Text with each `#` replaced.
std::string cell(std::string text, const std::string& number) {
  for (std::size_t at = 0; (at = text.find('#', at)) != std::string::npos;) {
    text.replace(at, 1, number);
  }
  return text;
}

std::string cells(const std::string& text, int count) {
  std::string all;
  for (int i = 0; i < count; ++i) all += cell(text, std::to_string(i));
  return all;
}

/// By the name with `#` for its digits; which must be one digit.
std::map<std::string, ObligationResult> results(const VerifyReport& report,
                                                char number) {
  std::map<std::string, ObligationResult> found;
  for (const ObligationResult& result : report.results) {
    std::string name = result.obligation.name;
    if (name.find(number) == std::string::npos) continue;
    for (char& c : name) c = c == number ? '#' : c;
    found.emplace(name, result);
  }
  return found;
}

constexpr const char* kCell =
    "//@ input Fwd#\n//@ input Rev#\n//@ input Stop#\n"
    "//@ lock#: interlock KF#, KR#\n"
    "//@ start#: latch KF# set Fwd# && !KR# reset Stop#\n"
    "//@ speed#: always Run# -> KF#\n"
    "//@ wrong#: never Run#\n"
    "//@ both#: reach KF# && KR#\n"
    "//@ runs#: reach Run# && Rev#\n"
    "//@ empty#: always (KF# && KR#) -> Run#\n"
    "KF# = (Fwd# || KF#) && !Stop# && !KR#;\n"
    "KR# = (Rev# || KR#) && !Stop# && !KF#;\n"
    "Run# = T(#, 5, KF#);\n";

void expect_like(const VerifyReport& one, const VerifyReport& many, int count) {
  EXPECT_TRUE(many.failures.empty());
  const auto expected = results(one, '0');
  ASSERT_EQ(expected.count("wrong#"), 1U);
  EXPECT_EQ(expected.at("lock#").verdict, Verdict::Proved);
  EXPECT_EQ(expected.at("wrong#").verdict, Verdict::Violated);
  EXPECT_EQ(expected.at("both#").verdict, Verdict::Violated);
  EXPECT_EQ(expected.at("runs#").verdict, Verdict::Proved);
  EXPECT_EQ(expected.at("empty#").verdict, Verdict::Vacuous);
  for (int i = 0; i < count; ++i) {
    const auto found = results(many, static_cast<char>('0' + i));
    ASSERT_EQ(found.size(), expected.size()) << i;
    for (const auto& [name, result] : expected) {
      const ObligationResult& copy = found.at(name);
      EXPECT_EQ(copy.verdict, result.verdict) << name << ", " << i;
      EXPECT_EQ(copy.reason, result.reason) << name << ", " << i;
      EXPECT_EQ(copy.trace.has_value(), result.trace.has_value()) << name;
      EXPECT_EQ(copy.certificate.has_value(), result.certificate.has_value());
      if (result.trace) {
        EXPECT_EQ(copy.scans, result.scans) << name;
      }
    }
  }
}

TEST(Alike, EachCopyHasTheVerdictsOfOne) {
  const Source one(cells(kCell, 1));
  const Source many(cells(kCell, 5));
  expect_like(verify(one.program, one.properties, {}),
              verify(many.program, many.properties, {}), 5);
}

TEST(Alike, EachEngineByItself) {
  const Source one(cells(kCell, 1));
  const Source many(cells(kCell, 3));
  for (const EngineInfo& engine : engines()) {
    VerifyOptions options;
    options.engine = engine.name;
    const VerifyReport report = verify(many.program, many.properties, options);
    EXPECT_TRUE(report.failures.empty()) << engine.name;
    for (int i = 1; i < 3; ++i) {
      const auto first = results(report, '0');
      const auto copy = results(report, static_cast<char>('0' + i));
      for (const auto& [name, result] : first) {
        EXPECT_EQ(copy.at(name).verdict, result.verdict)
            << engine.name << ": " << name;
      }
    }
  }
}

TEST(Alike, ATraceIsOfItsOwnInputs) {
  const Source many(cells(kCell, 3));
  const VerifyReport report = verify(many.program, many.properties, {});
  const auto last = results(report, '2');
  ASSERT_TRUE(last.at("wrong#").trace.has_value());
  const Trace& trace = *last.at("wrong#").trace;
  const auto at_end = [&](const std::string& name) {
    for (std::uint32_t i = 0; i < many.program.cells.size(); ++i) {
      if (many.program.cells[CellId(i)].name == name) {
        return trace.steps.back().values[i];
      }
    }
    return std::int64_t{-1};
  };
  EXPECT_EQ(at_end("Run2"), 1);
  EXPECT_EQ(at_end("Run0"), 0);
}

TEST(Alike, WrongAnswersOfCopiesFailTheirChecks) {
  const Source many(cells(kCell, 3));
  VerifyOptions options;
  options.inject_wrong_invariant = true;
  options.inject_wrong_trace = true;
  const VerifyReport report = verify(many.program, many.properties, options);
  for (const ObligationResult& result : report.results) {
    EXPECT_FALSE(result.certificate.has_value()) << result.obligation.name;
    EXPECT_FALSE(result.trace.has_value()) << result.obligation.name;
    EXPECT_NE(result.verdict, Verdict::Proved) << result.obligation.name;
  }
}

TEST(Alike, SharedInputsMayPlayOtherParts) {
  // What starts one stops the other.
  const std::string text =
      "//@ run0: reach Q0 && !I0\n"
      "//@ run1: reach Q1 && !I1\n"
      "//@ off0: always I1 -> !Q0\n"
      "//@ off1: always I0 -> !Q1\n"
      "//@ some: reach L0 && L1\n"
      "Q0 = (I0 || Q0) && !I1;\n"
      "Q1 = (I1 || Q1) && !I0;\n"
      "L0 = (I2 || L0) && !I0;\n"
      "L1 = (I2 || L1) && !I1;\n";
  const Source source(text);
  const VerifyReport report = verify(source.program, source.properties, {});
  EXPECT_TRUE(report.failures.empty());
  for (const ObligationResult& result : report.results) {
    EXPECT_EQ(result.verdict, Verdict::Proved) << result.obligation.name;
  }
}

TEST(Alike, AnInputThatOtherPartsReadToo) {
  // Runs of the first register are none for the second: its `I3` is also that
  // of a timer with a preset of its own.
  std::string text = "Q0 = T(0, 5, I1);\nQ1 = T(1, 6, I3);\n";
  for (const auto& [q, a, b] :
       {std::array<const char*, 3>{"M", "I0", "I1"}, {"N", "I2", "I3"}}) {
    const std::string both = std::string(a) + " && " + b;
    const std::string none = std::string("!") + a + " && !" + b;
    const std::string equal = "(" + both + " || " + none + ");\n";
    for (int i = 14; i > 0; --i) {
      text += q + std::to_string(i) + " = " + q + std::to_string(i - 1) +
              " && " + equal;
    }
    text += std::string(q) + "0 = " + equal;
  }
  text += "Q2 = M14; Q3 = N14;\n";
  const Source source(text);
  const VerifyReport report = verify(source.program, source.properties, {});
  EXPECT_TRUE(report.failures.empty());
  for (const ObligationResult& result : report.results) {
    EXPECT_EQ(result.verdict, Verdict::Proved) << result.obligation.name;
  }
}

// --- what is alike -----------------------------------------------------------

std::vector<std::size_t> models(const std::string& text) {
  const Source source(text);
  TransitionSystem ts = build_transition_system(source.program);
  const Questions questions =
      make_questions(source.program, source.properties, {}, ts);
  std::vector<ExprId> roots;
  for (const Target& target : questions.targets) roots.push_back(target.term);
  const auto parts = partition(ts, roots);
  const AlikeParts alike(ts, questions.targets, parts);
  std::vector<std::size_t> result;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    result.push_back(alike.model(i));
  }
  return result;
}

TEST(Alike, CopiesOfOneCell) {
  EXPECT_EQ(models(cells(kCell, 3)), (std::vector<std::size_t>{0, 0, 0}));
}

TEST(Alike, WhatDiffersIsNotAlike) {
  const std::string base = "Q0 = T(0, 5, I0);\n";
  const char* others[] = {
      "Q1 = T(1, 6, I1);\n",                      // another preset
      "Q1 = T(1, 5, !I1);\n",                     // another condition
      "//@ never Q1 && I1\nQ1 = T(1, 5, I1);\n",  // another question
      "//@ reach Q1\nQ1 = T(1, 5, I1);\n",  // the same, and its run is shown
  };
  EXPECT_EQ(models(base + "Q1 = T(1, 5, I1);\n"),
            (std::vector<std::size_t>{0, 0}));
  for (const char* other : others) {
    EXPECT_EQ(models(base + other), (std::vector<std::size_t>{0, 1})) << other;
  }
}

TEST(Alike, AnInitialValueCounts) {
  const auto with = [](const std::string& value) {
    return models("M0 = M0 && I0;\nM1 = M1 && I1;\n//Var\nM1 = " + value +
                  ";\n");
  };
  EXPECT_EQ(with("false"), (std::vector<std::size_t>{0, 0}));
  EXPECT_EQ(with("true"), (std::vector<std::size_t>{0, 1}));
}

TEST(Partition, AnInputBelongsToItsOneReader) {
  TransitionSystem ts;
  ExprArena& e = ts.exprs;
  ts.dt = ts.add_input("dt", VarRole::Dt, Type::Word, 1, 100);
  const auto input = [&](const char* name) {
    return ts.of(ts.add_input(name, VarRole::Input, Type::Bit, 0, 1));
  };
  const ExprId own = input("own");
  const ExprId shared = input("shared");
  const ExprId nobodys = input("nobody's");
  std::vector<ExprId> states;
  for (const char* name : {"a", "b"}) {
    const std::uint32_t s = ts.add_state(name, Type::Bit, 0, 1, 0);
    states.push_back(ts.state_expr(s));
  }
  ts.states[0].next = e.conjunction(shared, e.negation(own));
  ts.states[1].next = shared;
  const auto parts =
      partition(ts, {states[0], states[1], own, shared, nobodys,
                     e.conjunction(own, nobodys), e.conjunction(own, shared)});
  EXPECT_EQ(parts, (std::vector<std::vector<std::size_t>>{
                       {0, 2, 5}, {1}, {3}, {4}, {6}}));
}

TEST(MergedRun, TakesRunsThatAgree) {
  TransitionSystem ts;
  ts.scan = {1, 100};
  ts.dt = ts.add_input("dt", VarRole::Dt, Type::Word, 1, 100);
  const VarId a = ts.add_input("a", VarRole::Input, Type::Bit, 0, 1);
  const VarId b = ts.add_input("b", VarRole::Input, Type::Bit, 0, 1);
  const FoundRun of_a = {{a, ts.dt}, {{{1, 5}, 0}, {{0, 7}, 30}}};
  const FoundRun of_b = {{ts.dt, b}, {{{5, 0}, 0}, {{7, 1}, 30}}};
  const FoundRun other = {{ts.dt, b}, {{{5, 1}, 0}, {{7, 1}, 30}}};
  EXPECT_EQ(beats_of(ts, of_a), beats_of(ts, of_b));
  MergedRun merged;
  EXPECT_TRUE(merged.add(ts, of_a));
  EXPECT_TRUE(merged.add(ts, of_b));
  EXPECT_TRUE(merged.add(ts, of_a));
  EXPECT_FALSE(merged.add(ts, other));
  EXPECT_EQ(merged.run().inputs, (std::vector<VarId>{ts.dt, a, b}));
  EXPECT_EQ(merged.run().steps[1].inputs, (std::vector<std::int64_t>{7, 0, 1}));
  EXPECT_EQ(merged.run().steps[1].delta, 30);
}

}  // namespace
}  // namespace rung
