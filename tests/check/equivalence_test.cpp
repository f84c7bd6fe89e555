// Proofs that two programs are the same, and the same proofs of programs that
// are not.

#include "smt/equivalence.h"

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "changed_programs.h"
#include "check/solver.h"
#include "confirm.h"
#include "random_run.h"

namespace rung {
namespace {

using Map = std::vector<std::pair<std::string, std::string>>;

struct Pair {
  std::string_view first;
  std::string_view second;
  Map map = {};
  std::uint32_t delay = 0;
};

const Pair kPairs[] = {
    // A start/stop rung, multiplied out, and what is behind it.
    {R"(Q0 = (I0 || Q0) && !I1;
Q1 = T(0, 2, Q0);
Q2 = C(0, 3, I2, I3, I4);
)",
     R"(Q0 = I0 && !I1 || Q0 && !I1;
Q1 = T(0, 2, Q0);
Q2 = C(0, 3, I2, I3, I4);
)"},
    // Another timer does it, and cells have other names.
    {R"(M0 = I0 && !I1;
Q0 = T(0, 2, M0) || TOF(1, 3, M0);
)",
     R"(Work = !(I1 || !I0);
Q0 = TOF(2, 3, Work) || T(7, 2, Work);
)"},
    {R"(//@ assume !(I0 && I1)
Q0 = (I0 || Q0) && !I1;
)",
     R"(Q7 = I3 || Q7 && !I1;
)",
     {{"I0", "I3"}, {"Q0", "Q7"}}},
    // Words, in their ranges.
    {R"(//@ input IW0 in 0..100
QW0 = IW0 * 2;
Q0 = QW0 > 20 || Q0 && QW0 > 10;
)",
     R"(//@ input IW0 in 0..100
QW0 = IW0 + IW0;
Q0 = IW0 >= 11 || Q0 && IW0 >= 6;
)"},
    // A scan later, by a cell that is read before it is written.
    {"Q0 = I0 && I1;\n", "Q0 = M0;\nM0 = I0 && I1;\n", {}, 1},
};

std::unique_ptr<ReadProgram> read(std::string_view text) {
  std::string error;
  auto program = read_program("sim", std::string(text), error);
  EXPECT_TRUE(program) << error << text;
  return std::make_unique<ReadProgram>(std::move(*program));
}

struct Compared {
  std::unique_ptr<ReadProgram> a;
  std::unique_ptr<ReadProgram> b;
  EquivalenceOptions options;
  EquivalenceResult result;

  explicit Compared(const Pair& pair)
      : a(read(pair.first)), b(read(pair.second)) {
    options.map = pair.map;
    options.delay = pair.delay;
    options.assumptions = a->properties.assumptions;
    options.assumptions_b = b->properties.assumptions;
    result = check_equivalence(a->program, b->program, options);
  }

  check::ClaimedResult claimed() const {
    check::ClaimedResult claimed;
    claimed.is_equivalence = true;
    claimed.delay = result.delay;
    for (const std::string& name : result.outputs) {
      check::ClaimedProperty& output = claimed.properties.emplace_back();
      output.name = name;
      output.kind = "equiv";
      output.goal = "invariant";
      output.verdict = "proved";
      output.has_certificate = true;
      output.k = result.certificate->k;
      output.lemmas = result.certificate->lemmas;
    }
    return claimed;
  }

  /// Of these programs, in the place of the own.
  check::CertificateCheck check(const Program& first, const Program& second,
                                const check::ClaimedResult& claimed) const {
    return {check::claims_of({first, a->properties}, {second, b->properties},
                             options.map, claimed),
            claimed,
            {}};
  }
};

bool all_confirmed(const check::CertificateCheck& check) {
  check::Answers answers;
  if (!check.scripts().empty()) {
    answers = check::ask_solver("z3", check.scripts(), 300);
  }
  const auto list = check.conclude(answers.list, answers.error);
  bool all = !list.empty();
  for (const check::Checked& one : list) {
    all = all && one.outcome == check::Outcome::Confirmed;
  }
  return all;
}

TEST(Equivalence, ProofsAreConfirmed) {
  for (const Pair& pair : kPairs) {
    const Compared compared(pair);
    ASSERT_EQ(compared.result.verdict, EquivalenceVerdict::Equivalent)
        << pair.second << compared.result.reason;
    ASSERT_TRUE(compared.result.certificate);
    EXPECT_TRUE(all_confirmed(compared.check(
        compared.a->program, compared.b->program, compared.claimed())))
        << pair.second;
  }
}

TEST(Equivalence, OfOtherProgramsIsRejectedOrTrue) {
  std::size_t rejected = 0;
  for (const Pair& pair : kPairs) {
    const Compared compared(pair);
    ASSERT_TRUE(compared.result.certificate);
    for (const Program& changed : changed_programs(compared.b->program)) {
      if (!all_confirmed(compared.check(compared.a->program, changed,
                                        compared.claimed()))) {
        ++rejected;
        continue;
      }
      EXPECT_EQ(
          check_equivalence(compared.a->program, changed, compared.options)
              .verdict,
          EquivalenceVerdict::Equivalent)
          << pair.second;
    }
  }
  EXPECT_GT(rejected, 20U);
}

TEST(Equivalence, WithoutWhatTheProofNeedsIsRejected) {
  const Compared compared(kPairs[0]);
  check::ClaimedResult claimed = compared.claimed();
  for (check::ClaimedProperty& output : claimed.properties) {
    std::erase_if(output.lemmas, [](const std::string& lemma) {
      return lemma.find("Q0") != std::string::npos;
    });
  }
  EXPECT_FALSE(all_confirmed(
      compared.check(compared.a->program, compared.b->program, claimed)));
  claimed = compared.claimed();
  claimed.delay = 1;
  EXPECT_FALSE(all_confirmed(
      compared.check(compared.a->program, compared.b->program, claimed)));
  claimed = compared.claimed();
  claimed.properties[0].name = "Q9";  // one has it not, nor has the other
  EXPECT_FALSE(all_confirmed(
      compared.check(compared.a->program, compared.b->program, claimed)));
}

TEST(Equivalence, OfProgramsThatCannotBeComparedIsNone) {
  const Compared compared(kPairs[3]);
  const auto other = read("//@ input IW0 in 0..99\nQW0 = IW0 * 2;\nQ0 = I0;\n");
  const auto slow = read("//@ scan 5..9 ms\nQ0 = I0;\n");
  for (const auto& second : {&other, &slow}) {
    const check::Claims claims = check::claims_of(
        {compared.a->program, compared.a->properties},
        {(*second)->program, (*second)->properties}, {}, compared.claimed());
    EXPECT_NE(claims.error, "");
  }
}

}  // namespace
}  // namespace rung
