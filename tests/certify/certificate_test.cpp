#include "smt/certificate.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "smt/cvc5.h"
#include "smt/smtlib.h"

namespace rung {
namespace {

LemmaAtom holds(ExprId term) { return {.term = term}; }
LemmaAtom fails(ExprId term) { return {.term = term, .negated = true}; }

/// Two motors, each locked out by the other; a clock that runs while the first
/// is on, and a counter that wraps at `top`.
struct Motors {
  TransitionSystem ts;
  ExprId a, b, clock, count, a_next, b_next, start_a, start_b;

  explicit Motors(std::int64_t top = 5) {
    ExprArena& e = ts.exprs;
    ts.scan = {1, 100};
    ts.dt = ts.add_input("dt", VarRole::Dt, Type::Word, 1, 100);
    start_a = input("start_a");
    start_b = input("start_b");
    const std::uint32_t sa = ts.add_state("a", Type::Bit, 0, 1, 0);
    const std::uint32_t sb = ts.add_state("b", Type::Bit, 0, 1, 0);
    const std::uint32_t sc = ts.add_state("clock", Type::Word, 0, 1000, 0);
    const std::uint32_t sn = ts.add_state("count", Type::Word, 0, 5, 0);
    a = ts.state_expr(sa);
    b = ts.state_expr(sb);
    clock = ts.state_expr(sc);
    count = ts.state_expr(sn);
    a_next = e.conjunction(e.disjunction(start_a, a), e.negation(b));
    b_next = e.conjunction(e.disjunction(start_b, b), e.negation(a_next));
    ts.states[sa].next = a_next;
    ts.states[sb].next = b_next;
    const ExprId grown = e.minimum(e.add(clock, ts.of(ts.dt)), e.word(1000));
    ts.states[sc].next = e.ite(a, grown, e.word(0));
    ts.states[sn].next =
        e.ite(e.less(count, e.word(top)), e.add(count, e.word(1)), e.word(0));
  }

  ExprId input(const std::string& name) {
    return ts.of(ts.add_input(name, VarRole::Input, Type::Bit, 0, 1));
  }
  ExprId never_both() {
    return ts.exprs.negation(ts.exprs.conjunction(a_next, b_next));
  }
  LemmaClause exclusive() const { return {fails(a), fails(b)}; }

  /// Whatever decides it, Z3 says the same.
  CertificateReport check(const Invariant& invariant,
                          const CertificateOptions& options = {}) {
    CertificateSession session;
    const std::vector<ExprId>& goals = invariant.conditions;
    if (options.recheck.empty()) {
      CertificateOptions both = options;
      both.recheck = "z3";
      EXPECT_EQ(session.check(ts, invariant, goals, both).outcome,
                session.check(ts, invariant, goals, options).outcome);
    }
    CertificateSession fresh;
    return fresh.check(ts, invariant, goals, options);
  }
};

void expect_rejected(const CertificateReport& report, const std::string& part,
                     const std::string& of) {
  EXPECT_EQ(report.outcome, CertificateOutcome::Rejected) << report.what;
  EXPECT_EQ(report.what.substr(0, part.size()), part);
  EXPECT_NE(report.what.find(of), std::string::npos) << report.what;
  EXPECT_TRUE(report.checked_by.empty());
}

TEST(Certificate, AnInductiveInvariantIsAccepted) {
  Motors m;
  const CertificateReport report =
      m.check({.lemmas = {m.exclusive()}, .conditions = {m.never_both()}});
  EXPECT_EQ(report.outcome, CertificateOutcome::Accepted) << report.what;
  ASSERT_EQ(report.checked_by.size(), 1U);
  EXPECT_NE(report.checked_by[0].find("proof followed"), std::string::npos);
  EXPECT_TRUE(report.smtlib_path.empty());
}

TEST(Certificate, BothWaysAreNamedWhereBothWereAsked) {
  Motors m;
  const CertificateReport report =
      m.check({.lemmas = {m.exclusive()}, .conditions = {m.never_both()}},
              {.recheck = "z3"});
  EXPECT_EQ(report.outcome, CertificateOutcome::Accepted) << report.what;
  ASSERT_EQ(report.checked_by.size(), 2U);
  EXPECT_EQ(report.checked_by[1], "z3 " + z3_version());
}

TEST(Certificate, ALemmaThatPowerUpBreaksIsNotInitial) {
  Motors m;
  const CertificateReport report =
      m.check({.lemmas = {m.exclusive(), {holds(m.a), holds(m.b)}},
               .conditions = {m.never_both()}});
  expect_rejected(report, "initiation", "a");
}

TEST(Certificate, ALemmaThatAScanBreaksIsNotInductive) {
  Motors m;
  const CertificateReport report =
      m.check({.lemmas = {m.exclusive(), {fails(m.a)}},
               .conditions = {m.never_both()}});
  expect_rejected(report, "consecution", "a");
}

TEST(Certificate, ALemmaThatIsTooWeakIsNotSafe) {
  Motors m;
  ExprArena& e = m.ts.exprs;
  // a never starts while b ran: true only because both never run at once.
  const ExprId wrong =
      e.negation(e.conjunction(m.start_a, e.conjunction(m.a_next, m.b)));
  EXPECT_EQ(m.check({.conditions = {wrong}}).outcome,
            CertificateOutcome::Accepted);
  const ExprId both = e.negation(e.conjunction(m.a, m.b));
  expect_rejected(m.check({.conditions = {both}}), "safety", "");
  EXPECT_EQ(m.check({.lemmas = {m.exclusive()}, .conditions = {both}}).outcome,
            CertificateOutcome::Accepted);
}

TEST(Certificate, TheEmptyLemmaIsFalse) {
  Motors m;
  expect_rejected(m.check({.lemmas = {{}}, .conditions = {m.never_both()}}),
                  "initiation", "");
}

TEST(Certificate, ARangeIsProvedLikeALemma) {
  // True of a count in 0 .. 5, and of no other.
  const auto claim = [](Motors& m) {
    ExprArena& e = m.ts.exprs;
    const ExprId sum = e.add(m.count, m.clock);
    return Invariant{
        .conditions = {e.disjunction(e.less(sum, e.word(1005)),
                                     e.equal(m.count, e.word(5)))}};
  };
  Motors good(5);
  const CertificateReport report = good.check(claim(good));
  EXPECT_EQ(report.outcome, CertificateOutcome::Accepted) << report.what;
  Motors bad(6);  // counts to 6, in a variable that ends at 5
  expect_rejected(bad.check(claim(bad)), "consecution", "the range of `count`");
}

TEST(Certificate, BitsOfWordsAreThoseOfTwosComplement) {
  Motors m;
  const VarId count = m.ts.exprs[m.count].var;
  const auto bit = [&](std::uint32_t i, bool negated) {
    return LemmaAtom{.var = count, .bit = i, .negated = negated};
  };
  // Never 6 or 7; and the range 0 .. 5 itself leaves bit 3 at 0.
  const Invariant right{
      .lemmas = {{bit(2, true), bit(1, true)}, {bit(3, true)}}};
  EXPECT_EQ(m.check(right).outcome, CertificateOutcome::Accepted);
  const Invariant wrong{.lemmas = {{bit(2, true), bit(0, true)}}};  // 5
  expect_rejected(m.check(wrong), "consecution", "count[2]");
}

TEST(Certificate, BitsOfNegativeWords) {
  TransitionSystem ts;
  ts.dt = ts.add_input("dt", VarRole::Dt, Type::Word, 1, 100);
  const std::uint32_t s = ts.add_state("x", Type::Word, -7, 0, 0);
  ExprArena& e = ts.exprs;
  const ExprId x = ts.state_expr(s);
  ts.states[s].next = e.ite(e.less(e.word(-7), x), e.add(x, e.word(-1)), x);
  const VarId var = ts.states[s].var;
  // -8 = ...1000 is not reached: some of bits 0 .. 2 is set, or x = 0.
  const Invariant right{.lemmas = {{{.var = var, .bit = 0},
                                    {.var = var, .bit = 1},
                                    {.var = var, .bit = 2},
                                    {.var = var, .bit = 3, .negated = true}}}};
  CertificateSession session;
  EXPECT_EQ(session.check(ts, right, {}, {}).outcome,
            CertificateOutcome::Accepted);
  // -1 = ...1111 has them all.
  const Invariant wrong{.lemmas = {{{.var = var, .bit = 0, .negated = true},
                                    {.var = var, .bit = 9, .negated = true}}}};
  expect_rejected(session.check(ts, wrong, {}, {}), "consecution", "x[9]");
}

TEST(Certificate, KInductionHasABaseAndAStep) {
  // A shift register a, b, c, and d that is fed as c is.
  TransitionSystem ts;
  ExprArena& e = ts.exprs;
  ts.dt = ts.add_input("dt", VarRole::Dt, Type::Word, 1, 100);
  std::vector<ExprId> bits;
  for (const char* name : {"a", "b", "c", "d"}) {
    bits.push_back(ts.state_expr(ts.add_state(name, Type::Bit, 0, 1, 0)));
  }
  ts.states[0].next =
      ts.of(ts.add_input("in", VarRole::Input, Type::Bit, 0, 1));
  ts.states[1].next = bits[0];
  ts.states[2].next = bits[1];
  ts.states[3].next = bits[1];
  const ExprId same = e.equivalence(bits[2], bits[3]);
  CertificateSession session;
  expect_rejected(session.check(ts, {.conditions = {same}}, {same}, {}),
                  "safety", "");
  EXPECT_EQ(
      session.check(ts, {.k = 1, .conditions = {same}}, {same}, {}).outcome,
      CertificateOutcome::Accepted);
  // A base that fails in the second scan.
  const ExprId soon = e.negation(bits[0]);
  expect_rejected(session.check(ts, {.k = 2, .conditions = {soon}}, {soon}, {}),
                  "initiation", "a");
}

TEST(Certificate, AssumptionsHold) {
  Motors m;
  const ExprId quiet = m.ts.exprs.negation(m.start_a);
  const Invariant invariant{.lemmas = {{fails(m.a)}}};
  expect_rejected(m.check(invariant), "consecution", "a");
  m.ts.constraints = {quiet};
  EXPECT_EQ(m.check(invariant).outcome, CertificateOutcome::Accepted);
}

TEST(Certificate, ARunMayEndWhereNoScanKeepsTheAssumptions) {
  // The assumption forbids every scan after a rose: a may still be true.
  Motors m;
  m.ts.constraints = {m.ts.exprs.negation(m.a)};
  const Invariant wrong{.k = 1, .lemmas = {{fails(m.a)}}};
  expect_rejected(m.check(wrong), "initiation", "a");
}

TEST(Certificate, AConsequenceFollowsFromTheLemmas) {
  Motors m;
  const ExprId both = m.ts.exprs.negation(m.ts.exprs.conjunction(m.a, m.b));
  expect_rejected(m.check({.consequences = {both}}), "safety", "consequence");
  EXPECT_EQ(
      m.check({.lemmas = {m.exclusive()}, .consequences = {both}}).outcome,
      CertificateOutcome::Accepted);
}

TEST(Certificate, AConsequenceIsAboutScansThatAreForbiddenToo) {
  Motors m;
  const ExprId quiet = m.ts.exprs.negation(m.start_a);
  m.ts.constraints = {quiet};
  EXPECT_EQ(m.check({.conditions = {quiet}}).outcome,
            CertificateOutcome::Accepted);
  expect_rejected(m.check({.consequences = {quiet}}), "safety", "consequence");
}

TEST(Certificate, AConsequenceHoldsInTheFirstScansToo) {
  // With k = 1 the step speaks of the second scan: a is off in the first only
  // where nothing was said of it.
  Motors m;
  const ExprId running = m.a;
  expect_rejected(m.check({.k = 1, .consequences = {running}}), "initiation",
                  "consequence");
}

TEST(Certificate, AnAssumptionAboutThePastTiesItsInputsToIt) {
  // The lemma is about what was, the condition about what is.
  Motors m;
  ExprArena& e = m.ts.exprs;
  const std::uint32_t was = m.ts.add_state("was", Type::Bit, 0, 1, 1);
  m.ts.states[was].next = m.start_a;
  const ExprId before = m.ts.state_expr(was);
  m.ts.constraints = {e.implication(before, m.start_a)};
  const Invariant always{.lemmas = {{holds(before)}},
                         .conditions = {m.start_a}};
  const CertificateReport report = m.check(always);
  EXPECT_EQ(report.outcome, CertificateOutcome::Accepted) << report.what;
}

TEST(Certificate, AGoalThatItDoesNotStateIsRejected) {
  Motors m;
  CertificateSession session;
  const CertificateReport report =
      session.check(m.ts, {.lemmas = {m.exclusive()}}, {m.never_both()}, {});
  expect_rejected(report, "it does not speak of", "");
}

TEST(Certificate, ALemmaOverAnInputIsNoLemma) {
  // In the last state it would have the value of the scan before.
  Motors m;
  const ExprId mixed = m.ts.exprs.disjunction(m.b, m.start_b);
  expect_rejected(m.check({.lemmas = {{fails(mixed), holds(mixed)}}}),
                  "a lemma names `start_b`", "");
}

TEST(Certificate, WordOperatorsMeanWhatTheirNamesSay) {
  TransitionSystem ts;
  ts.dt = ts.add_input("dt", VarRole::Dt, Type::Word, 1, 100);
  ExprArena& e = ts.exprs;
  const ExprId x =
      ts.of(ts.add_input("x", VarRole::Input, Type::Word, -70000, 70000));
  const auto fixed = [&](std::int64_t value, ExprId term,
                         std::int64_t expected) {
    return e.implication(e.equal(x, e.word(value)),
                         e.equal(term, e.word(expected)));
  };
  const std::vector<ExprId> right = {
      fixed(-7, e.divide(x, 2), -3),
      fixed(7, e.divide(x, 2), 3),
      fixed(-7, e.divide(x, -2), 3),
      fixed(7, e.divide(x, -2), -3),
      fixed(-8, e.divide(x, 3), -2),
      fixed(40000, e.wrap16(x), -25536),
      fixed(-40000, e.wrap16(x), 25536),
      fixed(-32768, e.wrap16(x), -32768),
      fixed(32768, e.wrap16(x), -32768),
      fixed(9, e.multiply(x, x), 81),
      fixed(5, e.ite(e.less(x, e.word(6)), e.negate(x), x), -5),
  };
  CertificateSession session;
  const CertificateReport report =
      session.check(ts, {.conditions = right}, right, {});
  EXPECT_EQ(report.outcome, CertificateOutcome::Accepted) << report.what;
  for (const ExprId wrong :
       {fixed(-7, e.divide(x, 2), -4), fixed(-7, e.divide(x, -2), 4),
        fixed(40000, e.wrap16(x), 40000), fixed(9, e.multiply(x, x), 80)}) {
    expect_rejected(session.check(ts, {.conditions = {wrong}}, {wrong}, {}),
                    "safety", "");
  }
}

TEST(Certificate, DeepTermsStaySmallText) {
  TransitionSystem ts;
  ts.dt = ts.add_input("dt", VarRole::Dt, Type::Word, 1, 100);
  ExprArena& e = ts.exprs;
  const std::uint32_t s = ts.add_state("q", Type::Bit, 0, 1, 0);
  ExprId term = ts.state_expr(s);
  for (int i = 0; i < 20000; ++i) {
    const ExprId in = ts.of(
        ts.add_input("i" + std::to_string(i), VarRole::Input, Type::Bit, 0, 1));
    const ExprId both = e.conjunction(e.negation(term), in);
    term = e.disjunction(both, e.conjunction(term, e.negation(in)));
  }
  ts.states[s].next = e.conjunction(term, ts.state_expr(s));
  const Invariant invariant{.lemmas = {{fails(ts.state_expr(s))}}};
  const CertificateScript script = make_certificate_script(ts, invariant);
  EXPECT_LT(script.text.size(), 20000U * 400U);
  CertificateSession session;
  EXPECT_EQ(session.check(ts, invariant, {}, {}).outcome,
            CertificateOutcome::Accepted);
}

// --- files and cvc5 ----------------------------------------------------------

class TemporaryFolder : public testing::Test {
 protected:
  void SetUp() override {
    std::string name =
        (std::filesystem::temp_directory_path() / "rung-XXXXXX").string();
    ASSERT_NE(mkdtemp(name.data()), nullptr);
    folder = name;
  }
  void TearDown() override { std::filesystem::remove_all(folder); }
  static std::string content(const std::filesystem::path& path) {
    std::ifstream in(path);
    std::ostringstream text;
    text << in.rdbuf();
    return text.str();
  }
  std::filesystem::path folder;
};
using CertificateFile = TemporaryFolder;

TEST_F(CertificateFile, IsWrittenOnRequestUnderASafeName) {
  Motors m;
  CertificateOptions options;
  options.smtlib_directory = (folder / "new").string();
  options.name = "../a b;c";
  const CertificateReport report = m.check(
      {.lemmas = {m.exclusive()}, .conditions = {m.never_both()}}, options);
  EXPECT_EQ(report.outcome, CertificateOutcome::Accepted) << report.what;
  EXPECT_EQ(report.smtlib_path, (folder / "new" / "_._a_b_c.smt2").string());
  const std::string text = content(report.smtlib_path);
  EXPECT_NE(text.find("(set-logic QF_LIA)"), std::string::npos);
  EXPECT_NE(text.find("(check-sat-assuming (initial"), std::string::npos);
  m.check({.lemmas = {m.exclusive()}, .conditions = {m.never_both()}}, options);
  EXPECT_EQ(content(report.smtlib_path), text);
}

TEST_F(CertificateFile, AFolderThatCannotBeIsUndecided) {
  std::ofstream(folder / "file") << "x";
  Motors m;
  CertificateOptions options;
  options.smtlib_directory = (folder / "file" / "below").string();
  const CertificateReport report =
      m.check({.lemmas = {m.exclusive()}}, options);
  EXPECT_EQ(report.outcome, CertificateOutcome::Undecided);
  EXPECT_NE(report.what.find("cannot write"), std::string::npos);
}

TEST(Recheck, AnUnknownSolverIsUndecided) {
  Motors m;
  CertificateOptions options;
  options.recheck = "sh";
  const CertificateReport report =
      m.check({.lemmas = {m.exclusive()}}, options);
  EXPECT_EQ(report.outcome, CertificateOutcome::Undecided);
}

TEST(Recheck, AMissingBinaryIsAClearError) {
  const std::string path = std::getenv("PATH");
  ASSERT_EQ(setenv("PATH", "/nonexistent", 1), 0);
  Motors m;
  CertificateOptions options;
  options.recheck = "cvc5";
  const CertificateReport report =
      m.check({.lemmas = {m.exclusive()}}, options);
  setenv("PATH", path.c_str(), 1);
  EXPECT_EQ(report.outcome, CertificateOutcome::Undecided);
  EXPECT_NE(report.what.find("cannot run `cvc5`"), std::string::npos)
      << report.what;
}

/// A fake `cvc5` first in PATH, that answers as told.
class FakeCvc5 : public TemporaryFolder {
 protected:
  CertificateReport check_with(const std::string& script, double seconds = 10) {
    const std::filesystem::path fake = folder / "cvc5";
    std::ofstream(fake) << "#!/bin/sh\n[ \"$1\" = --version ] && echo "
                        << "'This is cvc5 version 9.9' && exit 0\n"
                        << script << "\n";
    std::filesystem::permissions(fake, std::filesystem::perms::owner_all);
    const std::string path = std::getenv("PATH");
    setenv("PATH", (folder.string() + ":" + path).c_str(), 1);
    Motors m;
    CertificateOptions options;
    options.recheck = "cvc5";
    options.seconds = seconds;
    const CertificateReport report = m.check(
        {.lemmas = {m.exclusive()}, .conditions = {m.never_both()}}, options);
    setenv("PATH", path.c_str(), 1);
    return report;
  }
};

TEST_F(FakeCvc5, ThatAgreesIsNamed) {
  const CertificateReport report =
      check_with("printf 'unsat\\nunsat\\nunsat\\n'");
  EXPECT_EQ(report.outcome, CertificateOutcome::Accepted) << report.what;
  ASSERT_EQ(report.checked_by.size(), 2U);
  EXPECT_EQ(report.checked_by[1], "cvc5 9.9");
}

TEST_F(FakeCvc5, ThatDisagreesRejects) {
  const CertificateReport report =
      check_with("printf 'unsat\\nsat\\nunsat\\n'");
  EXPECT_EQ(report.outcome, CertificateOutcome::Rejected);
  EXPECT_NE(report.what.find("consecution"), std::string::npos);
}

TEST_F(FakeCvc5, ThatSaysLessDecidesNothing) {
  for (const char* script :
       {"printf 'unsat\\nunsat\\n'", "printf 'unsat\\nunknown\\nunsat\\n'",
        "printf 'unsat\\nunsat\\nunsat\\nunsat\\n'", "echo oops",
        "printf 'unsat\\nunsat\\nunsat\\n'; exit 3", "true"}) {
    EXPECT_EQ(check_with(script).outcome, CertificateOutcome::Undecided)
        << script;
  }
}

TEST_F(FakeCvc5, ThatHangsIsEnded) {
  const CertificateReport report = check_with("exec sleep 100", 0.2);
  EXPECT_EQ(report.outcome, CertificateOutcome::Undecided);
  EXPECT_NE(report.what.find("time-out"), std::string::npos) << report.what;
}

TEST_F(CertificateFile, TheRealCvc5Agrees) {
  if (std::system("cvc5 --version > /dev/null 2>&1") != 0) {
    GTEST_SKIP() << "no cvc5 here";
  }
  Motors m;
  const VarId count = m.ts.exprs[m.count].var;
  CertificateOptions options;
  options.recheck = "cvc5";
  const Invariant right{.k = 1,
                        .lemmas = {m.exclusive(),
                                   {{.var = count, .bit = 2, .negated = true},
                                    {.var = count, .bit = 1, .negated = true}}},
                        .conditions = {m.never_both()}};
  const CertificateReport report = m.check(right, options);
  EXPECT_EQ(report.outcome, CertificateOutcome::Accepted) << report.what;
  EXPECT_EQ(report.checked_by.size(), 2U);
  // What Z3 rejects, cvc5 rejects on its own as well.
  const Invariant wrong{.lemmas = {{fails(m.a)}}};
  const std::string path = (folder / "wrong.smt2").string();
  std::ofstream(path) << make_certificate_script(m.ts, wrong).file("wrong");
  const SolverAnswers said = run_cvc5(path, 60);
  EXPECT_EQ(said.answers, (std::vector<std::string>{"unsat", "sat"}));
}

}  // namespace
}  // namespace rung
