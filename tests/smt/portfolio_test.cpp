#include "smt/portfolio.h"

#include <gtest/gtest.h>

#include "smt/certificate.h"
#include "tests/smt/systems.h"

namespace rung {
namespace {

using test::System;
using Status = Target::Status;

Target make_target(System& s, ExprId term, Target::Purpose purpose) {
  Target target;
  target.term = term;
  target.never = s.e().negation(term);
  target.purpose = purpose;
  return target;
}

/// Decides `targets` and checks every answer by other means: runs on integers,
/// proofs by the certificate's solver.
void decide(System& s, std::vector<Target>& targets,
            const std::string& engine = "") {
  const Deadline deadline(60);
  const std::vector<ExprId> growth = growth_terms(s.ts);
  std::vector<Target*> pointers;
  for (Target& target : targets) pointers.push_back(&target);
  Portfolio portfolio(s.ts, growth, pointers, {engine, 60, &deadline});
  portfolio.run();
  std::vector<ExprId> goals;
  for (const Target& target : targets) {
    if (target.status == Status::Reached) {
      EXPECT_TRUE(reaches(portfolio.cone(), target.run.steps, target.term));
    }
    if (target.status == Status::Unreachable) goals.push_back(target.never);
  }
  if (goals.empty()) return;
  CertificateSession session;
  const CertificateReport report =
      session.check(s.ts, portfolio.invariant(), goals, {});
  EXPECT_EQ(report.outcome, CertificateOutcome::Accepted) << report.what;
}

Target decide_one(System& s, ExprId term, const std::string& engine = "") {
  std::vector<Target> targets = {
      make_target(s, term, Target::Purpose::Violation)};
  decide(s, targets, engine);
  return targets[0];
}

TEST(Portfolio, AnInterlockIsDecidedWhileItIsBuilt) {
  System s;
  const ExprId a = s.input("a");
  const ExprId up = s.e().conjunction(a, s.e().negation(s.input("b")));
  const ExprId down = s.e().conjunction(s.input("c"), s.e().negation(up));
  const Target t = decide_one(s, s.e().conjunction(up, down));
  EXPECT_EQ(t.status, Status::Unreachable);
  EXPECT_EQ(t.engine, "structural");
}

TEST(Portfolio, ALatchHoldsByInduction) {
  System s;
  const ExprId stop = s.input("stop");
  const std::uint32_t q = s.latch("q", s.input("start"), stop);
  // A follower that is only ever set together with the latch.
  const std::uint32_t f = s.bit_state("f");
  s.next(f, s.e().conjunction(s.end(q), s.e().disjunction(s.of(f), s.of(q))));
  const Target t =
      decide_one(s, s.e().conjunction(s.end(f), s.e().negation(s.end(q))));
  EXPECT_EQ(t.status, Status::Unreachable);
}

TEST(Portfolio, FindsTheShortestRunToALatch) {
  System s;
  const std::uint32_t q = s.latch("q", s.input("start"), s.input("stop"));
  const Target t = decide_one(s, s.end(q));
  ASSERT_EQ(t.status, Status::Reached);
  ASSERT_EQ(t.run.steps.size(), 1U);
}

TEST(Portfolio, AnHourIsAHandfulOfSteps) {
  System s;
  const std::uint32_t q = s.latch("q", s.input("start"), s.input("stop"));
  const ExprId late = s.on_delay("t", s.end(q), 3600 * 1000);
  const Target t = decide_one(s, late);
  ASSERT_EQ(t.status, Status::Reached);
  EXPECT_LE(t.run.steps.size(), 5U);
  // The latch is set in the first scan, whose dt counts: 36,000 of 100 ms.
  EXPECT_EQ(scan_count(t.run.steps, s.ts.scan), 36000U);
}

TEST(Portfolio, AnUnreachableTimeIsNotReached) {
  System s;
  const std::uint32_t q = s.latch("q", s.input("start"), s.input("stop"));
  const std::uint32_t clock =
      s.ts.add_clock("t", s.e().negation(s.end(q)), 1000);
  const ExprId past = s.e().less(s.e().word(999), s.end(clock));
  const Target t =
      decide_one(s, s.e().conjunction(past, s.e().negation(s.end(q))));
  EXPECT_EQ(t.status, Status::Unreachable);
}

TEST(Portfolio, AFixedScanTimeAllowsItsMultiplesOnly) {
  System s(30, 30);
  const std::uint32_t clock = s.ts.add_clock("t", s.e().bit(false), 100000);
  const auto at = [&](std::int64_t ms) {
    return s.e().equal(s.end(clock), s.e().word(ms));
  };
  EXPECT_EQ(decide_one(s, at(9000)).status, Status::Reached);
  EXPECT_NE(decide_one(s, at(9001), "bmc").status, Status::Reached);
}

TEST(Portfolio, DtBoundsAreKeptInAStretch) {
  System s(40, 50);
  const std::uint32_t clock = s.ts.add_clock("t", s.e().bit(false), 100000);
  const auto at = [&](std::int64_t ms) {
    return s.e().equal(s.end(clock), s.e().word(ms));
  };
  // Sums of n numbers of [40, 50]: 40-50, 80-100, 120-150, 160-...
  for (std::int64_t ms : {39, 51, 79, 101, 119, 151, 159}) {
    EXPECT_NE(decide_one(s, at(ms), "bmc").status, Status::Reached) << ms;
  }
  for (std::int64_t ms : {40, 50, 80, 100, 120, 150, 160, 161}) {
    EXPECT_EQ(decide_one(s, at(ms)).status, Status::Reached) << ms;
  }
}

TEST(Portfolio, KInductionNeedsItsK) {
  // A ring of three places with a token; two tokens at distance never appear.
  System s;
  const std::uint32_t a = s.ts.add_state("a", Type::Bit, 0, 1, 1);
  const std::uint32_t b = s.bit_state("b");
  const std::uint32_t c = s.bit_state("c");
  s.next(a, s.of(c));
  s.next(b, s.of(a));
  s.next(c, s.of(b));
  const Target t = decide_one(s, s.e().conjunction(s.of(b), s.of(c)));
  EXPECT_EQ(t.status, Status::Unreachable);
}

TEST(Portfolio, ConstraintsHoldInEveryScan) {
  System s;
  const ExprId start = s.input("start");
  const ExprId never = s.input("never");
  s.ts.constraints.push_back(s.e().negation(never));
  const std::uint32_t q = s.latch("q", never, start);
  const Target t = decide_one(s, s.end(q));
  EXPECT_EQ(t.status, Status::Unreachable);
}

TEST(Portfolio, RunsThroughAFaultDoNotCount) {
  System s;
  const std::uint32_t q = s.latch("q", s.input("start"), s.input("stop"));
  std::vector<Target> targets = {
      make_target(s, s.of(q), Target::Purpose::Violation),
      make_target(s, s.end(q), Target::Purpose::Fault)};
  decide(s, targets);
  EXPECT_NE(targets[0].status, Status::Reached);
}

TEST(Portfolio, AWordCellOutOfRangeIsFoundByValue) {
  System s;
  const std::uint32_t n = s.ts.add_state("n", Type::Word, -3, 5, 0);
  const ExprId up = s.input("up");
  const ExprId sum = s.e().add(s.of(n), s.e().to_word(up));
  s.next(n, s.e().minimum(sum, s.e().word(5)));
  const Target at5 = decide_one(s, s.e().equal(s.end(n), s.e().word(5)));
  ASSERT_EQ(at5.status, Status::Reached);
  EXPECT_EQ(at5.run.steps.size(), 5U);
  const Target below = decide_one(s, s.e().less(s.end(n), s.e().word(0)));
  EXPECT_EQ(below.status, Status::Unreachable);
}

}  // namespace
}  // namespace rung
