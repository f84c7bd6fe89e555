// Equal parts of a program need one solver run, and claims that are too hard
// for the solver leave the others theirs.

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "smt/certificate.h"
#include "smt/smtlib.h"

namespace rung {
namespace {

LemmaAtom holds(ExprId term) { return {.term = term}; }
LemmaAtom fails(ExprId term) { return {.term = term, .negated = true}; }

struct CellOptions {
  std::int64_t preset = 100;
  std::int64_t initial_clock = 0;
  std::int64_t highest_level = 9;
  bool initial_b = false;
  bool both_at_once = false;  // a mistake: a does not look at b
};

/// One of many alike: two motors that lock each other out, a clock that runs
/// while the first is on, and a level that is read.
struct Cell {
  ExprId a, b, clock_next, a_next, b_next, level;

  Cell(TransitionSystem& ts, const std::string& name,
       const CellOptions& options = {}) {
    ExprArena& e = ts.exprs;
    const auto input = [&](const char* of, Type type, std::int64_t high) {
      return ts.of(
          ts.add_input(name + "." + of, VarRole::Input, type, 0, high));
    };
    const ExprId start_a = input("start_a", Type::Bit, 1);
    const ExprId start_b = input("start_b", Type::Bit, 1);
    level = input("level", Type::Word, options.highest_level);
    const std::uint32_t sa = ts.add_state(name + ".a", Type::Bit, 0, 1, 0);
    const std::uint32_t sb =
        ts.add_state(name + ".b", Type::Bit, 0, 1, options.initial_b ? 1 : 0);
    const std::uint32_t sc = ts.add_state(
        name + ".clock", Type::Word, 0, options.preset, options.initial_clock);
    a = ts.state_expr(sa);
    b = ts.state_expr(sb);
    const ExprId clock = ts.state_expr(sc);
    const ExprId free = options.both_at_once ? e.bit(true) : e.negation(b);
    a_next = e.conjunction(e.disjunction(start_a, a), free);
    b_next = e.conjunction(e.disjunction(start_b, b), e.negation(a_next));
    ts.states[sa].next = a_next;
    ts.states[sb].next = b_next;
    const ExprId grown =
        e.minimum(e.add(clock, ts.of(ts.dt)), e.word(options.preset));
    clock_next = e.ite(a, grown, e.word(0));
    ts.states[sc].next = clock_next;
  }

  /// Never both, and the clock is above the level only after a ran.
  Invariant proof(TransitionSystem& ts) const {
    ExprArena& e = ts.exprs;
    const ExprId safe = e.negation(e.conjunction(a_next, b_next));
    const ExprId late = e.implication(e.less(level, clock_next), a);
    return {.lemmas = {{fails(a), fails(b)}}, .conditions = {safe, late}};
  }
};

class Reuse : public testing::Test {
 protected:
  Reuse() {
    ts.dt = ts.add_input("dt", VarRole::Dt, Type::Word, 1, 100);
    ts.scan = {1, 100};
  }
  CertificateReport check(const Invariant& invariant,
                          const CertificateOptions& options = {}) {
    return session.check(ts, invariant, invariant.conditions, options);
  }
  void expect_asked(const CertificateReport& report) {
    EXPECT_EQ(report.outcome, CertificateOutcome::Accepted) << report.what;
    EXPECT_FALSE(report.reused);
  }

  TransitionSystem ts;
  CertificateSession session;
};

TEST_F(Reuse, APartThatDiffersInNamesOnlyNeedsNoSolver) {
  const Cell first(ts, "first");
  const Cell second(ts, "second");
  const CertificateReport asked = check(first.proof(ts));
  expect_asked(asked);
  const CertificateReport known = check(second.proof(ts));
  EXPECT_EQ(known.outcome, CertificateOutcome::Accepted) << known.what;
  EXPECT_TRUE(known.reused);
  EXPECT_EQ(known.checked_by, asked.checked_by);
}

TEST_F(Reuse, WithoutTimeOnlyWhatIsKnownIsAccepted) {
  const Cell first(ts, "first");
  const Cell second(ts, "second");
  const Cell other(ts, "other", {.preset = 101});
  expect_asked(check(first.proof(ts)));
  const CertificateOptions none = {.seconds = 0};
  EXPECT_EQ(check(second.proof(ts), none).outcome,
            CertificateOutcome::Accepted);
  EXPECT_EQ(check(other.proof(ts), none).outcome,
            CertificateOutcome::Undecided);
}

TEST_F(Reuse, APartThatDiffersIsAsked) {
  const Cell first(ts, "first");
  expect_asked(check(first.proof(ts)));
  const CellOptions different[] = {
      {.preset = 101},
      {.initial_clock = 1},
      {.highest_level = 8},
  };
  for (const CellOptions& options : different) {
    const Cell other(ts, "other", options);
    expect_asked(check(other.proof(ts)));
  }
  const Cell deaf(ts, "deaf", {.both_at_once = true});
  EXPECT_FALSE(check(deaf.proof(ts)).reused);
  // Another claim, another k.
  const Cell second(ts, "second");
  Invariant less = second.proof(ts);
  less.conditions.pop_back();
  expect_asked(check(less));
  Invariant k = second.proof(ts);
  k.k = 1;
  expect_asked(check(k));
}

TEST_F(Reuse, AnInitialValueThatBreaksALemmaIsRejected) {
  const auto never = [&](const std::string& name, std::int64_t init) {
    const std::uint32_t s = ts.add_state(name, Type::Bit, 0, 1, init);
    ts.states[s].next = ts.state_expr(s);
    return Invariant{.lemmas = {{fails(ts.state_expr(s))}}};
  };
  expect_asked(check(never("off", 0)));
  EXPECT_TRUE(check(never("off too", 0)).reused);
  const CertificateReport report = check(never("on", 1));
  EXPECT_EQ(report.outcome, CertificateOutcome::Rejected);
  EXPECT_EQ(report.what, "initiation of lemma `!on`");
}

TEST_F(Reuse, AWrongInvariantOfTheSecondCopyIsRejected) {
  const Cell first(ts, "first");
  const Cell second(ts, "second");
  expect_asked(check(first.proof(ts)));
  Invariant wrong = second.proof(ts);
  wrong.lemmas.emplace_back();
  EXPECT_EQ(check(wrong).outcome, CertificateOutcome::Rejected);
  Invariant stronger = second.proof(ts);
  stronger.lemmas.push_back({fails(second.a)});
  const CertificateReport report = check(stronger);
  EXPECT_EQ(report.outcome, CertificateOutcome::Rejected);
  EXPECT_NE(report.what.find("`!second.a`"), std::string::npos) << report.what;
  // A rejection is no acceptance when it comes again.
  EXPECT_EQ(check(stronger).outcome, CertificateOutcome::Rejected);
}

TEST_F(Reuse, LemmasOfTheWrongCopyAreNotTakenForItsOwn) {
  const Cell first(ts, "first");
  const Cell second(ts, "second");
  expect_asked(check(first.proof(ts)));
  Invariant mixed = second.proof(ts);
  mixed.lemmas = first.proof(ts).lemmas;
  EXPECT_FALSE(check(mixed).reused);
  mixed.lemmas = {{fails(second.a), fails(first.b)}};
  EXPECT_EQ(check(mixed).outcome, CertificateOutcome::Rejected);
}

TEST_F(Reuse, AGoalOfAnotherCopyIsNotCovered) {
  const Cell first(ts, "first");
  const Cell second(ts, "second");
  expect_asked(check(first.proof(ts)));
  const Invariant proof = first.proof(ts);
  const CertificateReport report =
      session.check(ts, proof, second.proof(ts).conditions, {});
  EXPECT_EQ(report.outcome, CertificateOutcome::Rejected);
}

TEST_F(Reuse, AnAssumptionIsPartOfTheScript) {
  const Cell first(ts, "first");
  const auto never_a = [](const Cell& cell) {
    return Invariant{.lemmas = {{fails(cell.a)}}};
  };
  TransitionSystem assumed = ts;
  assumed.constraints = {assumed.exprs.negation(first.a_next)};
  EXPECT_EQ(session.check(assumed, never_a(first), {}, {}).outcome,
            CertificateOutcome::Accepted);
  EXPECT_EQ(check(never_a(first)).outcome, CertificateOutcome::Rejected);
}

TEST_F(Reuse, NamesOfTheProgramAreInTheFileOnly) {
  const Cell first(ts, "first");
  const Cell second(ts, "second");
  const CertificateScript a = make_certificate_script(ts, first.proof(ts));
  const CertificateScript b = make_certificate_script(ts, second.proof(ts));
  EXPECT_EQ(a.body(), b.body());
  EXPECT_EQ(a.body().find("first"), std::string::npos);
  EXPECT_NE(a.file("x").find("first.clock"), std::string::npos);
  EXPECT_NE(a.file("x").find(a.body()), std::string::npos);
}

TEST_F(Reuse, WhatOneSolverAcceptedAnotherIsStillAsked) {
  std::string folder =
      (std::filesystem::temp_directory_path() / "rung-XXXXXX").string();
  ASSERT_NE(mkdtemp(folder.data()), nullptr);
  const std::filesystem::path fake = std::filesystem::path(folder) / "cvc5";
  std::ofstream(fake) << "#!/bin/sh\necho sat\n";
  std::filesystem::permissions(fake, std::filesystem::perms::owner_all);
  const std::string path = std::getenv("PATH");
  setenv("PATH", (folder + ":" + path).c_str(), 1);
  const Cell first(ts, "first");
  expect_asked(check(first.proof(ts)));
  const CertificateReport report = check(first.proof(ts), {.recheck = "cvc5"});
  EXPECT_EQ(check(first.proof(ts), {.recheck = "cvc5"}).outcome,
            CertificateOutcome::Rejected);
  setenv("PATH", path.c_str(), 1);
  std::filesystem::remove_all(folder);
  EXPECT_EQ(report.outcome, CertificateOutcome::Rejected) << report.what;
}

// --- claims that are too hard ------------------------------------------------

class TooHard : public Reuse {
 protected:
  /// Fermat's theorem for cubes, while a is on: true, and beyond the solver.
  ExprId hard(const Cell& cell) {
    ExprArena& e = ts.exprs;
    const auto cube = [&](const char* name) {
      const ExprId x =
          ts.of(ts.add_input(name, VarRole::Input, Type::Word, 1, 100'000));
      return e.multiply(e.multiply(x, x), x);
    };
    const ExprId sum = e.add(cube("x"), cube("y"));
    return e.negation(e.conjunction(cell.a, e.equal(sum, cube("z"))));
  }
  // Enough for the easy claims on a busy machine under sanitizers, too little
  // for the cubes.
  const CertificateOptions shortly = {.seconds = 4};
};

TEST_F(TooHard, ConditionsLeaveTheOthersTheirProof) {
  const Cell cell(ts, "cell");
  Invariant proof = cell.proof(ts);
  const std::vector<ExprId> easy = proof.conditions;
  proof.conditions.insert(proof.conditions.begin(), hard(cell));
  const CertificateReport report = check(proof, shortly);
  EXPECT_EQ(report.outcome, CertificateOutcome::Undecided);
  EXPECT_NE(report.what.find("safety"), std::string::npos) << report.what;
  EXPECT_EQ(report.shown, easy);
  EXPECT_TRUE(report.dropped.empty());
  ASSERT_EQ(report.checked_by.size(), 1U);
}

TEST_F(TooHard, LemmasAreDroppedAndNamed) {
  const Cell cell(ts, "cell");
  Invariant proof = cell.proof(ts);
  // Of what is remembered, and not of an input.
  const ExprId condition = hard(cell);
  const std::uint32_t s = ts.add_state("fermat", Type::Bit, 0, 1, 1);
  ts.states[s].next = condition;
  proof.lemmas.push_back({holds(ts.state_expr(s)), fails(cell.a)});
  const CertificateReport report = check(proof, shortly);
  EXPECT_EQ(report.outcome, CertificateOutcome::Undecided);
  EXPECT_EQ(report.shown, proof.conditions);
  ASSERT_EQ(report.dropped.size(), 1U);
  EXPECT_EQ(to_string(ts, report.dropped[0]), "fermat || !cell.a");
}

TEST_F(TooHard, WhatRestsOnItIsNotShown) {
  const Cell cell(ts, "cell");
  const ExprId condition = hard(cell);
  const std::uint32_t s = ts.add_state("fermat", Type::Bit, 0, 1, 1);
  ts.states[s].next = condition;
  const ExprId state = ts.state_expr(s);
  const ExprId rests = ts.exprs.disjunction(state, ts.exprs.negation(cell.a));
  const Invariant proof = {.lemmas = {{holds(state)}}, .conditions = {rests}};
  const CertificateReport report = check(proof, shortly);
  EXPECT_EQ(report.outcome, CertificateOutcome::Undecided);
  EXPECT_TRUE(report.shown.empty());
  EXPECT_EQ(report.dropped.size(), 1U);
}

TEST_F(TooHard, AWrongClaimBesideItIsNotShown) {
  // Z3 finds no values for the cubes, so it rejects nothing here.
  const Cell cell(ts, "cell");
  Invariant proof = cell.proof(ts);
  const std::vector<ExprId> easy = proof.conditions;
  proof.conditions.push_back(hard(cell));
  proof.conditions.push_back(ts.exprs.negation(cell.a_next));
  const CertificateReport report = check(proof, shortly);
  EXPECT_NE(report.outcome, CertificateOutcome::Accepted);
  if (report.outcome == CertificateOutcome::Undecided) {
    EXPECT_EQ(report.shown, easy);
  } else {
    EXPECT_TRUE(report.shown.empty());
  }
}

TEST_F(TooHard, ASecondSolverThatIsNotAskedShowsNothing) {
  const Cell cell(ts, "cell");
  Invariant proof = cell.proof(ts);
  proof.conditions.push_back(hard(cell));
  CertificateOptions options = shortly;
  options.recheck = "cvc5";
  const CertificateReport report = check(proof, options);
  EXPECT_EQ(report.outcome, CertificateOutcome::Undecided);
  EXPECT_TRUE(report.shown.empty());
}

}  // namespace
}  // namespace rung
