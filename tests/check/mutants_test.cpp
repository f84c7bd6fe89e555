// Proofs that are made wrong: programs that change under them, lemmas that are
// dropped or turned round. What is confirmed all the same must be true, as the
// engines see it, who search the changed program anew.

#include <gtest/gtest.h>

#include <iostream>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "changed_programs.h"
#include "confirm.h"
#include "random_run.h"

namespace rung {
namespace {

constexpr std::string_view kPrograms[] = {
    // Dead time between two contactors: lemmas that relate three clocks.
    R"(//@ dead: interlock Q0, Q1 gap 500 ms
//@ off: always I2 -> !Q0 && !Q1
M0 = TOF(0, 0.5, Q0);
M1 = TOF(1, 0.5, Q1);
Q0 = (I0 || Q0) && !M1 && !Q1 && !I2;
Q1 = (I1 || Q1) && !M0 && !Q0 && !I2;
)",
    // A counter and the lamp that says that it is full.
    R"(//@ full: always C(0).value <= 5
//@ lamp: always Q1 -> C(0).value == 5
//@ clears: always I1 -> C(0).value == 0
Q0 = I0 && !Q1;
Q1 = C(0, 5, Q0, false, I1);
)",
    // An on-delay, seen by two monitors.
    R"(//@ low: I0 for 2 s implies Q0
//@ late: after I0, Q0 || !I0 within 2.2 s
//@ first: Q0 only after I0
Q0 = T(0, 2, I0);
)",
    // Three steps: one at a time.
    R"(//@ one: interlock Q0, Q1, Q2
//@ order: always Q2 -> !Q0
Q0 = (I0 || Q0) && !Q1 && !Q2 && !I3;
Q1 = (Q0 && I1 || Q1) && !Q2 && !I3;
Q0 = Q0 && !Q1;
Q2 = (Q1 && I2 || Q2) && !I3;
Q1 = Q1 && !Q2;
)",
};

struct Proved {
  std::unique_ptr<ReadProgram> read;
  VerifyReport report;
};

VerifyOptions quick() {
  VerifyOptions options;
  options.budget.max_depth = 10;
  options.wanted = [](std::string_view name) {
    return !name.starts_with("builtin.");
  };
  return options;
}

Proved prove(std::string_view text) {
  std::string error;
  auto read = read_program("sim", std::string(text), error);
  EXPECT_TRUE(read) << error;
  Proved proved;
  proved.read = std::make_unique<ReadProgram>(std::move(*read));
  proved.report =
      verify(proved.read->program, proved.read->properties, quick());
  return proved;
}

bool is_confirmed(const check::Checked& one) {
  return one.outcome == check::Outcome::Confirmed;
}

TEST(Mutants, TheProofsThemselvesAreConfirmed) {
  for (const std::string_view text : kPrograms) {
    const Proved proved = prove(text);
    EXPECT_EQ(unconfirmed(proved.read->program, proved.read->properties,
                          proved.report),
              "");
    for (const ObligationResult& result : proved.report.results) {
      EXPECT_TRUE(result.certificate) << result.obligation.name;
    }
  }
}

TEST(Mutants, OfProgramsAreRejectedOrTrue) {
  std::size_t rejected = 0;
  std::size_t confirmed = 0;
  // Not the first: its mutants take long to be proved.
  for (const std::string_view text : std::span(kPrograms).subspan(1)) {
    const Proved proved = prove(text);
    const std::vector<Program> mutants = changed_programs(proved.read->program);
    Confirmation confirmation;
    for (const Program& mutant : mutants) {
      confirmation.add(mutant, proved.read->properties,
                       claimed_by(proved.report));
    }
    const auto checked = confirmation.ask();
    for (std::size_t i = 0; i < mutants.size(); ++i) {
      const VerifyReport truth =
          verify(mutants[i], proved.read->properties, quick());
      std::size_t at = 0;
      for (const check::Checked& one : checked[i]) {
        const ObligationResult& result = truth.results[at++];
        ASSERT_EQ(result.obligation.name, one.name);
        if (!is_confirmed(one)) {
          ++rejected;
          continue;
        }
        ++confirmed;
        EXPECT_NE(result.verdict, Verdict::Violated)
            << one.name << " of mutant " << i << " of\n"
            << text;
      }
    }
  }
  std::cout << rejected << " rejected, " << confirmed
            << " confirmed, as they are true\n";
  EXPECT_GT(rejected, confirmed / 2);
  EXPECT_GT(confirmed, 0U);
}

TEST(Mutants, OfLemmasAreMostlyRejected) {
  std::size_t dropped = 0;
  std::size_t negated = 0;
  std::size_t lemmas = 0;
  for (const std::string_view text : std::span(kPrograms).subspan(1)) {
    const Proved proved = prove(text);
    const check::ClaimedResult claimed = claimed_by(proved.report);
    Confirmation confirmation;
    for (const check::ClaimedProperty& property : claimed.properties) {
      for (std::size_t l = 0; l < property.lemmas.size(); ++l) {
        check::ClaimedResult one;
        one.properties = {property};
        std::vector<std::string>& list = one.properties.front().lemmas;
        const std::string lemma = list[l];
        list[l] = "!(" + lemma + ")";
        confirmation.add(proved.read->program, proved.read->properties, one);
        list.erase(list.begin() + static_cast<std::ptrdiff_t>(l));
        confirmation.add(proved.read->program, proved.read->properties, one);
        ++lemmas;
      }
    }
    const auto checked = confirmation.ask();
    for (std::size_t i = 0; i < checked.size(); ++i) {
      if (is_confirmed(checked[i].front())) continue;
      ++(i % 2 == 0 ? negated : dropped);
    }
  }
  std::cout << lemmas << " lemmas: without it " << dropped
            << " are rejected, with its negation " << negated << "\n";
  EXPECT_EQ(negated, lemmas);
  EXPECT_GT(dropped * 4, lemmas);
}

}  // namespace
}  // namespace rung
