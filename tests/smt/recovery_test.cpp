// Ways back: answers on systems whose answers are known, and certificates that
// are wrong in one place.

#include "smt/recovery.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>

#include "smt/recovery_check.h"
#include "tests/smt/systems.h"

namespace rung {
namespace {

using test::System;
using Answer = Recovery::Answer;

Recovery decide(System& s, ExprId goal) {
  const Deadline deadline(60);
  const std::vector<ExprId> growth = growth_terms(s.ts);
  return RecoverySearch(s.ts, growth, goal, {"", 60, &deadline})
      .decide(Patience::Long);
}

CertificateReport check(System& s, ExprId goal, const Recovery& recovery) {
  CertificateSession session;
  return check_ways(session, s.ts, goal, recovery, {});
}

CertificateReport check_stuck(System& s, ExprId goal,
                              const Recovery& recovery) {
  CertificateSession session;
  const Stimulus stimulus = to_stimulus(s.ts, recovery.run);
  const RunEnd end = end_of_run(s.ts, goal, stimulus);
  EXPECT_TRUE(end.allowed);
  return check_trap(session, s.ts, goal, recovery.invariant, end, {});
}

Recovery expect_recoverable(System& s, ExprId goal) {
  Recovery recovery = decide(s, goal);
  EXPECT_EQ(recovery.answer, Answer::Recoverable) << recovery.reason;
  const CertificateReport report = check(s, goal, recovery);
  EXPECT_EQ(report.outcome, CertificateOutcome::Accepted) << report.what;
  return recovery;
}

Recovery expect_stuck(System& s, ExprId goal) {
  Recovery recovery = decide(s, goal);
  EXPECT_EQ(recovery.answer, Answer::Stuck) << recovery.reason;
  const CertificateReport report = check_stuck(s, goal, recovery);
  EXPECT_EQ(report.outcome, CertificateOutcome::Accepted) << report.what;
  return recovery;
}

/// Input cells that to_stimulus() can name.
ExprId button(System& s, const std::string& name) {
  const auto cell = static_cast<std::uint32_t>(s.ts.vars.size());
  return s.ts.of(
      s.ts.add_input(name, VarRole::Input, Type::Bit, 0, 1, CellId(cell)));
}

TEST(Recovery, OneInputReleasesALatchFromEverywhere) {
  System s;
  const ExprId start = button(s, "start");
  const std::uint32_t q = s.latch("q", start, button(s, "stop"));
  const Recovery r = expect_recoverable(s, s.e().negation(s.end(q)));
  ASSERT_EQ(r.regions.size(), 1U);
  EXPECT_EQ(to_string(s.ts, r.regions[0]), "true: stop = 1");
}

TEST(Recovery, ALatchThatNothingReleasesIsATrap) {
  System s;
  const ExprId start = button(s, "start");
  const std::uint32_t q = s.latch("q", start, s.e().bit(false));
  const Recovery r = expect_stuck(s, s.e().negation(s.end(q)));
  ASSERT_EQ(r.invariant.lemmas.size(), 1U);
  EXPECT_EQ(to_string(s.ts, r.invariant.lemmas[0]), "q");
  EXPECT_EQ(r.run.steps.size(), 1U);
}

TEST(Recovery, AnHourIsOneRegionWithItsClock) {
  System s;
  const ExprId on = button(s, "on");
  const ExprId late = s.on_delay("t", on, 3'600'000);
  const Recovery r = expect_recoverable(s, late);
  ASSERT_EQ(r.regions.size(), 1U);
  EXPECT_EQ(to_string(s.ts, r.regions[0]),
            "true: on = 1, until t is large enough");
}

TEST(Recovery, ScansThatNothingButClocksChangeIn) {
  // A window in which a scan must end: any dt of a run is too special.
  System s;
  const ExprId on = button(s, "on");
  const ExprId late = s.on_delay("t", on, 1000);
  const ExprId gone = s.on_delay("u", on, 1100);
  const Recovery r =
      expect_recoverable(s, s.e().conjunction(late, s.e().negation(gone)));
  EXPECT_LE(r.regions.size(), 20U);
}

TEST(Recovery, TimersThatRunTogetherKeepTheirDistance) {
  // Both are started by one contact; the goal is between their times.
  System s(10, 10);
  const ExprId on = button(s, "on");
  const ExprId first = s.on_delay("a", on, 5000);
  const ExprId second = s.on_delay("b", on, 7000);
  const Recovery r =
      expect_recoverable(s, s.e().conjunction(first, s.e().negation(second)));
  EXPECT_LE(r.regions.size(), 10U);
}

TEST(Recovery, ARunMayEndWhereNoScanIsAllowed) {
  // Once q is on, no scan meets the assumption.
  const auto make = [](System& s) {
    const std::uint32_t q = s.latch("q", button(s, "start"), s.e().bit(false));
    s.ts.constraints.push_back(s.e().negation(s.of(q)));
    return q;
  };
  System on;
  expect_recoverable(on, on.end(make(on)));
  System off;
  expect_stuck(off, off.e().negation(off.end(make(off))));
}

TEST(Recovery, WhatTheEncodingLeavesOpenIsNotOurs) {
  System s;
  const ExprId open =
      s.ts.of(s.ts.add_input("open", VarRole::Choice, Type::Bit, 0, 1));
  const std::uint32_t q = s.bit_state("q");
  s.next(q, s.e().conjunction(button(s, "on"), open));
  const Recovery r = decide(s, s.end(q));
  EXPECT_NE(r.answer, Answer::Recoverable);
}

TEST(Recovery, ACounterIsClimbedStepByStep) {
  System s;
  const ExprId pulse = button(s, "pulse");
  const std::uint32_t before = s.bit_state("before");
  s.next(before, pulse);
  const std::uint32_t count = s.ts.add_state("count", Type::Word, 0, 4, 0);
  const ExprId rises = s.e().conjunction(pulse, s.e().negation(s.of(before)));
  const ExprId more = s.e().minimum(
      s.e().add(s.of(count), s.e().to_word(rises)), s.e().word(4));
  s.next(count, more);
  expect_recoverable(s, s.e().equal(more, s.e().word(4)));
  expect_stuck(s, s.e().equal(more, s.e().word(2)));
}

/// A chain of two timers behind a latch: regions of every kind.
struct Chain {
  System s;
  std::uint32_t q;
  ExprId goal;
  Recovery right;

  Chain() {
    const ExprId start = button(s, "start");
    q = s.latch("q", start, button(s, "stop"));
    const ExprId first = s.on_delay("a", s.end(q), 60'000);
    goal = s.on_delay("b", first, 60'000);
    right = expect_recoverable(s, goal);
  }
  void expect_rejected(const std::function<void(Recovery&)>& change) {
    Recovery wrong = right;
    change(wrong);
    EXPECT_EQ(check(s, goal, wrong).outcome, CertificateOutcome::Rejected);
  }
};

TEST(RecoveryCertificate, RegionsThatDoNotLeadOnAreRejected) {
  Chain chain;
  ASSERT_GT(chain.right.regions.size(), 2U);
  chain.expect_rejected([](Recovery& wrong) { wrong.regions.clear(); });
  chain.expect_rejected([](Recovery& wrong) { wrong.regions.pop_back(); });
  chain.expect_rejected([](Recovery& wrong) {
    wrong.regions.erase(wrong.regions.begin(), wrong.regions.end() - 1);
  });
  chain.expect_rejected([](Recovery& wrong) {
    std::reverse(wrong.regions.begin(), wrong.regions.end());
  });
}

TEST(RecoveryCertificate, ABoundLessOrAWiderOneIsRejected) {
  Chain chain;
  for (std::size_t i = 0; i < chain.right.regions.size(); ++i) {
    for (std::size_t j = 0; j < chain.right.regions[i].bounds.size(); ++j) {
      chain.expect_rejected([i, j](Recovery& wrong) {
        std::vector<Bound>& bounds = wrong.regions[i].bounds;
        bounds.erase(bounds.begin() + static_cast<std::ptrdiff_t>(j));
      });
      chain.expect_rejected([i, j](Recovery& wrong) {
        Bound& bound = wrong.regions[i].bounds[j];
        bound.value += bound.at_most ? 1 : -1;
      });
    }
  }
}

TEST(RecoveryCertificate, OtherInputsAreRejected) {
  Chain chain;
  for (std::size_t i = 0; i < chain.right.regions.size(); ++i) {
    for (std::size_t j = 0; j < chain.right.regions[i].held.size(); ++j) {
      const VarId input = chain.right.regions[i].held[j].input;
      if (input == chain.s.ts.dt) continue;
      chain.expect_rejected([i, j](Recovery& wrong) {
        Region::Held& held = wrong.regions[i].held[j];
        held.value = 1 - held.value;
      });
      chain.expect_rejected([i, j](Recovery& wrong) {
        std::vector<Region::Held>& held = wrong.regions[i].held;
        held.erase(held.begin() + static_cast<std::ptrdiff_t>(j));
      });
    }
  }
}

TEST(RecoveryCertificate, ARegionInWhichNothingGrowsIsRejected) {
  Chain chain;
  bool any = false;
  for (std::size_t i = 0; i < chain.right.regions.size(); ++i) {
    if (chain.right.regions[i].clock == Bound::kNone) continue;
    any = true;
    chain.expect_rejected(
        [i](Recovery& wrong) { wrong.regions[i].clock = Bound::kNone; });
    chain.expect_rejected([i, &chain](Recovery& wrong) {
      wrong.regions[i].clock = chain.q;  // a bit that rests
    });
  }
  EXPECT_TRUE(any);
}

TEST(RecoveryCertificate, AChoiceThatCannotBeMadeIsRejected) {
  Chain chain;
  const VarId dt = chain.s.ts.dt;
  const VarId state = chain.s.ts.states[chain.q].var;
  const VarId stop(2);
  ASSERT_EQ(chain.s.ts.vars[stop].name, "stop");
  for (const std::vector<Region::Held>& held :
       std::vector<std::vector<Region::Held>>{{{dt, 0}},
                                              {{dt, 101}},
                                              {{stop, 2}},
                                              {{stop, 0}, {stop, 1}},
                                              {{state, 1}},
                                              {{VarId(), 1}}}) {
    chain.expect_rejected([&](Recovery& wrong) {
      wrong.regions[0] = {{}, held, Bound::kNone};
    });
  }
}

TEST(RecoveryCertificate, AChoiceThatAnAssumptionForbidsIsRejected) {
  System s;
  const ExprId stop = button(s, "stop");
  const std::uint32_t q = s.latch("q", button(s, "start"), stop);
  s.ts.constraints.push_back(s.e().negation(stop));
  const ExprId goal = s.e().negation(s.end(q));
  Recovery wrong;
  wrong.answer = Answer::Recoverable;
  wrong.regions = {{{}, {{VarId(1), 1}}, Bound::kNone}};
  ASSERT_EQ(s.ts.vars[VarId(1)].name, "stop");
  EXPECT_EQ(check(s, goal, wrong).outcome, CertificateOutcome::Rejected);
  expect_stuck(s, goal);
}

TEST(RecoveryCertificate, ATrapThatLeaksIsRejected) {
  System s;
  const ExprId start = button(s, "start");
  const std::uint32_t q = s.latch("q", start, s.e().bit(false));
  const std::uint32_t lamp = s.latch("lamp", start, button(s, "off"));
  const ExprId goal = s.e().negation(s.end(q));
  const Recovery right = expect_stuck(s, goal);
  Recovery wrong = right;
  wrong.invariant.lemmas = {{{s.of(lamp), {}, 0, false}}};
  EXPECT_EQ(check_stuck(s, goal, wrong).outcome, CertificateOutcome::Rejected);
  wrong = right;
  wrong.invariant.lemmas.clear();
  EXPECT_EQ(check_stuck(s, goal, wrong).outcome, CertificateOutcome::Rejected);
  wrong = right;
  wrong.run.steps.clear();  // it does not get into the trap
  EXPECT_EQ(check_stuck(s, goal, wrong).outcome, CertificateOutcome::Rejected);
}

}  // namespace
}  // namespace rung
